// SPDX-License-Identifier: GPL-3.0-or-later
//
// The adaptation itself: rounds of refine, simplify, swap, relocate until nothing is left to gain.

#ifndef CGAL_SURFACE_MESH_ADAPTATION_DRIVER_ADAPTATION_DRIVER_H
#define CGAL_SURFACE_MESH_ADAPTATION_DRIVER_ADAPTATION_DRIVER_H

#include <CGAL/Surface_mesh_adaptation/Adaptation_report.h>
#include <CGAL/Surface_mesh_adaptation/distance/Face_deviations.h>
#include <CGAL/Surface_mesh_adaptation/distance/Sampled_points.h>
#include <CGAL/Surface_mesh_adaptation/driver/mesh_statistics.h>
#include <CGAL/Surface_mesh_adaptation/fields/gradation.h>
#include <CGAL/Surface_mesh_adaptation/kernels/Fitting.h>
#include <CGAL/Surface_mesh_adaptation/kernels/Mending.h>
#include <CGAL/Surface_mesh_adaptation/kernels/Refinement.h>
#include <CGAL/Surface_mesh_adaptation/kernels/Regularization.h>
#include <CGAL/Surface_mesh_adaptation/kernels/Relocation.h>
#include <CGAL/Surface_mesh_adaptation/kernels/Simplification.h>
#include <CGAL/Surface_mesh_adaptation/kernels/Swapping.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

namespace CGAL {
namespace Surface_mesh_adaptation {

/// What the shape of the faces counts against the distance where vertices are fitted to the surface.
constexpr double default_shape_weight = 0.02;

template <class Surface, class Execution, class Visitor>
class Adaptation_driver
{
public:
  Adaptation_driver(const Execution& execution, Surface& surface, Visitor& visitor)
    : execution_(execution), surface_(surface), visitor_(visitor)
    , refinement_(execution, surface, weighed<Refinement_thresholds>())
    , simplification_(execution, surface, weighed<Simplification_thresholds>())
    , swapping_(execution, surface, swapping_thresholds()), regularization_(execution, surface, {})
    , relocation_(execution, surface, {})
  {}

  /// At most `rounds` rounds; then, if a number of vertices or a deviation is asked for and missed, a few more in a
  /// scaled or tightened metric, several times. In the end the vertices are fitted to the surface if `is_fitted`;
  /// `std::false_type` spares users the time to compile that. The smaller the `shape_weight`, the nearer they come.
  template <class IsFitted = std::false_type>
  Adaptation_report run(std::size_t rounds, IsFitted is_fitted = {}, double shape_weight = default_shape_weight)
  {
    const Metric_aims& aims = surface_.background().aims();
    const auto start = std::chrono::steady_clock::now();
    report_.initial = mesh_statistics(execution_, surface_);
    const bool conforms = report_.initial.in_range > adapted_share;
    is_adapted_ = conforms && report_.initial.mean_quality > least_adapted_quality;
    is_lattice_ = conforms && !is_adapted_;
    relocation_.expect_adapted(is_adapted_);
    find_work();
    surface_.is_on_facets = may_be_on_facets();
    do_rounds(rounds, report_.initial);
    if (aims.number_of_vertices > 0) meet_number(aims.number_of_vertices);
    refinement_.compact();
    if (aims.deviation > 0 && rounds > 0) meet_deviation(aims.deviation);
    if constexpr (Surface::avoids_intersections)
      if (surface_.intersections != nullptr && rounds > 0 && !is_in_vain()) part_faces();
    if constexpr (!std::is_same_v<IsFitted, std::false_type>)
      if (is_fitted && !is_in_vain()) {
        fit(shape_weight);
        Face_deviations<Surface> deviations(execution_, surface_, aims.deviation);
        if (aims.deviation > 0) measure(deviations);
      }
    const bool is_current = aims.number_of_vertices == 0 && !is_fitted && !is_restored_;
    report_.final = is_current ? current() : mesh_statistics(execution_, surface_);
    if (rounds > 0 && surface_.constraints != nullptr && !is_in_vain()) mend();
    warn(aims.deviation);
    report_.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return report_;
  }

private:
  /// The default thresholds, but a length may miss its range if that is better for the edges around: moves will
  /// equalise these.
  template <class Thresholds>
  static Thresholds weighed()
  {
    Thresholds thresholds;
    thresholds.weigh_neighbors = true;
    return thresholds;
  }

