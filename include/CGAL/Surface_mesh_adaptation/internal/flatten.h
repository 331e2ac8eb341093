// SPDX-License-Identifier: GPL-3.0-or-later
//
// Marks the innermost functions of the kernels: everything they call is inlined. Compilers give up inlining the small
// expression templates of Eigen in large translation units, which doubles the instructions of a kernel.

#ifndef CGAL_SURFACE_MESH_ADAPTATION_INTERNAL_FLATTEN_H
#define CGAL_SURFACE_MESH_ADAPTATION_INTERNAL_FLATTEN_H

#if defined(__GNUC__)
#define CGAL_SMA_FLATTEN __attribute__((flatten))
#else
#define CGAL_SMA_FLATTEN
#endif

#endif // CGAL_SURFACE_MESH_ADAPTATION_INTERNAL_FLATTEN_H
