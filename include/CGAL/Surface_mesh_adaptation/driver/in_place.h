// SPDX-License-Identifier: GPL-3.0-or-later
//
// What every entry point does around its kernels: read the parameters, import the mesh, build the reference and the
// metric, run, and write the result back.

#ifndef CGAL_SURFACE_MESH_ADAPTATION_DRIVER_IN_PLACE_H
#define CGAL_SURFACE_MESH_ADAPTATION_DRIVER_IN_PLACE_H

#include <CGAL/Surface_mesh_adaptation/Adaptation_report.h>
#include <CGAL/Surface_mesh_adaptation/driver/carried_jets.h>
#include <CGAL/Surface_mesh_adaptation/driver/carried_values.h>
#include <CGAL/Surface_mesh_adaptation/driver/domain.h>
#include <CGAL/Surface_mesh_adaptation/driver/size_bounds.h>
#include <CGAL/Surface_mesh_adaptation/driver/unpack_parameters.h>
#include <CGAL/Surface_mesh_adaptation/execution/Any_execution.h>
#include <CGAL/Surface_mesh_adaptation/execution/execution.h>
#include <CGAL/Surface_mesh_adaptation/fields/background_of_field.h>
#include <CGAL/Surface_mesh_adaptation/kernels/Adapted_surface.h>
#include <CGAL/Surface_mesh_adaptation/kernels/Late_creases.h>
#include <CGAL/Surface_mesh_adaptation/kernels/Self_intersection_guard.h>
#include <CGAL/Surface_mesh_adaptation/mesh/face_graph.h>
#include <CGAL/Surface_mesh_adaptation/mesh/locality.h>
#include <CGAL/Surface_mesh_adaptation/parameters.h>
#include <CGAL/Surface_mesh_adaptation/surface/collapse_needles.h>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_adaptation {

constexpr unsigned default_number_of_rounds = 8;

namespace internal {

template <class Domain, class Surface, class NamedParameters>
void write_metric(const Domain& domain, const Surface& surface, const NamedParameters& np)
{
  if constexpr (has_parameter<NamedParameters, internal_np::output_metric_map_t>) {
    auto map = CGAL::parameters::get_parameter(np, internal_np::output_metric_map);
    domain.for_each_vertex([&](Index i, const auto& v) { put(map, v, surface.metrics[i].tensor()); });
  }
}

constexpr double share_of_operations = 0.95; // of the tolerance, at first

/// The tolerance that the parameters ask for; infinite if none.
/// \throws Invalid_parameter_error
template <class NamedParameters>
double tolerance_of(const NamedParameters& np)
{
  const double distance = choose(np, internal_np::tolerance, std::numeric_limits<double>::infinity());
  if (!(distance > 0)) throw Invalid_parameter_error("the tolerance must be positive");
  return distance;
}

/// An upper bound of the distance between what is adapted and the adapted mesh; a coarse one where that leaves the tolerance.
template <class Surface>
double certified_distance(const Any_execution& execution, const Tolerance& tolerance, const Surface& surface)
{
  constexpr double precision = 0.02; // of the tolerance
  const Triangle_tree output(execution, surface.mesh, surface.points);
  return hausdorff_distance_bound(execution, tolerance.input, output,
                                  {precision * tolerance.distance, tolerance.distance});
}

/// Rounds the points of `surface` to what a `Point` holds: what faces meet depends on the last bit.
template <class Point, class Surface>
void round_to_points(const Any_execution& execution, Surface& surface)
{
  if constexpr (std::is_same_v<std::decay_t<decltype(std::declval<Point>().x())>, float>)
    for_each_index(execution, surface.points.size(), [&](std::size_t v) {
      for (double& x : surface.points[v]) {
        const volatile float rounded = float(x); // else GCC 12 leaves it out for some, where it makes vectors of them
        x = rounded;
      }
    });
}

/// Calls `adapt()`, which returns a report with a certified distance, with ever stricter operations, which look at more and
/// more points, until that distance is within the tolerance, or until it is known that all `is_in_vain(report)`.
/// \throws Tolerance_error
template <class Adapt, class Is_in_vain>
Adaptation_report adapt_within(Tolerance& tolerance, const Adapt& adapt, const Is_in_vain& is_in_vain)
{
  constexpr int max_attempts = 4;
  constexpr double safety = 0.9, least_step = 0.85; // what is missing is mostly points, see `Covered_points`
  for (int attempt = 1;; ++attempt) {
    const Adaptation_report report = adapt();
    if (report.certified_distance <= tolerance.distance || is_in_vain(report)) return report;
    if (attempt == max_attempts || report.stopped) throw Tolerance_error(report.certified_distance, tolerance.distance);
    tolerance.of_operations *= (std::max)(least_step, safety * tolerance.distance / report.certified_distance);
    tolerance.points_on_edges = 4 * tolerance.points_on_edges + 3;
  }
}

/// `adapt_in_place` where it is not interrupted before the kernels begin.
template <class Domain, class MetricField, class NamedParameters, class Kernels>
class In_place_adaptation
{
public:
  /// All live as long as this.
  In_place_adaptation(const Any_execution& execution, Domain& domain, const MetricField& field, const NamedParameters& np,
                      const Kernels& kernels)
    : execution_(execution), domain_(domain), field_(field), np_(np), kernels_(kernels), points_(point_map(domain.graph(), np))
  {}

