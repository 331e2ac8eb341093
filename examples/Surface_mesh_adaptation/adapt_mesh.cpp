// SPDX-License-Identifier: GPL-3.0-or-later
//
// Adapts a surface mesh to a metric: `adapt_mesh INPUT OUTPUT --size H` and the like, see `adapt_mesh --help`.

#include "adapt_mesh/Output_file.h"
#include "adapt_mesh/Progress.h"
#include "adapt_mesh/execution.h"
#include "adapt_mesh/mesh_files.h"
#include "adapt_mesh/metric_files.h"
#include "adapt_mesh/options.h"
#include "adapt_mesh/summary.h"

#include <CGAL/Surface_mesh_adaptation/keep_freed_memory.h>
#include <CGAL/surface_mesh_adaptation.h>

#include <csignal>
#include <exception>
#include <fstream>
#include <functional>
#include <iostream>
#include <limits>
#include <new>
#include <optional>
#include <stdexcept>
#include <string>

namespace adapt_mesh {

enum Exit_status { done = 0, failed = 1, bad_usage = 2, bad_input = 3 };

/// A file that was given cannot be used.
struct Bad_input : std::runtime_error
{
  using std::runtime_error::runtime_error;
};

/// Calls `use()`; if it rejects what the file `file` holds, says so and names the file.
template <class Use>
auto blaming(const std::string& file, const Use& use)
{
  try {
    return use();
  } catch (const SMA::Invalid_input_error& e) {
    throw Bad_input(file + ": " + e.what());
  } catch (const SMA::Empty_mesh_error& e) {
    throw Bad_input(file + ": " + e.what());
  }
}

/// As above, where nothing is written: an error of a file is then about the input.
template <class Read>
auto reading(const std::string& file, const Read& read)
{
  try {
    return blaming(file, read);
  } catch (const SMA::Io_error& e) {
    throw Bad_input(e.what());
  }
}

/// The files that a run writes: all of them, or none.
class Outputs
{
public:
  explicit Outputs(const Options& options) : mesh_(options.output)
  {
    if (!options.output_metric.empty()) metric_.emplace(options.output_metric);
    if (!options.report.empty()) report_.emplace(options.report);
  }

  void write(const Constrained_mesh& mesh, const Output_metric& metric, const SMA::Adaptation_report& report)
  {
    mesh_.write([&](const std::string& file) { write_mesh(file, mesh); });
    if (metric_) metric_->write([&](const std::string& file) { write_metric(file, mesh.mesh, metric); });
    if (report_) report_->write([&](const std::string& file) { write_report(file, report); });
  }

  void commit()
  {
    if (report_) report_->commit();
    if (metric_) metric_->commit();
    mesh_.commit();
  }

private:
  static void write_report(const std::string& file, const SMA::Adaptation_report& report)
  {
    std::ofstream out(file);
    report.write_json(out);
    if (!out.flush()) throw SMA::Io_error(file, 0, "cannot be written");
  }

