// SPDX-License-Identifier: GPL-3.0-or-later
//
// That this program was compiled and linked, with a generated source for each header, is the test.

#include <CGAL/surface_mesh_adaptation.h>

#include <gtest/gtest.h>

#include <type_traits>

namespace SMA = CGAL::Surface_mesh_adaptation;

TEST(Headers, offer_all_public_names_through_one_include)
{
  EXPECT_TRUE((std::is_base_of_v<SMA::Adaptation_error, SMA::Io_error>));
  EXPECT_EQ(SMA::Uniform_metric_field(2).size, 2);
  EXPECT_EQ(SMA::Medit_field().components, 1);
  EXPECT_EQ(SMA::Sequential_execution().concurrency(), 1);
}
