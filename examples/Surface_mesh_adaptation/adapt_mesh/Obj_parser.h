// SPDX-License-Identifier: GPL-3.0-or-later
//
// OBJ files: points, faces with texture coordinates, and the objects, groups and materials that these belong to.

#ifndef ADAPT_MESH_OBJ_PARSER_H
#define ADAPT_MESH_OBJ_PARSER_H

#include "Label_list.h"
#include "Polygon_soup.h"
#include "Text_cursor.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace adapt_mesh {

class Obj_parser
{
public:
  /// \param text the content of the file `file`, which is named in errors only
  Obj_parser(const std::string& text, const std::string& file) : in_(text, file), labels_(soup_) {}

  /// \throws Io_error
  Polygon_soup parse()
  {
    for (; !in_.at_end(); in_.skip_line()) read_line();
    labels_.end(std::any_of(soup_.names.begin(), soup_.names.end(), [](const Label& l) { return !(l == Label()); }));
    if (!has_uv_) soup_.of_corners.clear();
    soup_.lost.assign(lost_.begin(), lost_.end());
    return std::move(soup_);
  }

private:
  void read_line()
  {
    const std::string_view word = in_.word_of_line();
    if (word.empty() || word[0] == '#') return;
    if (word == "v") read_point();
    else if (word == "f") read_face();
    else if (word == "vt") read_texture_coordinates();
    else if (word == "vn") soup_.has_normals = true;
    else if (word == "o") label_.object = in_.rest_of_line();
    else if (word == "g") label_.group = in_.rest_of_line();
    else if (word == "usemtl") label_.material = in_.rest_of_line();
    else if (word == "mtllib") soup_.material_library = in_.rest_of_line();
    else if (word == "s") lost_.insert("smoothing groups");
    else if (word == "l") lost_.insert("lines");
    else if (word == "p") lost_.insert("points");
    else if (!is_known(word)) in_.fail("not a valid obj file: unknown keyword");
  }

  /// What may stand in such a file and is of no account here: curves, surfaces, how it is to be displayed.
  static bool is_known(std::string_view word)
  {
    static const std::set<std::string_view> words = {
      "vp", "bevel", "lod", "ctech", "c_interp", "usemap", "stech", "d_interp", "shadow_obj", "trace_obj", "cstype",
      "deg", "step", "bmat", "con", "curv", "curv2", "surf", "parm", "trim", "hole", "scrv", "sp", "end", "bsp",
      "bzp", "cdc", "cdp", "res", "surf_1", "q0_1", "q1_1", "curv2d_1", "surf_2", "q0_2", "q1_2", "curv2d_2"};
    return words.count(word) != 0;
  }

  double coordinate()
  {
    if (in_.at_end_of_line()) in_.fail("a coordinate expected");
    return in_.number<double>("a coordinate");
  }

  void read_point()
  {
    const double x = coordinate(), y = coordinate(), z = coordinate();
    soup_.points.emplace_back(x, y, z);
  }

  void read_texture_coordinates()
  {
    std::array<double, 2> uv{};
    for (double& x : uv)
      if (!in_.at_end_of_line()) x = coordinate();
    texture_.push_back(uv);
    soup_.of_corners.resize(number_of_corners_); // of faces before the first of them
  }

  void read_face()
  {
    labels_.add(label_);
    soup_.polygons.emplace_back();
    while (!in_.at_end_of_line() && in_.peek() != '#') read_corner(soup_.polygons.back());
  }

  /// Corners are `v`, `v/vt`, `v/vt/vn` or `v//vn`.
  void read_corner(Polygon& polygon)
  {
    polygon.push_back(index(soup_.points.size()));
    std::size_t uv = none;
    if (in_.takes('/') && is_start_of_index(in_.peek())) uv = index(texture_.size());
    in_.skip_rest_of_word(); // with the normal
    ++number_of_corners_;
    if (texture_.empty()) return;
    has_uv_ = has_uv_ || uv < texture_.size();
    soup_.of_corners.push_back(uv < texture_.size() ? texture_[uv] : std::array<double, 2>{});
  }

  static bool is_start_of_index(char c) { return (c >= '0' && c <= '9') || c == '-'; }

  /// Counted from 1, or from the last one of `n` back if it is negative; none for what is neither.
  std::size_t index(std::size_t n)
  {
    const auto i = in_.number<long long>("an index");
    if (i > 0) return std::size_t(i - 1);
    return i < 0 && std::size_t(-i) <= n ? n - std::size_t(-i) : none;
  }

  static constexpr std::size_t none = std::size_t(-1);

  Text_cursor in_;
  Polygon_soup soup_;
  Label_list labels_;
  Label label_;
  std::vector<std::array<double, 2>> texture_;
  std::size_t number_of_corners_ = 0;
  std::set<std::string> lost_;
  bool has_uv_ = false;
};

} // namespace adapt_mesh

#endif // ADAPT_MESH_OBJ_PARSER_H