  using Metric = typename Surface::Metric;
  static constexpr bool is_anisotropic = Surface_mesh_adaptation::is_anisotropic<typename Surface::Metric>;

  static Swapping_thresholds swapping_thresholds()
  {
    Swapping_thresholds thresholds;
    if (is_anisotropic) thresholds.max_length = max_length_in_between;
    return thresholds;
  }

  /// Every vertex may have to move, and every edge to be split, but collapses and swaps need a short edge, a bad face or a
  /// curve: on a mesh that is adapted already there are few. Such a mesh is not regularized either, which would change it
  /// all over.
  void find_work()
  {
    const Mesh_view& mesh = surface_.mesh;
    const std::uint8_t everywhere = std::uint8_t(std::uint8_t(Activity::relocate) | std::uint8_t(Activity::refine) |
                                                 (is_adapted_ ? 0 : std::uint8_t(Activity::regularize)));
    fill(execution_, surface_.active, mesh.number_of_vertices(), everywhere);
    for_each_index(execution_, mesh.number_of_faces(), [&](std::size_t f) {
      if (mesh.is_removed_face(Index(f))) return;
      const std::array<Index, 3> v{mesh.corner[3 * f], mesh.corner[3 * f + 1], mesh.corner[3 * f + 2]};
      std::uint8_t kernels = 0;
      if (!surface_.has_quality(v[0], v[1], v[2], max_improvable_quality)) kernels |= std::uint8_t(Activity::swap);
      for (std::size_t i = 0; i < 3; ++i)
        if (surface_.vertex_class(v[i]) == Vertex_class::curve ||
            surface_.is_shorter(v[i], v[(i + 1) % 3], min_unit_length))
          kernels |= std::uint8_t(Activity::simplify);
      if (kernels != 0)
        for (const Index corner : v) activate(surface_, corner, kernels);
    });
  }

  const Mesh_statistics& current() const
  {
    return report_.after_round.empty() ? report_.initial : report_.after_round.back();
  }

  /// Lets the kernels work in a finer or coarser metric until the mesh has about `n` vertices: how many it has depends
  /// on how well it can fit the metric and, as lengths may vary, on the input. The metric itself stays as it is.
  void meet_number(double n)
  {
    double scale = 0; // its logarithm
    for (int i = 0; i < max_corrections && !report_.stopped; ++i) {
      const double missing = n - double(current().vertices), gap = std::log(n / double(current().vertices));
      if (std::abs(gap) < budget_precision) break;
      const double effective = least_effective_step(missing);
      const double wanted = missing > 0 ? (std::max)(gap, effective) : (std::min)(gap, effective);
      const double step = std::clamp(scale + wanted, -largest_scale, largest_scale) - scale;
      if (step == 0) break;
      surface_.scale_metric(execution_, std::exp(step));
      scale += step;
      find_work();
      correct_in_rounds();
    }
    surface_.scale_metric(execution_, std::exp(-scale));
  }

