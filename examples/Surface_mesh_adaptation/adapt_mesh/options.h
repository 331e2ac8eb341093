// SPDX-License-Identifier: GPL-3.0-or-later
//
// The command line of adapt_mesh.

#ifndef ADAPT_MESH_OPTIONS_H
#define ADAPT_MESH_OPTIONS_H

#include <boost/program_options.hpp>

#include <cmath>
#include <initializer_list>
#include <optional>
#include <ostream>
#include <stdexcept>
#include <string>

namespace adapt_mesh {

/// The command line makes no sense.
struct Usage_error : std::runtime_error
{
  using std::runtime_error::runtime_error;
};

struct Options
{
  std::string input;
  std::string output;
  double size = 0; ///< 0 if not given, like all numbers here
  double curvature = 0;
  std::string metric; ///< a file, empty if not given
  std::string field;  ///< the same
  int metric_number = 0; ///< which of the fields in the file
  int field_number = 0;  ///< the same
  std::optional<double> norm; ///< p of L^p, may be infinite
  bool anisotropic = false;
  int vertices = 0;
  int max_vertices = 0;
  std::optional<double> gradation;
  double tolerance = 0;
  bool no_self_intersections = false;
  bool no_intersection_count = false;
  bool flat = false;
  bool fit = false;
  std::optional<double> shape_weight;
  double hmin = 0;
  double hmax = 0;
  std::optional<double> feature_angle; ///< in degrees
  bool no_features = false;
  bool smooth_borders = false;
  std::string boundary;        ///< keep or resample, empty if not given
  bool protect = false;
  bool no_references = false;
  std::string parameters;        ///< a file
  std::string attributes;        ///< the same
  std::string output_attributes; ///< the same
  bool no_weld = false;
  bool repair = false;
  int rounds = 0;
  int threads = 0;
  std::string execution; ///< empty: the best one that was built in
  std::string output_metric;
  std::string report;
  bool quiet = false;
  bool verbose = false;
  bool help = false;
  bool version = false;
};

namespace internal {

namespace po = boost::program_options;

inline po::options_description described_options(Options& o)
{
  po::options_description described("Options");
  // clang-format off
  described.add_options()
    ("size", po::value(&o.size)->value_name("H"), "uniform target edge length")
    ("curvature", po::value(&o.curvature)->value_name("EPS"),
     "sizes from the curvature, which aim at a distance to the surface of EPS times the diagonal of the bounding box")
    ("metric", po::value(&o.metric)->value_name("FILE.sol"),
     "sizes (1 value) or tensors (6 values: xx xy yy xz yz zz) at the vertices of the input")
    ("field", po::value(&o.field)->value_name("FILE.sol"),
     "values at the vertices of the input, of which the interpolation error is to be as small as --vertices allow; with "
     "--curvature: the intersection of both")
    ("metric-number", po::value(&o.metric_number)->value_name("I"),
     "which field of the file of --metric is meant, from 1 (default: the first scalar or tensor)")
    ("field-number", po::value(&o.field_number)->value_name("I"),
     "which field of the file of --field is meant, from 1 (default: the first scalar)")
    ("norm", po::value<double>()->value_name("P")->notifier([&](double p) { o.norm = p; }),
     "the L^P norm in which --field measures the error, 1 to inf (default: 2)")
    ("anisotropic", po::bool_switch(&o.anisotropic),
     "stretch the faces along the directions in which the surface bends, or the field varies, less")
    ("vertices", po::value(&o.vertices)->value_name("N"),
     "number of vertices to aim at: with sizes from the curvature if nothing else is given, else with those of --field "
     "or --metric, scaled")
    ("max-vertices", po::value(&o.max_vertices)->value_name("N"),
     "refuse what needs more vertices than these (default: as many as the memory holds)")
    ("hmin", po::value(&o.hmin)->value_name("H"), "lower bound on the sizes")
    ("hmax", po::value(&o.hmax)->value_name("H"), "upper bound on the sizes")
    ("gradation", po::value<double>()->value_name("R")->notifier([&](double r) { o.gradation = r; }),
     "the sizes at two points one size apart differ by at most this factor; 1: no bound (default: 1.5, but 1.3 for "
     "isotropic sizes from the curvature alone, and no bound for --metric)")
    ("feature-angle", po::value<double>()->value_name("DEG")->notifier([&](double a) { o.feature_angle = a; }),
     "edges whose faces meet at a larger angle are kept sharp (default: 45)")
    ("no-features", po::bool_switch(&o.no_features), "do not look for sharp edges")
    ("smooth-borders", po::bool_switch(&o.smooth_borders),
     "keep the outlines of the planes of a CAD tessellation where fillets and the like join them smoothly")
    ("boundary", po::value(&o.boundary)->value_name("WHICH"),
     "keep: boundary edges stay as they are; resample: they are split and collapsed like others (default)")
    ("protect", po::bool_switch(&o.protect),
     "ridges and other marked edges of the input stay as they are, as required ones do")
    ("no-references", po::bool_switch(&o.no_references),
     "forget labels of faces: references, groups, materials, solids; required elements count as ridges and corners")
    ("parameters", po::value(&o.parameters)->value_name("FILE.mmgs"),
     "bounds on the sizes by the references of the triangles, as mmgs reads them, and distances there in place of that of "
     "--curvature")
    ("attributes", po::value(&o.attributes)->value_name("FILE.sol"),
     "fields at the vertices of the input, any number of them, to be carried to the output")
    ("output-attributes", po::value(&o.output_attributes)->value_name("FILE.sol"), "where to write these")
    ("tolerance", po::value(&o.tolerance)->value_name("EPS"),
     "keep the Hausdorff distance between input and output below EPS times the diagonal of the bounding box, and certify "
     "it; if nothing else says how fine the mesh is to be, few faces, with sizes from the curvature for that distance")
    ("no-self-intersections", po::bool_switch(&o.no_self_intersections),
     "no faces of the output meet where those of the input do not; sizes get finer where sheets are too near each other")
    ("no-intersection-count", po::bool_switch(&o.no_intersection_count),
     "do not count the pairs of faces that intersect, in the input and in the output")
    ("flat", po::bool_switch(&o.flat),
     "the triangles of the input are the surface, instead of smooth patches through their vertices")
    ("fit", po::bool_switch(&o.fit),
     "let the faces run through the surface instead of touching it with their vertices, and so nearer to it")
    ("shape-weight", po::value<double>()->value_name("W")->notifier([&](double w) { o.shape_weight = w; }),
     "what the shape of the faces counts with --fit, up to 1: the smaller, the nearer and the worse shaped (default: 0.02)")
    ("no-weld", po::bool_switch(&o.no_weld),
     "leave coincident vertices apart, which are joined along seams otherwise")
    ("repair", po::bool_switch(&o.repair),
     "mend an input that is no valid surface: leave out what makes no sense, cut apart where more than two faces meet")
    ("rounds", po::value(&o.rounds)->value_name("N"), "number of rounds of the kernels")
    ("threads", po::value(&o.threads)->value_name("N"), "number of threads (default: all)")
    ("execution", po::value(&o.execution)->value_name("WHICH"),
     "sequential, tbb or openmp (default: the best one that was built in)")
    ("output-metric", po::value(&o.output_metric)->value_name("FILE.sol"),
     "write the metric at the vertices of the output")
    ("report", po::value(&o.report)->value_name("FILE.json"), "write the report of the run")
    ("quiet", po::bool_switch(&o.quiet), "print errors only")
    ("verbose", po::bool_switch(&o.verbose), "print each step")
    ("version", po::bool_switch(&o.version), "print the version")
    ("help", po::bool_switch(&o.help), "print this text");
  // clang-format on
  return described;
}

inline void check_positive(const po::variables_map& given, const Options& o)
{
  const auto check = [&](const char* name, double value) {
    if (given.count(name) != 0 && !(std::isfinite(value) && value > 0))
      throw Usage_error(std::string("--") + name + " must be a positive number");
  };
  check("size", o.size);
  check("curvature", o.curvature);
  check("tolerance", o.tolerance);
  check("hmin", o.hmin);
  check("hmax", o.hmax);
  check("rounds", o.rounds);
  check("threads", o.threads);
  check("vertices", o.vertices);
  check("max-vertices", o.max_vertices);
  check("metric-number", o.metric_number);
  check("field-number", o.field_number);
  if (o.norm && !(*o.norm >= 1)) throw Usage_error("--norm must be at least 1, or inf");
  if (o.gradation && !(std::isfinite(*o.gradation) && *o.gradation >= 1))
    throw Usage_error("--gradation must be at least 1");
  if (o.feature_angle && !(*o.feature_angle > 0 && *o.feature_angle <= 180))
    throw Usage_error("--feature-angle must be an angle in degrees, above 0 and up to 180");
  if (o.shape_weight && !(*o.shape_weight > 0 && *o.shape_weight <= 1))
    throw Usage_error("--shape-weight must be above 0 and up to 1");
}

inline void check_consistent(const Options& o)
{
  if (o.input.empty() || o.output.empty()) throw Usage_error("INPUT and OUTPUT are required");
  const bool has_field = !o.field.empty(), has_metric = !o.metric.empty(), has_curvature = o.curvature > 0;
  if (int(o.size > 0) + int(has_metric) + int(has_field || has_curvature) > 1)
    throw Usage_error("only --field and --curvature go together: else give one of --size, --curvature, --metric, --field");
  if (!(o.size > 0) && !has_metric && !has_field && !has_curvature && o.vertices == 0 && !(o.tolerance > 0))
    throw Usage_error("one of --size, --curvature, --metric, --field, --vertices and --tolerance is required");
  if (has_field && o.vertices == 0) throw Usage_error("--field needs --vertices");
  if (has_curvature && !has_field && o.vertices > 0)
    throw Usage_error("--vertices contradicts --curvature: both say how fine the mesh is to be");
  if (o.norm && !has_field) throw Usage_error("--norm needs --field");
  if (o.field_number > 0 && !has_field) throw Usage_error("--field-number needs --field");
  if (o.metric_number > 0 && !has_metric) throw Usage_error("--metric-number needs --metric");
  if (o.anisotropic && (o.size > 0 || has_metric))
    throw Usage_error("--anisotropic needs --curvature, --field, --vertices or --tolerance");
  if (o.size > 0 && (o.hmin > 0 || o.hmax > 0)) throw Usage_error("--hmin and --hmax contradict --size");
  if (o.size > 0 && (o.vertices > 0 || o.gradation)) throw Usage_error("--vertices and --gradation contradict --size");
  if (o.hmin > 0 && o.hmax > 0 && o.hmin > o.hmax) throw Usage_error("--hmin is larger than --hmax");
  if (!o.boundary.empty() && o.boundary != "keep" && o.boundary != "resample")
    throw Usage_error("--boundary must be keep or resample");
  if (o.attributes.empty() != o.output_attributes.empty())
    throw Usage_error("--attributes and --output-attributes need each other");
  if (!o.parameters.empty() && o.no_references) throw Usage_error("--parameters contradicts --no-references");
  if (o.no_features && o.feature_angle) throw Usage_error("--feature-angle contradicts --no-features");
  if (o.shape_weight && !o.fit) throw Usage_error("--shape-weight needs --fit");
  if (o.quiet && o.verbose) throw Usage_error("--quiet contradicts --verbose");
  if (o.execution == "sequential" && o.threads > 1) throw Usage_error("--threads needs a parallel --execution");
}

} // namespace internal

inline void print_help(std::ostream& out)
{
  Options options;
  out
    << "Usage: adapt_mesh INPUT OUTPUT [options]\n\n"
       "Adapts the triangulated surface in INPUT to a metric and writes it to OUTPUT. The formats follow from the\n"
       "extensions: off, obj, ply, stl, mesh or meshb (MEDIT), and sol or solb for fields. One of --size, --curvature,\n"
       "--metric, --field, --vertices and --tolerance is required.\n\n"
    << internal::described_options(options) << "\nExit status: 0 done, 1 failed, 2 wrong usage, 3 unusable input.\n";
}

/// \throws Usage_error
inline Options parse_options(int argc, char* argv[])
{
  namespace po = internal::po;
  Options options;
  po::options_description all = internal::described_options(options);
  all.add_options()("input", po::value(&options.input))("output", po::value(&options.output));
  po::positional_options_description positions;
  positions.add("input", 1).add("output", 1);
  using Style = po::command_line_style::style_t;
  const int style = po::command_line_style::default_style & ~Style::allow_guessing;

  po::variables_map given;
  try {
    po::store(po::command_line_parser(argc, argv).options(all).positional(positions).style(style).run(), given);
    po::notify(given);
  } catch (const po::error& e) {
    throw Usage_error(e.what());
  }
  if (options.help || options.version) return options;
  internal::check_positive(given, options);
  internal::check_consistent(options);
  return options;
}

} // namespace adapt_mesh

#endif // ADAPT_MESH_OPTIONS_H
