// SPDX-License-Identifier: GPL-3.0-or-later
//
// What a file holds beside points and faces, and will be lost. Looks at words only, the readers find the errors.

#ifndef ADAPT_MESH_LOST_CONTENT_H
#define ADAPT_MESH_LOST_CONTENT_H

#include <algorithm>
#include <array>
#include <cstddef>
#include <set>
#include <string>
#include <string_view>
#include <utility>
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

inline std::vector<std::string> lost_content_of_obj(std::string_view text)
{
  constexpr std::array<std::pair<const char*, const char*>, 8> kinds = {
    {{"vt", "texture coordinates"}, {"vn", "normals"}, {"usemtl", "materials"}, {"g", "groups"},
     {"o", "objects"}, {"s", "smoothing groups"}, {"l", "lines"}, {"p", "points"}}};
  std::set<std::string> lost;
  for_each_line(text, [&](std::string_view line) {
    const std::string_view word = first_word(line);
    if (word == "f" || (word == "v" && line.size() < 20)) return true;
    for (const auto& [keyword, name] : kinds)
      if (word == keyword) lost.insert(name);
    return true;
  });
  return {lost.begin(), lost.end()};
}

/// Text files may hold several solids. (Binary ones hold attributes that mean what their writer wants.)
inline std::vector<std::string> lost_content_of_stl(std::string_view text)
{
  std::size_t solids = 0;
  if (text.find('\0') != std::string_view::npos) return {};
  for_each_line(text, [&](std::string_view line) {
    if (first_word(line) == "solid") ++solids;
    return true;
  });
  if (solids > 1) return {"the division into " + std::to_string(solids) + " solids"};
  return {};
}

} // namespace internal

/// Names of what the text of an obj or stl file holds beside points and faces.
inline std::vector<std::string> lost_content(const std::string& format, std::string_view text)
{
  return format == "obj" ? internal::lost_content_of_obj(text) : internal::lost_content_of_stl(text);
}

} // namespace adapt_mesh

#endif // ADAPT_MESH_LOST_CONTENT_H