  Output_file mesh_;
  std::optional<Output_file> metric_;
  std::optional<Output_file> report_;
};

void check_files(const Options& options)
{
  for (const std::string& file : {options.input, options.output})
    if (!is_mesh_format(file)) throw Usage_error(file + ": the format must be off, obj, ply, stl or mesh");
  for (const std::string& file : {options.metric, options.field, options.output_metric})
    if (!file.empty() && extension(file) != "sol") throw Usage_error(file + ": the format must be sol");
  if (!options.report.empty() && (options.report == options.output || options.report == options.output_metric))
    throw Usage_error(options.report + ": the same name for two outputs");
  if ((!options.metric.empty() || !options.field.empty()) && extension(options.input) == "stl")
    throw Usage_error("--metric and --field need vertices that are numbered, and those of an stl file are not");
}

/// Sets what the options say of any metric that is made from data.
template <class Field>
Field configured(const Options& options, Field field)
{
  field.hmin = options.hmin;
  field.hmax = options.hmax;
  if (options.gradation) field.gradation = *options.gradation;
  return field;
}

SMA::Curvature_metric_field curvature_field(const Options& options)
{
  constexpr double any_tolerance = 0.001;  // with a number of vertices the tolerance follows from it
  constexpr double largest_gap = 2.5;      // of meshes with the sizes for a tolerance, in units of that
  const double tolerance = options.curvature > 0   ? options.curvature
                           : options.vertices > 0  ? any_tolerance
                                                   : options.tolerance / largest_gap;
  auto field = configured(options, SMA::Curvature_metric_field(tolerance));
  field.anisotropic = options.anisotropic;
  if (options.curvature == 0) field.vertices = std::size_t(options.vertices);
  return field;
}

auto solution_field(const Options& options, Constrained_mesh& mesh)
{
  const SMA::Medit_solution values = reading(options.field, [&] { return read_scalars(options.field, mesh); });
  auto field = configured(options, SMA::Solution_metric_field(scalar_map(values, mesh), std::size_t(options.vertices)));
  field.norm = options.norm.value_or(field.norm);
  field.anisotropic = options.anisotropic;
  return field;
}

/// What several fields ask for, or one that is to be scaled or graded.
template <class... Fields>
auto intersection(const Options& options, const Fields&... fields)
{
  auto field = configured(options, SMA::Intersection_metric_field(fields...));
  if (!options.gradation && !options.metric.empty()) field.gradation = 1;
  field.vertices = std::size_t(options.vertices);
  return field;
}

/// Calls `adapt(field)` with the metric of a file.
template <class Adapt>
SMA::Adaptation_report with_metric_of_file(const Options& options, Constrained_mesh& mesh, const Adapt& adapt)
{
  const SMA::Medit_solution metric = reading(options.metric, [&] { return read_metric(options.metric, mesh); });
  const Size_bounds bounds(options.hmin, options.hmax);
  const auto adapt_to = [&](const auto& map) {
    return options.vertices > 0 || options.gradation ? adapt(intersection(options, map)) : adapt(map);
  };
  return metric.components == 1 ? adapt_to(reading(options.metric, [&] { return size_map(metric, mesh, bounds); }))
                                : adapt_to(reading(options.metric, [&] { return tensor_map(metric, mesh, bounds); }));
}

/// Calls `adapt(field)` with the metric field that the options ask for.
template <class Adapt>
SMA::Adaptation_report with_metric_field(const Options& options, Constrained_mesh& mesh, const Adapt& adapt)
{
  if (options.size > 0) return adapt(SMA::Uniform_metric_field(options.size));
  if (!options.metric.empty()) return with_metric_of_file(options, mesh, adapt);
  if (options.field.empty()) return adapt(curvature_field(options));
  const auto solution = solution_field(options, mesh);
  return options.curvature > 0 ? adapt(intersection(options, solution, curvature_field(options))) : adapt(solution);
}

template <class Execution>
SMA::Adaptation_report adapt(const Options& options, const Execution& execution, Constrained_mesh& mesh,
                             const Output_metric& output_metric, Progress& progress)
{
  constexpr double none = std::numeric_limits<double>::infinity();
  const double tolerance = options.tolerance > 0 ? options.tolerance * diagonal(mesh.mesh) : none;
  const auto parameters =
    SMA::parameters::detect_features(!options.no_features)
      .feature_angle(options.feature_angle.value_or(45))
      .edge_is_constrained_map(mesh.edge_is_constrained)
      .vertex_is_constrained_map(mesh.vertex_is_constrained)
      .number_of_iterations(options.rounds > 0 ? unsigned(options.rounds) : SMA::default_number_of_rounds)
      .output_metric_map(output_metric)
      .tolerance(tolerance)
      .fit_to_surface(options.fit)
      .shape_weight_of_fit(options.shape_weight.value_or(SMA::default_shape_weight))
      .visitor(std::ref(progress));
  SMA::Adaptation_report report = with_metric_field(options, mesh, [&](const auto& field) {
    return blaming(options.input, [&] { return SMA::adapt_surface_mesh(execution, mesh.mesh, field, parameters); });
  });
  progress.finish();
  return report;
}

template <class Execution>
void run(const Options& options, const Execution& execution)
{
  check_files(options);
  Outputs outputs(options);
  Progress progress(options.quiet, options.verbose);

  Constrained_mesh mesh;
  reading(options.input, [&] { read_mesh(options.input, mesh); });
  if (!options.quiet)
    for (const std::string& warning : mesh.warnings) std::cerr << "adapt_mesh: warning: " << warning << '\n';
  const Mesh input = options.quiet ? Mesh() : mesh.mesh;
  Output_metric output_metric;
  output_metric.wanted = !options.output_metric.empty();
  if (output_metric.wanted)
    output_metric.map = mesh.mesh.add_property_map<Vertex, SMA::Metric_tensor_3>("v:metric").first;

  const SMA::Adaptation_report report = adapt(options, execution, mesh, output_metric, progress);
  outputs.write(mesh, output_metric, report);
  if (!progress.go_on()) throw std::runtime_error("interrupted, nothing was written");
  outputs.commit();
  if (!options.quiet) print_summary(report, input, mesh.mesh);
}

Exit_status guarded_main(int argc, char* argv[])
{
  const auto complain = [](const std::string& what, Exit_status status) {
    std::cerr << "adapt_mesh: " << what << '\n';
    return status;
  };
  try {
    const Options options = parse_options(argc, argv);
    if (options.help) print_help(std::cout);
    else if (options.version) std::cout << "adapt_mesh " SMA_VERSION "\n";
    else with_execution(options, [&](const auto& execution) { run(options, execution); });
    return done;
  } catch (const Usage_error& e) {
    return complain(std::string(e.what()) + " (see adapt_mesh --help)", bad_usage);
  } catch (const SMA::Invalid_parameter_error& e) {
    return complain(e.what(), bad_usage);
  } catch (const Bad_input& e) {
    return complain(e.what(), bad_input);
  } catch (const std::bad_alloc&) {
    return complain("out of memory", failed);
  } catch (const std::exception& e) {
    return complain(e.what(), failed);
  }
}

} // namespace adapt_mesh

int main(int argc, char* argv[])
{
  adapt_mesh::SMA::keep_freed_memory();
  std::signal(SIGXFSZ, SIG_IGN); // a file beyond the limit is an error like any other
  return adapt_mesh::guarded_main(argc, argv);
}
