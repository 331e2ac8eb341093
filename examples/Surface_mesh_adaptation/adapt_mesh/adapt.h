// SPDX-License-Identifier: GPL-3.0-or-later
//
// The adaptation as the options ask for it, with either surface between the vertices of the input. Each is compiled in
// a source of its own, side by side.

#ifndef ADAPT_MESH_ADAPT_H
#define ADAPT_MESH_ADAPT_H

#include "Carried_fields.h"
#include "Progress.h"
#include "mesh_files.h"
#include "metric_files.h"
#include "options.h"

#include <CGAL/Surface_mesh_adaptation/Adaptation_report.h>

namespace adapt_mesh {

/// \throws Bad_input, Usage_error, and what `adapt_surface_mesh()` throws
/// @{
SMA::Adaptation_report adapt_on_patches(const Options&, Constrained_mesh&, const Output_metric&, const Carried_fields&, Progress&);
SMA::Adaptation_report adapt_on_triangles(const Options&, Constrained_mesh&, const Output_metric&, const Carried_fields&, Progress&);
/// @}

} // namespace adapt_mesh

#endif // ADAPT_MESH_ADAPT_H