  /// Tightens the metric around the faces that leave the surface by more than is asked for, and adapts the mesh to that
  /// there. Those that leave it most go first: the number of vertices is not to grow without end where sizes are not
  /// what is missing, as at edges of the input that faces cross. One place that cannot be mended does not keep others from
  /// it, and where little is left, it is tried more often: each time other faces there come out too far away.
  /// Keeps the mesh that comes nearest to what is asked for, and says where it is still too far away.
  void meet_deviation(double asked)
  {
    const double most_vertices = largest_growth * double(surface_.mesh.number_of_vertices());
    Face_deviations<Surface> deviations(execution_, surface_, safety_of_deviation * asked);
    std::optional<Surface> best;
    double of_best = infinity, least = infinity, least_excess = infinity, first_excess = 0;
    int idle = 0;
    for (int i = 0; measure(deviations) > asked && i < max_corrections_of_deviation; ++i) {
      if (i == 0 && has_creases_at_first(deviations, asked)) return;
      const double excess = deviations.excess(execution_, asked);
      if (i == 0) first_excess = excess;
      const bool is_as_near = report_.deviation < largest_of_equals * least;
      const bool is_best = report_.deviation < least || (is_as_near && excess < least_excess);
      idle = is_best || excess < worthwhile_excess * least_excess ? 0 : idle + 1;
      if (is_best) {
        best = surface_;
        of_best = report_.deviation;
      }
      least = (std::min)(least, report_.deviation);
      least_excess = (std::min)(least_excess, excess);
      const int most_idle = least_excess < little_excess * first_excess ? idle_corrections_of_little : idle_corrections;
      if (idle >= most_idle || (idle > 0 && is_exhausted(deviations)) || !correct(deviations, most_vertices)) break;
    }
    work_everywhere();
    if (report_.deviation > of_best) restore(*best, of_best);
    mark_creases(deviations, asked);
  }

  /// Whether the last correction changed sizes at few vertices for the faces that are too far away: around most of these
  /// they are as small as they may be.
  bool is_exhausted(const Face_deviations<Surface>& deviations) const
  {
    return double(extent_) < vertices_around_face * double(deviations.number_above(execution_));
  }

  /// Where faces stay too far away, creases may be missing.
  void mark_creases(Face_deviations<Surface>& deviations, double asked)
  {
    if (!may_have_creases(asked) || !(report_.deviation > asked)) return;
    if (!is_restored_ || measure(deviations) > asked) surface_.creases->mark(surface_, deviations, asked);
  }

  bool has_creases_at_first(const Face_deviations<Surface>& deviations, double asked)
  {
    if (may_have_creases(asked)) surface_.creases->mark_at_first(execution_, surface_, deviations, asked);
    return is_in_vain();
  }

  /// Not where sizes may not be as small as the distance.
  bool may_have_creases(double asked) const
  {
    return surface_.creases != nullptr && !(surface_.background().aims().hmin > asked);
  }

  /// Whether all will be done again with more creases.
  bool is_in_vain() const { return surface_.creases != nullptr && surface_.creases->are_new(); }

  /// One correction of the faces that leave the surface. Returns whether there was anything left to do.
  bool correct(const Face_deviations<Surface>& deviations, double most_vertices)
  {
    const double left = most_vertices - double(surface_.mesh.number_of_vertices());
    if (left <= 0) return false;
    const double bound =
      (std::max)(deviations.allowed(), deviations.nth_largest(std::size_t(left / vertices_of_correction)));
    work_where(surface_.tighten_metric(execution_, size_factors(deviations, bound), limits_of_deviation()));
    if (extent_ == 0) return false;
    correct_in_rounds();
    refinement_.compact();
    return true;
  }

  /// Where faces meet and those of the input do not: lets the surface bulge by less than the gap between them, tightens the
  /// metric, and adapts the mesh to that there. With finer faces it comes nearer to the input, which does not meet itself.
  void part_faces()
  {
    auto& guard = *surface_.intersections;
    std::size_t at_first = 0;
    for (int i = 0; i < max_corrections_of_intersections && !report_.stopped; ++i) {
      const auto pairs = guard.new_pairs(execution_, surface_);
      if (i == 0) at_first = pairs.size();
      if (pairs.empty() || (i == corrections_for_half && 2 * pairs.size() > at_first)) break;
      guard.find_gaps(execution_, surface_);
      if (i == 0) surface_.bound_distance(execution_, guard.bounds_at_vertices(execution_));
      const std::vector<double> factors = guard.size_factors(execution_, surface_, pairs);
      if (factors.empty()) break; // sizes cannot part them
      work_where(surface_.tighten_metric(execution_, factors, limits_at_gaps));
      if (extent_ == 0) break;
      correct_in_rounds();
      refinement_.compact();
      is_parted_ = true;
    }
    work_everywhere();
  }

