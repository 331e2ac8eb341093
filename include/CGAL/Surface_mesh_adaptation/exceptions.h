// SPDX-License-Identifier: GPL-3.0-or-later
//
// What goes wrong, one type per cause. Everything thrown by the package derives from `Adaptation_error`.

#ifndef CGAL_SURFACE_MESH_ADAPTATION_EXCEPTIONS_H
#define CGAL_SURFACE_MESH_ADAPTATION_EXCEPTIONS_H

#include <cstddef>
#include <sstream>
#include <stdexcept>
#include <string>

namespace CGAL {
namespace Surface_mesh_adaptation {
/// \addtogroup PkgSurfaceMeshAdaptationReports
/// @{

namespace internal {

/// A number as it stands in messages, to six digits.
inline std::string number(double x)
{
  std::ostringstream out;
  out << x;
  return out.str();
}

} // namespace internal

/// Base of every exception of the package.
class Adaptation_error : public std::runtime_error
{
public:
  using std::runtime_error::runtime_error;
};

/// An input that was rejected before anything was changed; `index()` is the first offending element, counted in the
/// order in which the mesh (or the file) lists its elements, from 0.
class Invalid_input_error : public Adaptation_error
{
public:
  /// Says `what` of the element with that `index`; `element` is its kind, "vertex" for instance.
  Invalid_input_error(const std::string& what, const std::string& element, std::size_t index)
    : Adaptation_error(what + " (" + element + " " + std::to_string(index) + ")"), index_(index)
  {}

  std::size_t index() const { return index_; }  ///< of the first offending element

private:
  std::size_t index_;
};

/// Defines the class `NAME` of inputs of which an element is wrong: constructed from its index.
#define CGAL_SMA_INVALID_INPUT_ERROR(NAME, WHAT, ELEMENT)                           \
  class NAME : public Invalid_input_error                                          \
  {                                                                                \
  public:                                                                          \
    explicit NAME(std::size_t index) : Invalid_input_error(WHAT, ELEMENT, index) {} \
  }

/// A face with other than three corners.
CGAL_SMA_INVALID_INPUT_ERROR(Non_triangular_face_error, "the mesh has a face that is not a triangle", "face");

/// A vertex whose incident faces do not form one fan, or an isolated vertex.
CGAL_SMA_INVALID_INPUT_ERROR(Non_manifold_vertex_error, "the faces around a vertex do not form a single fan", "vertex");

/// Two faces that share two vertices but are not neighbours across them: the mesh is not a simplicial surface.
CGAL_SMA_INVALID_INPUT_ERROR(Non_simplicial_edge_error, "two edges join the same two vertices", "vertex");

/// A coordinate that is NaN or infinite.
CGAL_SMA_INVALID_INPUT_ERROR(Non_finite_coordinate_error, "the mesh has a coordinate that is not finite", "vertex");

/// A size that is not positive and finite, or a tensor that is not symmetric positive definite and finite.
CGAL_SMA_INVALID_INPUT_ERROR(Invalid_metric_error, "the metric is not finite and positive definite", "vertex");

/// A value of a scalar field that is NaN or infinite.
CGAL_SMA_INVALID_INPUT_ERROR(Invalid_field_error, "the value of the field is not finite", "vertex");

/// A normal given for a vertex that is zero, NaN or infinite, or a shape operator that is not finite.
CGAL_SMA_INVALID_INPUT_ERROR(Invalid_normal_error, "the normal is zero or it or the shape operator is not finite", "vertex");

#undef CGAL_SMA_INVALID_INPUT_ERROR

/// An input with no face.
class Empty_mesh_error : public Adaptation_error
{
public:
  Empty_mesh_error() : Adaptation_error("the mesh has no face") {}
};

/// An input that is so large, or so small, that squares of lengths would overflow or underflow; or a single place.
class Invalid_extent_error : public Adaptation_error
{
public:
  /// \param extent largest side of the bounding box, or largest coordinate
  explicit Invalid_extent_error(double extent)
    : Adaptation_error("the extent of the mesh is " + internal::number(extent) +
                       ", not within 1e-100 and 1e100: scale it")
    , extent_(extent)
  {}

  double extent() const { return extent_; } ///< largest side of the bounding box, or largest coordinate

private:
  double extent_;
};

/// A parameter outside its domain.
class Invalid_parameter_error : public Adaptation_error
{
public:
  using Adaptation_error::Adaptation_error;
};

/// The metric asks for more vertices than can be numbered, or than the memory or a limit of the user allow: check its
/// units.
class Mesh_too_large_error : public Adaptation_error
{
public:
  /// What a metric asks for, and what is possible.
  struct Estimate
  {
    double vertices = 0;      ///< that the metric asks for
    std::size_t largest = 0;  ///< number of vertices that is possible
    double size = 0;          ///< the smallest that is asked for at a vertex
    double diagonal = 0;      ///< of the bounding box
  };

  /// The metric asks for too many.
  explicit Mesh_too_large_error(const Estimate& e)
    : Adaptation_error("the metric asks for about " + internal::number(e.vertices) + " vertices, and " +
                       std::to_string(e.largest) + " are possible: its smallest size is " + internal::number(e.size) +
                       ", and the diagonal of the mesh " + internal::number(e.diagonal))
    , estimate_(e)
  {}

  /// The mesh itself has more elements than can be numbered.
  Mesh_too_large_error(std::size_t elements, std::size_t largest)
    : Adaptation_error("the mesh has " + std::to_string(elements) + " elements of a kind, and no more than " +
                       std::to_string(largest) + " can be numbered")
    , estimate_{double(elements), largest, 0, 0}
  {}

  const Estimate& estimate() const { return estimate_; }  ///< what was asked for, and what is possible

private:
  Estimate estimate_;
};

/// The distance between the input and the output could not be kept below the tolerance asked for.
class Tolerance_error : public Adaptation_error
{
public:
  /// The upper bound that was found, and what was asked for.
  Tolerance_error(double distance, double tolerance)
    : Adaptation_error("the adapted mesh may be as far as " + internal::number(distance) +
                       " from the input, above the tolerance of " + internal::number(tolerance))
    , distance_(distance), tolerance_(tolerance)
  {}

  double distance() const { return distance_; }   ///< the upper bound that was found
  double tolerance() const { return tolerance_; }  ///< that was asked for

private:
  double distance_, tolerance_;
};

/// Faces that meet where those of the input do not could not be avoided.
class Self_intersection_error : public Adaptation_error
{
public:
  /// The number of pairs of such faces.
  explicit Self_intersection_error(std::size_t pairs)
    : Adaptation_error("the adapted mesh has " + std::to_string(pairs) +
                       " pairs of faces that intersect where those of the input do not"), pairs_(pairs)
  {}

  std::size_t pairs() const { return pairs_; }  ///< that intersect

private:
  std::size_t pairs_;
};

/// A file that cannot be read or written; `line()` is the offending line, from 1, or 0 if there is none.
class Io_error : public Adaptation_error
{
public:
  /// Says `what` of a line, from 1, or of all of the file if `line` is 0.
  Io_error(const std::string& file, std::size_t line, const std::string& what)
    : Adaptation_error(file + (line == 0 ? "" : ":" + std::to_string(line)) + ": " + what), line_(line)
  {}

  std::size_t line() const { return line_; }  ///< from 1; 0: none

private:
  std::size_t line_;
};

/// @}
} // namespace Surface_mesh_adaptation
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_ADAPTATION_EXCEPTIONS_H