  /// \throws Interrupted
  Adaptation_report run()
  {
    read();
    creases_.emplace(imported_.mesh, imported_.points, values_->features());
    if (avoids_intersections()) guard_.emplace(imported_.mesh, imported_.points, surroundings_);
    bool is_done = false;
    while (!is_done) {
      const Reference reference(execution_, imported_.mesh, imported_.points, features(), given_);
      with_input_numbers(domain_.graph(), imported_, [&] {
        with_background_within(execution_, field_, Field_input{imported_.vertices, deviations_}, reference, bounds_,
                               [&](const auto& background) { is_done = adapt_to(reference, background); });
      });
      const Effect_of_interruption count_all(execution_.interruption(), Interruption::Effect::none);
      report_.fallback_patches = reference.number_of_fallbacks(execution_);
    }
    report_.threads = execution_.concurrency();
    report_.self_intersections = intersections_;
    warn();
    return report_;
  }

private:
  using Reconstruction = std::decay_t<decltype(choose(std::declval<const NamedParameters&>(),
                                                      internal_np::surface_reconstruction, Gregory_reconstruction()))>;
  using Reference = Reference_surface<Reconstruction>;
  using Points = std::decay_t<decltype(point_map(std::declval<Domain&>().graph(), std::declval<const NamedParameters&>()))>;
  using Point = typename boost::property_traits<Points>::value_type;
  static constexpr double infinity = std::numeric_limits<double>::infinity();
  static constexpr bool may_avoid_intersections =
    has_parameter<NamedParameters, internal_np::avoid_self_intersections_t>;
  static constexpr bool may_count_intersections =
    has_parameter<NamedParameters, internal_np::count_self_intersections_t>;

  /// Those of the input, and what attempts so far have shown to be needed.
  Feature_parameters features() const
  {
    Feature_parameters result = creases_->constrained(values_->features());
    result.largest_bulge = largest_bulges();
    return guard_ ? guard_->constrained(std::move(result)) : result;
  }

  /// Of the patches at each vertex of the input: what is put farther away would be refused. Faces need room, too.
  std::vector<double> largest_bulges() const
  {
    constexpr double share_of_gap = 0.19; // insides bulge by a third more: no point is to be drawn back by `near_input()` then
    constexpr double share_of_tolerance = 0.4;
    std::vector<double> result;
    if (guard_) result = guard_->bounds_at_vertices(execution_);
    const double within = tolerance_ ? share_of_tolerance * tolerance_->of_operations : infinity;
    const double largest = (std::min)(within, largest_bulge_);
    if (result.empty() && largest == infinity) return result;
    result.resize(imported_.points.size(), infinity);
    for (double& x : result) x = (std::min)(share_of_gap * x, largest);
    return result;
  }

  void warn()
  {
    if (creases_->number() > 0 && !report_.stopped)
      report_.warnings.push_back(std::to_string(creases_->number()) +
                                 " edges of the input are ridges besides, for faces across them do not come near enough");
    if (guard_ && guard_->number_of_kept_faces() > 0)
      report_.warnings.push_back(std::to_string(guard_->number_of_kept_faces()) +
                                 " faces of the input stay where it comes too near to itself for the sizes");
    if (intersections_.after > intersections_.before)
      report_.warnings.push_back("faces intersect that did not, or in more pairs than before: ask to "
                                 "`avoid_self_intersections` (`--no-self-intersections`)");
  }