  Limits_of_tightening limits_of_deviation() const
  {
    const Metric_aims& aims = surface_.background().aims();
    return {least_factor_of_deviation, aims.hmin, aims.gradation};
  }

  void restore(const Surface& surface, double deviation)
  {
    surface_ = surface;
    report_.deviation = deviation;
    is_restored_ = true;
  }

  /// The largest distance of the mesh from the surface; 0 in a run that was stopped.
  double measure(Face_deviations<Surface>& deviations)
  {
    if (report_.stopped) return 0;
    deviations.update(execution_);
    report_.stopped = is_stopped(execution_);
    if (!report_.stopped) report_.deviation = deviations.largest(execution_);
    return report_.stopped ? 0 : report_.deviation;
  }

  /// What the sizes at the vertices are multiplied with around faces whose deviations exceed `bound`: deviations go with
  /// the squares of sizes. Steps that are too small would change no edge.
  std::vector<double> size_factors(const Face_deviations<Surface>& deviations, double bound) const
  {
    std::vector<double> factors(surface_.mesh.number_of_vertices());
    for_each_index(execution_, factors.size(), [&](std::size_t v) {
      double largest = 0;
      for (const Index f : surface_.faces_around(Index(v))) largest = (std::max)(largest, deviations[f]);
      factors[v] = largest > bound ? std::clamp(std::sqrt(bound / largest), strongest_step, weakest_step) : 1;
    });
    return factors;
  }

  /// Lets the kernels look at the vertices that are marked and those next to them, and at no others, but for long edges
  /// that are left.
  void work_where(const std::vector<std::uint8_t>& is_marked)
  {
    extent_ = count_if(execution_, is_marked.size(), [&](std::size_t v) { return is_marked[v] != 0; });
    refinement_.work_locally(true);
    for_each_index(execution_, is_marked.size(), [&](std::size_t v) {
      surface_.active[v] = std::uint8_t(surface_.active[v] & std::uint8_t(Activity::refine));
    });
    for_each_index(execution_, is_marked.size(), [&](std::size_t v) {
      if (is_marked[v] == 0) return;
      activate(surface_, Index(v));
      surface_.mesh.for_each_neighbor(Index(v), [&](Index w) { activate(surface_, w); });
    });
  }

  void work_everywhere()
  {
    extent_ = 0;
    refinement_.work_locally(false);
  }

  /// The logarithm of the scale at which as many edges leave the range as vertices are `missing`, or too many: a mesh
  /// whose edges are all well in range does not answer to less.
  double least_effective_step(double missing) const
  {
    const Mesh_view& mesh = surface_.mesh;
    std::vector<double> lengths = gather<double>(execution_, mesh.number_of_faces(), default_chunk_length,
                                                 [&](std::size_t begin, std::size_t end, std::vector<double>& list) {
      for (std::size_t h = 3 * begin; h < 3 * end; ++h)
        if (!mesh.is_removed_face(Mesh_view::face(Index(h))) && mesh.is_edge_owner(Index(h)))
          list.push_back(surface_.length(Index(h)));
    });
    const auto n = std::ptrdiff_t((std::min)(std::abs(missing), double(lengths.size() - 1)));
    const auto nth = missing > 0 ? lengths.end() - 1 - n : lengths.begin() + n;
    std::nth_element(lengths.begin(), nth, lengths.end());
    return 2 * std::log((missing > 0 ? max_unit_length : min_unit_length) / *nth);
  }

