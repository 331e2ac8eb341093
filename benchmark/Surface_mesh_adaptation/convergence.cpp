// SPDX-License-Identifier: GPL-3.0-or-later
//
// How fast the patches converge to surfaces of which the corners know the exact normals and shape operators: largest
// error and order, from one level to the next, of the distance and of the normal. Argument: the finest level, 4.

#include "../../test/Surface_mesh_adaptation/analytic_surfaces.h"

#include <CGAL/Surface_mesh_adaptation/surface_reconstruction.h>

#include <cstdio>
#include <cstdlib>

namespace {

namespace SMA = CGAL::Surface_mesh_adaptation;

template <class Reconstruction, class Surface>
void print_rows(const char* name, const Surface& surface, int finest)
{
  analytic::Patch_errors last{};
  for (int level = 0; level <= finest; ++level) {
    const analytic::Patch_errors e = analytic::patch_errors<Reconstruction>(surface, level);
    std::printf("  %-12s %d %7.4f", name, level, e.h);
    const double now[] = {e.distance, e.rms_distance, e.normal, e.rms_normal},
                 before[] = {last.distance, last.rms_distance, last.normal, last.rms_normal};
    for (int i = 0; i < 4; ++i) {
      std::printf("  %8.2e", now[i]);
      if (level > 0) std::printf(" %4.2f", std::log(before[i] / now[i]) / std::log(last.h / e.h));
      else std::printf("     ");
    }
    std::printf("\n");
    last = e;
  }
}

template <class Surface>
void print_surface(const char* name, const Surface& surface, int finest)
{
  std::printf("%s: patch, level, edge length; error and order of: distance (max, rms), normal (max, rms)\n", name);
  print_rows<SMA::Flat_reconstruction>("flat", surface, finest);
  print_rows<SMA::PN_triangle_reconstruction>("PN", surface, finest);
  print_rows<SMA::Walton_meek_reconstruction>("Walton-Meek", surface, finest);
  print_rows<SMA::Gregory_reconstruction>("Gregory", surface, finest);
}

} // namespace

int main(int argc, char** argv)
{
  const int finest = argc > 1 ? std::atoi(argv[1]) : 4;
  print_surface("sphere", analytic::Sphere(), finest);
  print_surface("ellipsoid", analytic::Ellipsoid(), finest);
  print_surface("torus", analytic::Torus(), finest);
  print_surface("graph", analytic::Graph(), finest);
}
