// SPDX-License-Identifier: GPL-3.0-or-later
//
// Regularization: takes vertices away and puts others in where that brings the numbers of faces around vertices nearer to
// those of a regular mesh. Swaps alone leave pairs of vertices with five and seven faces, the dislocations of a lattice:
// more than a quarter of all vertices. A dislocation moves along its row by swaps, but across rows only if a vertex comes
// or goes: then two of them meet, and cancel out.
//
// A vertex is taken away by a collapse, and put into the hole that two to four faces leave. It takes the number of one
// that is gone from near by, so in all there are no more vertices afterwards.
//
// Conflict neighbourhood: the closed one-ring of a vertex that vanishes; the corners of the faces that make place.
// Each operation lowers the sum of the squares of excess faces, so sweeps end. Invariants: as simplification; features
// stay as they are.
// Work: O(active vertices) a sweep, and a look at all; span: O(log n).

#ifndef CGAL_SURFACE_MESH_ADAPTATION_KERNELS_REGULARIZATION_H
#define CGAL_SURFACE_MESH_ADAPTATION_KERNELS_REGULARIZATION_H

#include <CGAL/Surface_mesh_adaptation/kernels/Adapted_surface.h>
#include <CGAL/Surface_mesh_adaptation/kernels/Simplification.h>
#include <CGAL/Surface_mesh_adaptation/kernels/alignment.h>
#include <CGAL/Surface_mesh_adaptation/kernels/common.h>
#include <CGAL/Surface_mesh_adaptation/kernels/degrees.h>
#include <CGAL/Surface_mesh_adaptation/mesh/block_sweep.h>
#include <CGAL/Surface_mesh_adaptation/tasks/independent_set.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

namespace CGAL {
namespace Surface_mesh_adaptation {

struct Regularization_thresholds
{
  int max_change = -2;      ///< of the sum of the squares of excess faces: an even number
  double max_length = 1.7;  ///< no collapse creates an edge above, unless it removes a longer one: moves shorten it
  double min_length = 1.1;  ///< mean length of the edges in the place of a vertex that comes
  double min_quality = 0.5; ///< of the faces that come
};

template <class Surface, class Execution>
class Regularization
{
public:
  using Metric = typename Surface::Metric;

  Regularization(const Execution& execution, Surface& surface, const Regularization_thresholds& thresholds)
    : execution_(execution), surface_(surface), mesh_(surface.mesh), thresholds_(thresholds)
    , collapses_(execution, surface, collapse_thresholds(thresholds))
  {}

  /// Examines every active vertex once. Returns the number of vertices taken away and put in.
  std::size_t sweep(Sweep_counts& counts)
  {
    const std::vector<Operation> operations = propose();
    reservations_.resize(execution_, mesh_.number_of_vertices());
    const auto winners = independent_set(
      execution_, operations.size(), reservations_,
      [&](std::size_t i) {
        const Operation& o = operations[i];
        return task_priority(std::uint32_t(std::clamp(4 + o.change / 2, 0, 7)), mesh_.source(o.h), 0);
      },
      [&](std::size_t i, const auto& claim) { for_each_claimed(operations[i], claim); });
    const std::size_t applied = collapse(operations, winners) + insert(operations, winners);
    ++counts.sweeps;
    counts.candidates += operations.size();
    counts.applied += applied;
    return applied;
  }

private:
  /// What is best at a vertex: to collapse the edge of `h` towards its target; or to put a vertex into the two faces of
  /// `h`, and those behind the outer edges of these that `wings` says, as bits.
  struct Operation
  {
    Index h = no_index;
    int change = 0; ///< of the sum of squares
    bool is_collapse = true;
    unsigned wings = 0;
  };

  static Simplification_thresholds collapse_thresholds(const Regularization_thresholds& thresholds)
  {
    Simplification_thresholds t;
    t.max_length = thresholds.max_length;
    t.min_quality = thresholds.min_quality;
    return t;
  }

  std::vector<Operation> propose()
  {
    return gather<Operation>(execution_, mesh_.number_of_vertices(), block_length,
                             [&](std::size_t begin, std::size_t end, std::vector<Operation>& list) {
      if (is_stopped(execution_)) return;
      for (std::size_t v = begin; v < end; ++v) {
        if (mesh_.is_removed_vertex(Index(v)) || !is_active(surface_, Index(v), Activity::regularize)) continue;
        const Operation operation = best_operation(Index(v));
        if (operation.h != no_index) list.push_back(operation);
        else deactivate(surface_, Index(v), Activity::regularize);
      }
    });
  }