  /// Once the metric has changed: what the mesh is in the new one is what rounds have to gain on.
  void correct_in_rounds() { do_rounds(rounds_of_correction, mesh_statistics(execution_, surface_)); }

  /// At most `rounds`, while they gain something on `before`.
  void do_rounds(std::size_t rounds, Mesh_statistics before)
  {
    is_irregular_ = true;
    bool is_last = false;
    for (std::size_t i = 0; i < rounds && !report_.stopped; ++i) {
      visitor_.round_begins(round_, round_ + rounds - i);
      if (surface_.is_on_facets && (is_last || i + 1 == rounds)) leave_facets();
      do_round();
      relocation_.expect_adapted(false);
      report_.after_round.push_back(mesh_statistics(execution_, surface_));
      visitor_.round_done(round_, current());
      ++round_;
      ++report_.rounds;
      const bool may_be_worse = is_lattice_ && round_ == 1; // on the way out of a balance
      is_last = !is_improving(before) && !may_be_worse;
      if (is_last && !surface_.is_on_facets) break;
      before = current();
    }
    surface_.is_on_facets = false;
  }

  /// Whether much of the mesh is far too fine, and nothing keeps vertices from the patches meanwhile.
  bool may_be_on_facets() const
  {
    return !surface_.tolerance && report_.initial.mean_length < min_unit_length;
  }

  void leave_facets()
  {
    run_kernel("relocate", 1, [&](Sweep_counts& c) { return relocation_.leave_facets(c); });
  }

  void do_round()
  {
    std::size_t split = 0;
    const auto refine = [&](Sweep_counts& c) {
      if (refinement_.is_at_limit()) return std::size_t(0);
      return refinement_.sweep(negligible(split == 0 ? first_refine_share : refine_share), c);
    };
    const auto simplify = [&](Sweep_counts& c) { return simplification_.sweep(c); };
    const auto swap = [&](Sweep_counts& c) { return swapping_.sweep(c); };
    const auto swap_fans = [&](Sweep_counts& c) { // to the end: an apex changes only a few edges in a sweep
      const std::size_t swapped = swapping_.sweep(c);
      return refinement_.is_waiting() ? swapped : 0;
    };
    const auto regularize = [&](Sweep_counts& c) { return regularization_.sweep(c); };
    const auto relocate = [&](Sweep_counts& c) { return relocation_.sweep(c); };

    // Short edges go first: splitting the long ones beside them would multiply what is removed afterwards. And long
    // edges of needles are halved many times over: unless what this leaves behind is mended in between, the pieces of
    // one needle fill the surface with others.
    for (std::size_t i = 0; i < max_refine_sweeps; ++i) {
      const std::size_t collapsed = run_kernel("simplify", i == 0 ? max_simplify_sweeps : 1, simplify);
      run_kernel("swap", max_sweeps_on_fans, swap_fans);
      split = run_kernel("refine", 1, refine);
      if (refinement_.is_waiting() && split > 0) continue;
      // nor go on where what is split is what has been collapsed
      const bool may_go_round = is_anisotropic ? i > 0 : extent_ > 0 && i > 1;
      if (split <= negligible(refine_share) || (may_go_round && split <= collapsed)) break;
    }
    run_kernel("simplify", max_simplify_sweeps, simplify);
    run_kernel("swap", max_swap_sweeps, swap);
    if (!is_anisotropic && is_irregular_ && round_ > 0) { // in others it gains less than it costs
      const std::size_t regularized = run_kernel("regularize", max_regularize_sweeps, regularize);
      is_irregular_ = regularized > negligible(regularized_share);
      if (regularized > 0) run_kernel("swap", max_swap_sweeps, swap);
    }
    run_kernel("relocate", max_relocate_sweeps, relocate);
  }

