// SPDX-License-Identifier: GPL-3.0-or-later
#include <CGAL/Surface_mesh_adaptation/adapt_surface_mesh.h>

#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/generators.h>

int main()
{
  using Point = CGAL::Simple_cartesian<double>::Point_3;
  CGAL::Surface_mesh<Point> mesh;
  CGAL::make_icosahedron(mesh, Point(0, 0, 0));
  const CGAL::Surface_mesh_adaptation::Uniform_metric_field field(0.3);
  return CGAL::Surface_mesh_adaptation::adapt_surface_mesh(mesh, field).final.in_range > 0.9 ? 0 : 1;
}
