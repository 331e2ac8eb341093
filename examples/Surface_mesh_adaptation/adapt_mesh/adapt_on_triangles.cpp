// SPDX-License-Identifier: GPL-3.0-or-later

#include "adapt_on.h"

namespace adapt_mesh {

SMA::Adaptation_report adapt_on_triangles(const Options& options, Constrained_mesh& mesh, const Output_metric& metric,
                                          const Carried_fields& fields, Progress& progress)
{
  return adapt_on<SMA::Flat_reconstruction>(options, mesh, metric, fields, progress);
}

} // namespace adapt_mesh