  /// Says what was not reached.
  void warn(double deviation)
  {
    if (report_.stopped) return;
    const auto percent = [](double share) { return internal::number(std::round(1000 * share) / 10) + " %"; };
    if (refinement_.is_at_limit())
      report_.warnings.push_back("refinement was stopped at " + std::to_string(report_.final.vertices) +
                                 " vertices, far above what the metric asks for or at what is possible");
    if (report_.deviation > expected_excess * deviation)
      report_.warnings.push_back("faces are up to " + internal::number(report_.deviation) + " away from the surface, " +
                                 internal::number(std::round(10 * report_.deviation / deviation) / 10) +
                                 " times the tolerance of the sizes: ask for a `tolerance`, or give a finer input");
    if (is_parted_)
      report_.warnings.push_back("sizes are finer than asked for where sheets are too near each other for them");
    if (report_.final.in_range < expected_share)
      report_.warnings.push_back("only " + percent(report_.final.in_range) + " of the edges have the length asked for");
  }

  void fit(double shape_weight)
  {
    run_kernel("fit", 1, [&](Sweep_counts& counts) {
      Sampled_points points(execution_, surface_);
      ++counts.sweeps;
      counts.candidates += surface_.mesh.number_of_vertices();
      Fitting_thresholds thresholds{shape_weight, min_fitted_quality};
      thresholds.is_centering = true;
      Fitting fitting(execution_, surface_, points, thresholds);
      // vertices cross bends of the input, so faces come to see others
      return counts.applied += fitting.sweep(steps_of_fit(shape_weight), [&] { points.sample(execution_); });
    });
  }

  /// In the end, where faces are left that have no height.
  void mend()
  {
    if (!(report_.final.min_quality < min_quality_of_mended)) return;
    Mending mending(surface_, *surface_.constraints);
    if (run_kernel("mend", 1, [&](Sweep_counts& counts) { return mending.run(execution_, counts); }) == 0) return;
    refinement_.compact();
    report_.final = mesh_statistics(execution_, surface_);
  }

  /// With less weight vertices go farther, and need more steps for that.
  static int steps_of_fit(double shape_weight)
  {
    const double steps = least_steps_of_fit * std::sqrt(default_shape_weight / shape_weight);
    return int(std::clamp(std::ceil(steps), double(least_steps_of_fit), double(max_steps_of_fit)));
  }

  /// Whether so few operations are left that they can wait for the next round.
  bool is_negligible(std::size_t operations) const
  {
    return operations <= negligible(negligible_share);
  }

  /// Whether the last round gained enough in conformity or quality for another one to be worth it.
  bool is_improving(const Mesh_statistics& before) const
  {
    return current().in_range - before.in_range > least_gain ||
           current().mean_quality - before.mean_quality > least_gain;
  }

  std::size_t negligible(double share) const
  {
    return std::size_t(share * double(extent_ > 0 ? extent_ : surface_.mesh.number_of_vertices()));
  }

  /// Repeats `sweep` until there is little left to do.
  template <class Sweep>
  std::size_t run_kernel(const std::string& name, std::size_t max_sweeps, const Sweep& sweep)
  {
    if (report_.stopped) return 0;
    const auto start = std::chrono::steady_clock::now();
    Sweep_counts counts;
    for (std::size_t i = 0; i < max_sweeps && !is_stopped(execution_); ++i)
      if (is_negligible(sweep(counts))) break;
    Kernel_report& k = entry(name);
    k.sweeps += counts.sweeps;
    k.candidates += counts.candidates;
    k.applied += counts.applied;
    k.deferred += counts.deferred;
    k.seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    visitor_.kernel_done(k);
    report_.stopped = is_stopped(execution_) || !visitor_.go_on();
    return counts.applied;
  }

  /// The row of the report for a kernel in this round.
  Kernel_report& entry(const std::string& name)
  {
    for (Kernel_report& k : report_.kernels)
      if (k.round == round_ && k.kernel == name) return k;
    report_.kernels.emplace_back();
    report_.kernels.back().kernel = name;
    report_.kernels.back().round = round_;
    return report_.kernels.back();
  }