  /// A collapse takes a vertex with too few faces, a vertex that comes is put beside one with too many.
  Operation best_operation(Index v) const
  {
    if (surface_.vertex_class(v) != Vertex_class::smooth) return {};
    const Excess_of_faces excess = excess_of_faces(surface_, mesh_.outgoing[v]);
    return excess.faces < 0 ? best_collapse(v, excess) : excess.faces > 0 ? best_insertion(v, excess) : Operation();
  }

  /// The edges at a vertex in the surface, with the excess faces at their ends.
  struct Spokes
  {
    Ring<Index> halfedges; ///< that leave the vertex, counterclockwise
    Ring<Excess_of_faces> ends;

    std::size_t size() const { return halfedges.size(); }
    const Excess_of_faces& end(std::size_t i) const { return ends[i % ends.size()]; }
  };

  Spokes spokes(Index v) const
  {
    Spokes s;
    mesh_.for_each_outgoing(v, [&](Index h) {
      s.halfedges.push_back(h);
      s.ends.push_back(excess_of_faces(surface_, Mesh_view::next(h)));
    });
    return s;
  }

  bool is_better(int change, const Operation& best) const
  {
    return change <= thresholds_.max_change && change < best.change;
  }

  Operation best_collapse(Index v, const Excess_of_faces& center) const
  {
    const Spokes s = spokes(v);
    Operation best;
    for (std::size_t i = 0, n = s.size(); i < n; ++i) {
      if (!s.ends[i].counts) continue;
      // vertices with e and f faces too many become one with e + f + 2
      const int change = s.ends[i].squared_change(center.faces + 2) - center.faces * center.faces +
                         s.end(i + 1).squared_change(-1) + s.end(i + n - 1).squared_change(-1);
      const Index h = s.halfedges[i];
      if (is_better(change, best) && collapses_.is_allowed({h, true})) best = {h, change, true, 0};
    }
    return best;
  }

  Operation best_insertion(Index v, const Excess_of_faces& center) const
  {
    const Spokes s = spokes(v);
    Ring<Excess_of_faces> behind; // the edges from the end of a spoke to that of the next
    for (const Index h : s.halfedges) {
      const Index outer = Mesh_view::next(h);
      behind.push_back(mesh_.is_feature(outer) ? Excess_of_faces()
                                               : excess_of_faces(surface_, Mesh_view::previous(mesh_.twin[outer])));
    }
    Operation best;
    for (std::size_t i = 0, n = s.size(); i < n; ++i) {
      const std::size_t before = i + n - 1;
      const Excesses excesses{{center, s.end(before), s.ends[i], s.end(i + 1)},
                              {s.end(before - 1), behind[before % n], behind[i], s.end(i + 2)}};
      for (const unsigned wings : {0u, 1u, 2u, 4u, 8u, 3u, 5u, 6u, 9u, 10u, 12u}) {
        const Operation insertion{s.halfedges[i], excesses.change(wings), false, wings};
        if (is_better(insertion.change, best) && is_promising(insertion)) best = insertion;
      }
    }
    return best;
  }

  /// The outer edges of the two faces of `h`, within these: counterclockwise, the first leaves the source of `h`.
  std::array<Index, 4> outer_edges(Index h) const
  {
    const Index t = mesh_.twin[h];
    return {Mesh_view::next(t), Mesh_view::previous(t), Mesh_view::next(h), Mesh_view::previous(h)};
  }

  /// The excess faces around the vertices that an insertion concerns.
  struct Excesses
  {
    std::array<Excess_of_faces, 4> corners; ///< from which the outer edges start
    std::array<Excess_of_faces, 4> wings;   ///< apexes of the faces behind these edges

    /// What the insertion adds to the sum of the squares.
    int change(unsigned set) const
    {
      int sum = 0, n = 0;
      for (unsigned i = 0; i < 4; ++i) {
        const int here = int(set >> i & 1), before = int(set >> (i + 3) % 4 & 1);
        sum += corners[i].squared_change(int(i % 2) - here - before) + wings[i].squared_change(here);
        n += here;
      }
      return sum + (n - 2) * (n - 2); // the new vertex has four faces, and one for each wing
    }
  };

  /// The outer edges behind which an insertion takes the faces, too.
  Ring<Index> wing_edges(const Operation& insertion) const
  {
    Ring<Index> edges;
    const std::array<Index, 4> outer = outer_edges(insertion.h);
    for (std::size_t i = 0; i < 4; ++i)
      if ((insertion.wings >> i & 1) != 0) edges.push_back(outer[i]);
    return edges;
  }

