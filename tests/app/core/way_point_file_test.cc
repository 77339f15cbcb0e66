#include "app/core/way_point_file.h"

#include <gtest/gtest.h>

#include "tests/support/config_checks.h"
#include "tests/support/temp_folder.h"

namespace lakshya {
namespace {

std::string way_point_refusal(const std::string& text) {
  return refusal([&] { (void)parse_way_points(text, "course.csv"); });
}

TEST(WayPointFile, MetresAreTakenAsTheyAre) {
  const TempFolder folder;
  const auto points = read_way_points(
      folder.write("course.csv", std::string("# round the yard\r\neast_m,north_m\r\n3, 0\r\n\n -1.5,4e1\n")));
  ASSERT_EQ(points.size(), 2U);
  EXPECT_EQ(points[0].east_m, 3);
  EXPECT_EQ(points[0].north_m, 0);
  EXPECT_EQ(points[1].east_m, -1.5);
  EXPECT_EQ(points[1].north_m, 40);
}

TEST(WayPointFile, DegreesCountFromTheFirstLine) {
  const auto points = parse_way_points("latitude_deg,longitude_deg\n45,7\n45.001,7\n45,7.001\n", "course.csv");
  ASSERT_EQ(points.size(), 2U);
  EXPECT_NEAR(points[0].north_m, 111.13, 0.01);
  EXPECT_NEAR(points[0].east_m, 0, 1e-9);
  EXPECT_NEAR(points[1].east_m, 78.85, 0.01);
}

TEST(WayPointFile, RefusalsNameTheLine) {
  expect_parts(way_point_refusal(""), {"course.csv", "empty file"});
  expect_parts(way_point_refusal("1,2\n"), {"line 1", "the first line is east_m,north_m or latitude_deg"});
  expect_parts(way_point_refusal("east_m,north_m\n"), {"no way points"});
  expect_parts(way_point_refusal("latitude_deg,longitude_deg\n45,7\n"), {"no way points"});
  expect_parts(way_point_refusal("east_m,north_m\n1,2\n3\n"), {"line 3", "two numbers"});
  expect_parts(way_point_refusal("east_m,north_m\n1,2,3\n"), {"line 2", "2,3"});
  expect_parts(way_point_refusal("east_m,north_m\nnan,2\n"), {"line 2"});
  expect_parts(way_point_refusal("east_m,north_m\n0,1e6\n"), {"line 2", "100 km"});
  expect_parts(way_point_refusal("latitude_deg,longitude_deg\n91,7\n"), {"line 2", "latitude"});
  expect_parts(way_point_refusal("latitude_deg,longitude_deg\n45,7\n47,7\n"), {"line 3", "100 km"});
  std::string many = "east_m,north_m\n";
  for (int i = 0; i <= 10'000; ++i)
    many += "1,1\n";
  expect_parts(way_point_refusal(many), {"line 10002", "more than 10000"});
}

}  // namespace
}  // namespace lakshya
