// SPDX-License-Identifier: GPL-3.0-or-later
//
// Adapts a surface mesh to a metric: `adapt_mesh INPUT OUTPUT --size H` and the like, see `adapt_mesh --help`.

#include "adapt_mesh/Bad_input.h"
#include "adapt_mesh/Carried_fields.h"
#include "adapt_mesh/Interrupts.h"
#include "adapt_mesh/Output_file.h"
#include "adapt_mesh/Progress.h"
#include "adapt_mesh/adapt.h"
#include "adapt_mesh/execution.h"
#include "adapt_mesh/mesh_files.h"
#include "adapt_mesh/metric_files.h"
#include "adapt_mesh/options.h"
#include "adapt_mesh/sampled_distance.h"
#include "adapt_mesh/size_parameters.h"
#include "adapt_mesh/summary.h"

#include <CGAL/Surface_mesh_adaptation/Adaptation_report.h>
#include <CGAL/Surface_mesh_adaptation/exceptions.h>
#include <CGAL/Surface_mesh_adaptation/execution/keep_freed_memory.h>

#include <csignal>
#include <exception>
#include <fstream>
#include <iostream>
#include <new>
#include <optional>
#include <string>
#include <vector>

namespace adapt_mesh {

enum Exit_status { done = 0, failed = 1, bad_usage = 2, bad_input = 3 };

void append(std::vector<std::string>& all, const std::vector<std::string>& sentences)
{
  all.insert(all.end(), sentences.begin(), sentences.end());
}

/// The files that a run writes: all of them, or none.
class Outputs
{
public:
  explicit Outputs(const Options& options) : mesh_(options.output)
  {
    if (!options.output_metric.empty()) metric_.emplace(options.output_metric);
    if (!options.report.empty()) report_.emplace(options.report);
    if (!options.output_attributes.empty()) attributes_.emplace(options.output_attributes);
  }

  /// Adds warnings to the report before it writes it.
  void write(const Constrained_mesh& mesh, const Output_metric& metric, const Carried_fields& fields,
             SMA::Adaptation_report& report)
  {
    mesh_.write([&](const std::string& file) { append(report.warnings, write_mesh(file, mesh)); });
    if (metric_) metric_->write([&](const std::string& file) { write_metric(file, mesh.mesh, metric); });
    if (attributes_) attributes_->write([&](const std::string& file) { fields.write(file, mesh.mesh); });
    if (report_) report_->write([&](const std::string& file) { write_report(file, report); });
  }

  void commit()
  {
    if (report_) report_->commit();
    if (metric_) metric_->commit();
    if (attributes_) attributes_->commit();
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
  std::optional<Output_file> attributes_;
  std::optional<Output_file> report_;
};

void check_files(const Options& options)
{
  for (const std::string& file : {options.input, options.output})
    if (!is_mesh_format(file)) throw Usage_error(file + ": the format must be off, obj, ply, stl, mesh or meshb");
  for (const std::string& file : {options.metric, options.field, options.output_metric, options.attributes,
                                  options.output_attributes})
    if (!file.empty() && extension(file) != "sol" && extension(file) != "solb")
      throw Usage_error(file + ": the format must be sol or solb");
  if (!options.report.empty() && (options.report == options.output || options.report == options.output_metric))
    throw Usage_error(options.report + ": the same name for two outputs");
  if ((!options.metric.empty() || !options.field.empty()) && extension(options.input) == "stl")
    throw Usage_error("--metric and --field need vertices that are numbered, and those of an stl file are not");
}

/// Edges of the input that stay as they are.
void protect_edges(const Options& options, Constrained_mesh& mesh)
{
  for (const Edge e : mesh.mesh.edges())
    if ((options.boundary == "keep" && mesh.mesh.is_border(e)) || (options.protect && mesh.edge_is_constrained[e]))
      mesh.edge_is_protected[e] = true;
}

void run(const Options& options)
{
  check_files(options);
  check_execution(options);
  Interrupts interrupts;
  Outputs outputs(options);
  Progress progress(options.quiet, options.verbose);

  Constrained_mesh mesh;
  reading(options.input, [&] {
    read_mesh(options.input, mesh, {!options.no_weld, options.repair, !options.no_references});
  });
  protect_edges(options, mesh);
  put_size_parameters(options, mesh);
  const Carried_fields fields(options, mesh);
  const Mesh input = options.quiet ? Mesh() : mesh.mesh;
  Output_metric output_metric;
  output_metric.wanted = !options.output_metric.empty();
  if (output_metric.wanted)
    output_metric.map = mesh.mesh.add_property_map<Vertex, SMA::Metric_tensor_3>("v:metric").first;

  const auto adapt = options.flat ? adapt_on_triangles : adapt_on_patches;
  SMA::Adaptation_report report = adapt(options, mesh, output_metric, fields, progress);
  append(report.repairs, mesh.repairs);
  append(report.warnings, mesh.warnings);
  outputs.write(mesh, output_metric, fields, report);
  interrupts.ignore();
  outputs.commit();
  interrupts.end();
  if (options.quiet) return;
  print_warnings(report);
  const double distance = with_execution(options, [&](const auto& execution) {
    return sampled_distance(execution, input, mesh.mesh);
  });
  print_summary(report, distance, diagonal(input));
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
    else run(options);
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