  /// The corners of the hole of an insertion, counterclockwise.
  Ring<Index> hole(const Operation& insertion) const
  {
    Ring<Index> corners;
    const std::array<Index, 4> outer = outer_edges(insertion.h);
    for (std::size_t i = 0; i < 4; ++i) {
      corners.push_back(mesh_.source(outer[i]));
      if ((insertion.wings >> i & 1) != 0) corners.push_back(mesh_.apex(mesh_.twin[outer[i]]));
    }
    return corners;
  }

  static bool are_distinct(Ring<Index> vertices)
  {
    std::sort(vertices.begin(), vertices.end());
    return std::adjacent_find(vertices.begin(), vertices.end()) == vertices.end();
  }

  Vector_3 middle(const Ring<Index>& hole) const
  {
    Vector_3 sum = Vector_3::Zero();
    for (const Index v : hole) sum += surface_.points[v];
    return sum / double(hole.size());
  }

  /// Whether there is room for a vertex, on one side of all features: a test of the middle of the hole, for it takes a
  /// walk to find out where that is on the surface.
  bool is_promising(const Operation& insertion) const
  {
    for (const Index e : wing_edges(insertion))
      if (mesh_.is_feature(e)) return false;
    const Ring<Index> corners = hole(insertion);
    if (!are_distinct(corners) || mean_length(insertion) < thresholds_.min_length) return false;
    Placed_vertex<Metric> m = surface_.vertex(mesh_.source(insertion.h));
    m.point = middle(corners);
    return are_good(m, corners);
  }

  /// Of the edges that make place for the vertex.
  double mean_length(const Operation& insertion) const
  {
    const Ring<Index> edges = wing_edges(insertion);
    double sum = surface_.length(insertion.h);
    for (const Index e : edges) sum += surface_.length(e);
    return sum / double(edges.size() + 1);
  }

  /// The new vertex in the middle of its hole, on the surface.
  Placed_vertex<Metric> placed(const Operation& insertion, const Ring<Index>& hole) const
  {
    const Index p = mesh_.source(insertion.h);
    const Vector_3 target = middle(hole);
    const auto found = surface_.reference().locate({surface_.locations[p], {surface_.points[p], surface_.normals[p]}},
                                                   target, precision * (target - surface_.points[p]).norm());
    return surface_.place(found.location);
  }

  /// Whether the faces that join `m` to the hole are good, and so near to the surface that nothing is folded.
  bool are_good(const Placed_vertex<Metric>& m, const Ring<Index>& hole) const
  {
    for (std::size_t i = 0; i < hole.size(); ++i)
      if (!is_good(m, hole[i], hole[(i + 1) % hole.size()])) return false;
    return true;
  }

  bool is_good(const Placed_vertex<Metric>& m, Index a, Index b) const
  {
    const Vector_3 ea = surface_.points[a] - m.point, eb = surface_.points[b] - m.point, n = ea.cross(eb);
    const double length = n.norm();
    const Corner_products products(n, length, {&m.normal, &surface_.normals[a], &surface_.normals[b]});
    return products.least >= flat_alignment * length &&
           internal::squared_shape(m.metric, surface_.metrics[a], surface_.metrics[b], ea, eb, n)
             .is_at_least(thresholds_.min_quality);
  }

  bool keeps_tolerance(const Operation& insertion, const Placed_vertex<Metric>& m, const Ring<Index>& corners) const
  {
    Ring<Triangle_points> faces;
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const Index a = corners[i], b = corners[(i + 1) % corners.size()];
      if (!surface_.tolerance->is_kept({m.location, m.point}, surface_.corner(a), surface_.corner(b))) return false;
      faces.push_back({m.point, surface_.points[a], surface_.points[b]});
    }
    Ring<Index> old_faces{Mesh_view::face(insertion.h), Mesh_view::face(mesh_.twin[insertion.h])};
    for (const Index e : wing_edges(insertion)) old_faces.push_back(Mesh_view::face(mesh_.twin[e]));
    return surface_.tolerance->are_covered(old_faces, faces);
  }

  template <class Claim>
  void for_each_claimed(const Operation& operation, const Claim& claim) const
  {
    if (operation.is_collapse) {
      claim(mesh_.source(operation.h));
      mesh_.for_each_neighbor(mesh_.source(operation.h), claim);
    } else {
      for (const Index v : hole(operation)) claim(v);
    }
  }

  std::size_t collapse(const std::vector<Operation>& operations, const std::vector<std::uint32_t>& winners)
  {
    const auto chosen = pack(execution_, winners.size(), [&](std::size_t i) {
      return operations[winners[i]].is_collapse;
    });
    for_each_index(execution_, chosen.size(), [&](std::size_t i) {
      collapses_.apply({operations[winners[chosen[i]]].h, true});
    }, heavy_chunk_length);
    return chosen.size();
  }