  void read()
  {
    imported_ = domain_.import(execution_, points_);
    const Renumbering numbers = improve_locality(execution_, imported_);
    domain_.check_fans(execution_, imported_, numbers);
    values_.emplace(domain_, imported_, np_);
    surroundings_ =
      domain_.surroundings(points_, [this](const Mesh_view& mesh, Index f) { return values_->is_inside(mesh, f); });
    if constexpr (may_count_intersections) {
      intersections_.are_counted = choose(np_, internal_np::count_self_intersections, false);
      if (intersections_.are_counted) intersections_.before = count_intersections(imported_);
    }
    if (may_mend()) collapse_needles();
    with_input_numbers(domain_.graph(), imported_, [&] { given_ = given_jets(imported_, np_); });
    make_tolerance();
    bounds_ = vertex_size_bounds(domain_.graph(), imported_, np_);
    deviations_ = face_deviations(domain_.graph(), imported_, np_);
    if (may_mend()) values_->swap_caps(execution_, imported_, largest_negligible());
  }

  /// Not where that may make faces meet, nor in a part, beside which others may be that match.
  bool may_mend() const { return !avoids_intersections() && !Domain::is_part; }

  void collapse_needles()
  {
    const Collapsed_needles needles = Surface_mesh_adaptation::collapse_needles(
      execution_, imported_.mesh, imported_.points, values_->features(), largest_negligible());
    if (needles.number == 0) return;
    moved_ = needles.moved;
    remove_holes(execution_, imported_);
    values_.emplace(domain_, imported_, np_);
  }

  /// Length of what may be mended: little of the tolerance.
  double largest_negligible() const { return 0.01 * tolerance_of(np_); }

  bool avoids_intersections() const { return choose(np_, internal_np::avoid_self_intersections, false); }

  template <class Mesh>
  std::size_t count_intersections(const Mesh& m)
  {
    const auto start = std::chrono::steady_clock::now();
    const std::size_t n = guard_ ? guard_->all_pairs(execution_, m).size()
                                 : self_intersections(execution_, m.mesh, m.points, surroundings_).size();
    intersections_.seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return n;
  }

  void make_tolerance()
  {
    const double distance = tolerance_of(np_);
    if (distance == infinity) return;
    tolerance_ = Tolerance{distance, share_of_operations * distance,
                           Triangle_tree(execution_, imported_.mesh, imported_.points)};
  }

  /// Adapts the mesh to the metric of `background` and writes it. Returns `false`, with nothing written, if all is to be
  /// done again with other constraints.
  template <class Background>
  bool adapt_to(const Reference& reference, const Background& background)
  {
    using Metric = std::decay_t<decltype(background.at(reference, Location(), Surface_point()))>;
    std::optional<Adapted_surface<Metric, Reconstruction, may_avoid_intersections>> surface;
    const auto attempt = [&] {
      surface.emplace(execution_, reference, background, tolerance_ ? &*tolerance_ : nullptr);
      surface->creases = &*creases_;
      if (!avoids_intersections()) surface->constraints = &values_->features();
      if constexpr (may_avoid_intersections)
        if (guard_) guard(*surface);
      return adapt(*surface);
    };
    report_ = tolerance_ ? adapt_within(*tolerance_, attempt, [&](const auto& report) { return is_in_vain(report); }) : attempt();
    if (is_in_vain(report_)) {
      creases_->take_new();
      if (creases_->is_coarse()) largest_bulge_ = (std::min)(largest_bulge_, reference.doubtful_bulge());
      return false;
    }
    const Effect_of_interruption once(execution_.interruption(), effect_after(report_));
    if constexpr (may_avoid_intersections)
      if (guard_ && !accepts(*surface)) return false;
    const Effect_of_interruption write_all(execution_.interruption(), Interruption::Effect::none);
    write(reference, *surface);
    surface->release(execution_);
    return true;
  }

  /// Whether all is to be done again with more creases.
  bool is_in_vain(const Adaptation_report& report) const { return creases_->are_new() && !report.stopped; }

