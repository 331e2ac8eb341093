// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_ADAPTATION_NUMERICS_RING_H
#define CGAL_SURFACE_MESH_ADAPTATION_NUMERICS_RING_H

#include <boost/container/small_vector.hpp>

namespace CGAL {
namespace Surface_mesh_adaptation {

/// Neighbours, halfedges, positions or functions around a vertex; on the stack for the usual degrees.
template <class T>
using Ring = boost::container::small_vector<T, 16>;

} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_NUMERICS_RING_H