  std::size_t insert(const std::vector<Operation>& operations, const std::vector<std::uint32_t>& winners)
  {
    const auto chosen = pack(execution_, winners.size(), [&](std::size_t i) {
      return !operations[winners[i]].is_collapse;
    });
    if (chosen.empty()) return 0;
    const auto insertion = [&](std::size_t i) -> const Operation& { return operations[winners[chosen[i]]]; };
    const auto vertices = pack(execution_, mesh_.number_of_vertices(), [&](std::size_t v) {
      return mesh_.is_removed_vertex(Index(v));
    });
    const auto faces = pack(execution_, mesh_.number_of_faces(), [&](std::size_t f) {
      return mesh_.is_removed_face(Index(f));
    });
    std::vector<Index> beside(chosen.size());
    for_each_index(execution_, chosen.size(), [&](std::size_t i) { beside[i] = mesh_.source(insertion(i).h); });
    const std::vector<std::uint32_t> holes = nearest_holes(vertices, beside);
    std::vector<std::uint8_t> is_done(chosen.size(), 0);
    for_each_index(execution_, chosen.size(), [&](std::size_t i) {
      const std::size_t hole = holes[i]; // two faces are gone with a vertex
      if (2 * hole + 1 < faces.size())
        is_done[i] = apply(insertion(i), vertices[hole], faces[2 * hole], faces[2 * hole + 1]);
    }, heavy_chunk_length);
    return count_if(execution_, is_done.size(), [&](std::size_t i) { return is_done[i] != 0; });
  }

  /// For each of the vertices `beside` the position of a hole of its own: the nearest one in its range of numbers, for
  /// what is far from its neighbours in memory makes all sweeps slower. `no_index` if there is none. Both lists increase.
  std::vector<std::uint32_t> nearest_holes(const std::vector<std::uint32_t>& holes, const std::vector<Index>& beside) const
  {
    std::vector<std::uint32_t> chosen(beside.size(), no_index);
    std::vector<std::uint8_t> is_taken(holes.size(), 0);
    for_each_index(execution_, number_of_chunks(mesh_.number_of_vertices(), range_of_holes), [&](std::size_t range) {
      const std::size_t end = first_in_range(holes, range + 1), last = first_in_range(beside, range + 1);
      for (std::size_t i = first_in_range(beside, range), begin = first_in_range(holes, range); i < last; ++i) {
        std::size_t nearest = end;
        for (std::size_t k = begin; k < end; ++k)
          if (!is_taken[k] && (nearest == end || distance(holes[k], beside[i]) < distance(holes[nearest], beside[i])))
            nearest = k;
        if (nearest == end) return;
        is_taken[nearest] = 1;
        chosen[i] = std::uint32_t(nearest);
      }
    }, 1);
    return chosen;
  }

  static std::size_t first_in_range(const std::vector<std::uint32_t>& sorted, std::size_t range)
  {
    return std::size_t(std::lower_bound(sorted.begin(), sorted.end(), range * range_of_holes) - sorted.begin());
  }

  static Index distance(Index a, Index b) { return a < b ? b - a : a - b; }

  /// Gives the new vertex the number `m` and the two new faces `f` and `g`, unless that makes a bad face.
  bool apply(const Operation& insertion, Index m, Index f, Index g)
  {
    const Index h = insertion.h, t = mesh_.twin[h];
    const Ring<Index> corners = hole(insertion);
    const Placed_vertex<Metric> inserted = placed(insertion, corners);
    if (!are_good(inserted, corners) || (surface_.tolerance && !keeps_tolerance(insertion, inserted, corners))) {
      deactivate(surface_, mesh_.source(h), Activity::regularize);
      return false;
    }
    mesh_.split_edge(h, m, f, g);
    const std::array<Index, 4> outer{3 * f, Mesh_view::previous(t), Mesh_view::next(h), 3 * g + 2};
    for (std::size_t i = 0; i < 4; ++i)
      if ((insertion.wings >> i & 1) != 0) mesh_.flip(outer[i]);
    surface_.set(m, inserted);
    surface_.origin[m] = no_index;
    surface_.active[m] = all_kernels;
    for (const Index v : corners) activate(surface_, v);
    if (surface_.tolerance) surface_.tolerance->hand_over(surface_, surface_.faces_around(m));
    return true;
  }

  static constexpr std::size_t range_of_holes = 4 * block_length; // shorter ones lack holes where others have too many
  static constexpr double precision = 0.1; // of a location, of the way there: later moves undo the rest

  const Execution& execution_;
  Surface& surface_;
  Mesh_view& mesh_;
  Regularization_thresholds thresholds_;
  Simplification<Surface, Execution> collapses_;
  Reservations reservations_;
};

} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_KERNELS_REGULARIZATION_H
