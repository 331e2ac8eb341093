// SPDX-License-Identifier: GPL-3.0-or-later
//
// The meshes of CGAL's manual, in the folder that `CGAL_DATA_DIR` names.

#ifndef TEST_SURFACE_MESH_ADAPTATION_REAL_MESHES_H
#define TEST_SURFACE_MESH_ADAPTATION_REAL_MESHES_H

#include <CGAL/IO/OFF.h>
#include <CGAL/boost/graph/IO/OFF.h>

#include <stdexcept>
#include <string>

/// \throws std::runtime_error if the mesh is not there: a test that needs it fails
template <class TriangleMesh>
TriangleMesh real_mesh(const std::string& name)
{
  TriangleMesh mesh;
  const std::string file = CGAL::data_file_path("meshes/" + name + ".off");
  if (!CGAL::IO::read_OFF(file, mesh) || num_faces(mesh) == 0)
    throw std::runtime_error(file + " cannot be read: set CGAL_DATA_DIR to what scripts/demo_data prints");
  return mesh;
}

#endif // TEST_SURFACE_MESH_ADAPTATION_REAL_MESHES_H
