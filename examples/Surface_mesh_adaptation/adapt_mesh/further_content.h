// SPDX-License-Identifier: GPL-3.0-or-later
//
// What an obj or stl file holds beside points and faces. Looks at words only, the readers find the errors.

#ifndef ADAPT_MESH_FURTHER_CONTENT_H
#define ADAPT_MESH_FURTHER_CONTENT_H

#include "Polygon_soup.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdlib>
#include <set>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

namespace adapt_mesh {

namespace internal {

inline std::string_view first_word(std::string_view line)
{
  line.remove_prefix((std::min)(line.find_first_not_of(" \t\r"), line.size()));
  return line.substr(0, line.find_first_of(" \t\r"));
}

/// Calls `f(line)` for the lines of `text`, until it returns `false`.
template <class F>
void for_each_line(std::string_view text, const F& f)
{
  while (!text.empty()) {
    const std::size_t end = text.find('\n');
    if (!f(text.substr(0, end))) return;
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
  }
}

inline std::string rest_of_line(std::string_view line, std::string_view word)
{
  line.remove_prefix(std::size_t(word.data() + word.size() - line.data()));
  const std::size_t first = line.find_first_not_of(" \t\r");
  if (first == std::string_view::npos) return "";
  return std::string(line.substr(first, line.find_last_not_of(" \t\r") + 1 - first));
}

/// Labels that are given one after another.
class Label_list
{
public:
  explicit Label_list(Polygon_soup& soup) : soup_(soup) {}

  /// Labels the next polygon.
  void add(const Label& label)
  {
    if (soup_.names.empty() || !(soup_.names[std::size_t(last_)] == label)) {
      const auto found = std::find(soup_.names.begin(), soup_.names.end(), label);
      last_ = int(found - soup_.names.begin());
      if (found == soup_.names.end()) soup_.names.push_back(label);
    }
    soup_.labels.push_back(last_);
  }

  /// Forgets them if they say nothing, or not what they belong to.
  void end(bool say_something)
  {
    if (say_something && soup_.labels.size() == soup_.polygons.size()) return;
    soup_.labels.clear();
    soup_.names.clear();
  }

private:
  Polygon_soup& soup_;
  int last_ = 0;
};

/// Objects, groups and materials of an obj file, and its texture coordinates.
class Obj_content
{
public:
  explicit Obj_content(Polygon_soup& soup) : soup_(soup), labels_(soup) {}

  void read(std::string_view text)
  {
    for_each_line(text, [&](std::string_view line) {
      read_line(line);
      return true;
    });
    labels_.end(std::any_of(soup_.names.begin(), soup_.names.end(), [](const Label& l) { return !(l == Label()); }));
    const bool fits = has_uv_ && soup_.of_corners.size() == number_of_corners();
    if (!fits) soup_.of_corners.clear();
    soup_.lost.insert(soup_.lost.end(), lost_.begin(), lost_.end());
    if (has_uv_ && !fits) soup_.lost.push_back("texture coordinates");
  }

private:
  void read_line(std::string_view line)
  {
    const std::string_view word = first_word(line);
    if (word == "v") return;
    if (word == "f") read_face(line, word);
    else if (word == "vt") read_texture_coordinates(rest_of_line(line, word));
    else if (word == "vn") soup_.has_normals = true;
    else if (word == "o") label_.object = rest_of_line(line, word);
    else if (word == "g") label_.group = rest_of_line(line, word);
    else if (word == "usemtl") label_.material = rest_of_line(line, word);
    else if (word == "mtllib") soup_.material_library = rest_of_line(line, word);
    else if (word == "s") lost_.insert("smoothing groups");
    else if (word == "l") lost_.insert("lines");
    else if (word == "p") lost_.insert("points");
  }

  void read_texture_coordinates(const std::string& numbers)
  {
    std::istringstream in(numbers);
    std::array<double, 2> uv{};
    in >> uv[0] >> uv[1];
    texture_.push_back(uv);
  }

  /// Corners are `v`, `v/vt`, `v/vt/vn` or `v//vn`; negative indices count from the last one.
  void read_face(std::string_view line, std::string_view word)
  {
    labels_.add(label_);
    std::istringstream in(rest_of_line(line, word));
    for (std::string corner; in >> corner;) {
      const std::size_t slash = corner.find('/');
      const long index = slash == std::string::npos ? 0 : std::strtol(corner.c_str() + slash + 1, nullptr, 10);
      const long i = index < 0 ? long(texture_.size()) + index : index - 1;
      const bool exists = i >= 0 && std::size_t(i) < texture_.size();
      has_uv_ = has_uv_ || exists;
      soup_.of_corners.push_back(exists ? texture_[std::size_t(i)] : std::array<double, 2>{});
    }
  }

  std::size_t number_of_corners() const
  {
    std::size_t n = 0;
    for (const Polygon& p : soup_.polygons) n += p.size();
    return n;
  }

  Polygon_soup& soup_;
  Label_list labels_;
  Label label_;
  std::vector<std::array<double, 2>> texture_;
  std::set<std::string> lost_;
  bool has_uv_ = false;
};

/// The solids of a text file. (Binary ones hold attributes that mean what their writer wants.)
inline void read_solids(std::string_view text, Polygon_soup& soup)
{
  if (text.find('\0') != std::string_view::npos) return;
  Label_list labels(soup);
  Label label;
  std::size_t solids = 0;
  for_each_line(text, [&](std::string_view line) {
    const std::string_view word = first_word(line);
    if (word == "facet") labels.add(label);
    if (word != "solid") return true;
    label.group = rest_of_line(line, word);
    ++solids;
    return true;
  });
  labels.end(solids > 1);
  if (solids > 1 && soup.labels.empty()) soup.lost.push_back("the division into " + std::to_string(solids) + " solids");
}

} // namespace internal

/// Adds what the text of an obj or stl file holds beside points and faces.
inline void read_further_content(const std::string& format, std::string_view text, Polygon_soup& soup)
{
  if (format == "obj") internal::Obj_content(soup).read(text);
  else internal::read_solids(text, soup);
}

} // namespace adapt_mesh

#endif // ADAPT_MESH_FURTHER_CONTENT_H
