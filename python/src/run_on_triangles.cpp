// SPDX-License-Identifier: GPL-3.0-or-later

#include "run_on.h"

namespace sma_python {

Outcome run_on_triangles(const std::string& kernel, const Surface_arrays& surface, const Options& options,
                         Events& events)
{
  return Run<SMA::Flat_reconstruction>(surface, options, events)(kernel);
}

} // namespace sma_python