  static constexpr std::size_t max_refine_sweeps = 24;   // each halves the edges
  static constexpr std::size_t max_simplify_sweeps = 12;
  static constexpr std::size_t max_swap_sweeps = 4;
  static constexpr std::size_t max_sweeps_on_fans = 200; // of swaps: what is swapped then need not be split
  static constexpr std::size_t max_regularize_sweeps = 3;
  static constexpr std::size_t max_relocate_sweeps = 2;
  static constexpr double negligible_share = 0.004;
  static constexpr double refine_share = 0.01;           // a sweep rewrites the mesh, even for a single edge, so
  static constexpr double first_refine_share = 0.0015;   // a few edges wait for the first sweep of the next round
  static constexpr double regularized_share = 0.007;     // once there is less to do, rounds just let the mesh settle
  static constexpr int max_corrections = 8;              // of the metric, for a number of vertices
  static constexpr double largest_scale = 1.2;           // of the metric meanwhile, its logarithm: lengths by 1.8
  static constexpr double budget_precision = 0.03;
  static constexpr std::size_t rounds_of_correction = 3;
  static constexpr int max_corrections_of_deviation = 40, idle_corrections = 4, idle_corrections_of_little = 12;
  static constexpr double little_excess = 0.05; // of what it was at first
  static constexpr double vertices_around_face = 2; // at least, whose sizes change where they can
  static constexpr double infinity = std::numeric_limits<double>::infinity();
  static constexpr double largest_of_equals = 1.05; // of the largest deviations of two meshes
  static constexpr double worthwhile_excess = 0.9;  // what is left of it after a correction that gained something
  static constexpr int max_corrections_of_intersections = 6;
  static constexpr int corrections_for_half = 3; // of the pairs to vanish: else sizes do not part them
  static constexpr double least_factor_of_deviation = 0.01; // where that is not enough, sizes are not what is missing
  static constexpr Limits_of_tightening limits_at_gaps{1.0 / 32, 0, default_gradation}; // gaps are as narrow as they like
  static constexpr double safety_of_deviation = 0.9;     // once one is missed
  static constexpr double largest_growth = 10;           // of the number of vertices, for a deviation
  static constexpr double vertices_of_correction = is_anisotropic ? 4 : 2; // that a face costs which is too far away
  static constexpr double strongest_step = 0.5, weakest_step = 0.8; // of sizes, in one correction
  static constexpr int least_steps_of_fit = 4, max_steps_of_fit = 16;
  static constexpr double min_fitted_quality = 0.5;
  static constexpr double adapted_share = 0.95;          // of the edges in range
  static constexpr double least_adapted_quality = is_anisotropic ? 0 : 0.9; // in the mean; lattices have .866
  static constexpr double expected_share = 0.8;          // of the edges in range in the end: less is not usual
  static constexpr double expected_excess = 1.3;         // of a deviation over what was asked for, the same
  static constexpr double least_gain = 0.0015;           // in the share of edges in range or in mean quality

  const Execution& execution_;
  Surface& surface_;
  Visitor& visitor_;
  Refinement<Surface, Execution> refinement_;
  Simplification<Surface, Execution> simplification_;
  Swapping<Surface, Execution> swapping_;
  Regularization<Surface, Execution> regularization_;
  Relocation<Surface, Execution> relocation_;
  Adaptation_report report_;
  std::size_t round_ = 0;
  std::size_t extent_ = 0;   // number of vertices of the part that is worked on; 0: all
  bool is_adapted_ = false;  // from the beginning
  bool is_lattice_ = false;  // conforming, but of bad faces
  bool is_restored_ = false; // to an earlier state, behind the last round
  bool is_parted_ = false;   // by finer sizes where faces met
  bool is_irregular_ = true; // so much that it is worth to go on with regularization
};

} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_DRIVER_ADAPTATION_DRIVER_H
