// SPDX-License-Identifier: GPL-3.0-or-later
//
// Labels of the polygons of a file that are given one after another.

#ifndef ADAPT_MESH_LABEL_LIST_H
#define ADAPT_MESH_LABEL_LIST_H

#include "Polygon_soup.h"

#include <algorithm>
#include <cstddef>

namespace adapt_mesh {

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

  /// Forgets them if they say nothing.
  void end(bool say_something)
  {
    if (say_something) return;
    soup_.labels.clear();
    soup_.names.clear();
  }

private:
  Polygon_soup& soup_;
  int last_ = 0;
};

} // namespace adapt_mesh

#endif // ADAPT_MESH_LABEL_LIST_H