  template <class Surface>
  void guard(Surface& surface)
  {
    surface.intersections = &*guard_;
    std::vector<double> bounds = guard_->bounds_at_vertices(execution_);
    if (!bounds.empty()) surface.bound_distance(execution_, std::move(bounds));
  }

  /// One run of the kernels, and what it came to.
  template <class Surface>
  Adaptation_report adapt(Surface& surface)
  {
    surface.max_number_of_vertices =
      largest_number_of_vertices(choose(np_, internal_np::maximum_number_of_vertices, std::size_t(-1)));
    if (limits_.empty()) surface.follow_protected_edges(execution_, protected_gradation(np_));
    else surface.limit_sizes(execution_, limits_);
    check_expected_size(execution_, surface, surface.max_number_of_vertices);
    Adaptation_report result = [&] {
      const Effect_of_interruption leave_out(execution_.interruption(), Interruption::Effect::leave_out);
      return kernels_(execution_, surface);
    }();
    result.seconds = seconds_ += result.seconds;
    const Effect_of_interruption once(execution_.interruption(), effect_after(result));
    if (guard_ || intersections_.are_counted) round_to_points<Point>(execution_, surface);
    if (!tolerance_ || is_in_vain(result)) return result;
    result.tolerance = tolerance_->distance;
    result.certified_distance = moved_ + certified_distance(execution_, *tolerance_, surface);
    return result;
  }

  /// Whether the mesh has no new self-intersections. If it has, the next attempt is asked for more.
  /// \throws Self_intersection_error
  template <class Surface>
  bool accepts(const Surface& surface)
  {
    const std::vector<Face_pair> pairs = guard_->new_pairs(execution_, surface);
    if (pairs.empty()) return true;
    if (report_.stopped) throw Self_intersection_error(pairs.size());
    limits_ = surface.limits();
    guard_->find_gaps(execution_, surface);
    guard_->keep_faces(surface, pairs);
    return false;
  }

  /// A run that was stopped already is brought to its end.
  static Interruption::Effect effect_after(const Adaptation_report& report)
  {
    return report.stopped ? Interruption::Effect::none : Interruption::Effect::give_up;
  }

  template <class Surface>
  void write(const Reference& reference, Surface& surface)
  {
    if constexpr (may_count_intersections)
      if (intersections_.are_counted) intersections_.after = count_intersections(surface);
    values_->prepare(execution_, surface);
    const Carried_jets<NamedParameters> jets(execution_, reference, surface.locations.size(), [&](std::size_t v) {
      return surface.locations[v];
    }, np_);
    domain_.write(execution_, imported_, surface, points_, [&](Index f) { return values_->is_inside(surface.mesh, f); });
    values_->write(surface); // what nobody passed first
    write_metric(domain_, surface, np_);
    jets.write(domain_);
  }

  const Any_execution& execution_;
  Domain& domain_;
  const MetricField& field_;
  const NamedParameters& np_;
  const Kernels& kernels_;
  Points points_;
  Imported_mesh<typename Domain::Graph> imported_;
  std::optional<Carried_values<Domain, NamedParameters>> values_;
  Given_jets given_;
  double largest_bulge_ = infinity; // of patches, once faces have shown that the input is too coarse for them
  std::optional<Tolerance> tolerance_;
  std::optional<Late_creases> creases_;
  std::optional<Self_intersection_guard> guard_;
  Surroundings surroundings_;
  double moved_ = 0; // how far what is adapted is from the input, at most
  Vertex_size_bounds bounds_;
  std::vector<double> deviations_; // that each face of the input asks for
  Self_intersection_counts intersections_;
  Size_limits limits_; // of an attempt before, with finer sizes where faces met
  double seconds_ = 0; // of all attempts
  Adaptation_report report_;
};

/// Runs `kernels(execution, surface)`, which returns a report, on `domain`.
template <class Domain, class MetricField, class NamedParameters, class Kernels>
Adaptation_report adapt_in_place(const Any_execution& execution, Domain domain, const MetricField& field,
                                 const NamedParameters& np, const Kernels& kernels)
{
  try {
    return In_place_adaptation(execution, domain, field, np, kernels).run();
  } catch (const Interrupted&) {
    Adaptation_report report;
    report.stopped = true;
    report.threads = execution.concurrency();
    return report;
  }
}

} // namespace internal
} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_DRIVER_IN_PLACE_H
