#include "app/tools/map_file.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>

#include "app/core/input_error.h"
#include "kernels/base/units.h"
#include "tests/support/temp_folder.h"

namespace lakshya {
namespace {

const std::string kSmall = R"({"rows":2,"cols":3,"cell_m":0.1,"type":[[0,1,2],[1,1,1]]})";

class MapFileTest : public ::testing::Test {
 protected:
  MapFile read(const std::string& text) { return read_map(folder_.write("map", text), 0.25); }

  // The reason of the refusal, without the path; empty when the map is accepted.
  std::string refusal(const std::string& text) {
    try {
      read(text);
      return "";
    } catch (const InputError& e) {
      return std::string(e.what()).substr(folder_.path("map").size() + 2);
    }
  }

  // The small map with `from` replaced by `to`.
  std::string refusal_with(const std::string& from, const std::string& to) {
    std::string text = kSmall;
    const std::size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos);
    return refusal(text.replace(at, from.size(), to));
  }

  // kSmall with one more key.
  std::string refusal_of(const std::string& key_and_value) { return refusal_with("}", "," + key_and_value + "}"); }

  TempFolder folder_;
};

bool starts(const std::string& text, const std::string& with) {
  return text.starts_with(with);
}

TEST_F(MapFileTest, ReadsWhatAMapNeeds) {
  const MapFile map = read(kSmall);
  EXPECT_EQ(map.geometry.rows, 2);
  EXPECT_EQ(map.geometry.cols, 3);
  EXPECT_EQ(map.geometry.cell_mm, 100);
  ASSERT_EQ(map.type.width(), 3);
  ASSERT_EQ(map.type.height(), 2);
  EXPECT_EQ(map.type.view().at(0, 0), kCellObstacle);
  EXPECT_EQ(map.type.view().at(2, 0), kCellUnknown);
  EXPECT_EQ(map.type.view().at(0, 1), kCellUnoccupied);
  EXPECT_EQ(map.count.width(), 0);
  EXPECT_EQ(map.mean_height_m.width(), 0);
}

TEST_F(MapFileTest, ReadsEveryPlane) {
  const MapFile map = read(
      R"({"rows":1,"cols":2,"cell_m":0.5,"type":[[0,1]],"count":[[4294967295,0]],"mean_height_m":[[-0.25,1]],
          "floor_count":[[1,2]],"below_count":[[3,4]],"note":"ignored"})");
  EXPECT_EQ(map.count.view().at(0, 0), 4294967295U);
  EXPECT_EQ(map.mean_height_m.view().at(0, 0), -0.25);
  EXPECT_EQ(map.mean_height_m.view().at(1, 0), 1.0);
  EXPECT_EQ(map.floor_count.view().at(1, 0), 2U);
  EXPECT_EQ(map.below_count.view().at(0, 0), 3U);
}

TEST_F(MapFileTest, WhatIsWrittenIsReadBack) {
  const GridGeometry g{.rows = 2, .cols = 3, .cell_mm = 125};
  Image<std::uint32_t> count(3, 2, 0);
  Image<std::int64_t> sum(3, 2, 0);
  Image<std::uint32_t> floor(3, 2, 7);
  Image<std::uint32_t> below(3, 2, 0);
  Image<std::uint8_t> type(3, 2, kCellUnknown);
  count.view().at(1, 0) = 3;
  sum.view().at(1, 0) = 1000;  // mean 333.3 mm
  count.view().at(2, 1) = 2;
  sum.view().at(2, 1) = -15;  // mean -7.5 mm
  below.view().at(0, 1) = 4294967295U;
  type.view().at(1, 0) = kCellObstacle;
  const std::string text = write_map_json({g, count.view(), sum.view(), floor.view(), below.view(), type.view()});

  EXPECT_EQ(text.substr(0, text.find(",\n\"count\"")),
            "{\"rows\":2,\"cols\":3,\"cell_m\":0.125,\n\"type\":[\n[2,0,2],\n[2,2,2]]");
  EXPECT_NE(text.find("\"mean_height_m\":[\n[0,0.333,0],\n[0,0,-0.008]]"), std::string::npos) << text;
  const MapFile map = read(text);
  EXPECT_EQ(map.geometry.cell_mm, 125);
  EXPECT_EQ(map.type.view().at(1, 0), kCellObstacle);
  EXPECT_EQ(map.count.view().at(1, 0), 3U);
  EXPECT_EQ(map.floor_count.view().at(2, 1), 7U);
  EXPECT_EQ(map.below_count.view().at(0, 1), 4294967295U);
  EXPECT_NEAR(map.mean_height_m.view().at(2, 1), -0.008, 1e-12);
}

TEST_F(MapFileTest, PgmTopRowIsTheFarthest) {
  for (const std::string& text : {std::string("P2\n3 2\n255\n0 254 205\n254 254 0\n"),
                                  std::string("P5\n3 2\n255\n\x00\xFE\xCD\xFE\xFE\x00", 17)}) {
    const MapFile map = read(text);
    EXPECT_EQ(map.geometry.rows, 2);
    EXPECT_EQ(map.geometry.cols, 3);
    EXPECT_EQ(map.geometry.cell_mm, 250);
    EXPECT_EQ(map.type.view().at(0, 1), kCellObstacle);
    EXPECT_EQ(map.type.view().at(1, 1), kCellUnoccupied);
    EXPECT_EQ(map.type.view().at(2, 1), kCellUnknown);
    EXPECT_EQ(map.type.view().at(0, 0), kCellUnoccupied);
    EXPECT_EQ(map.type.view().at(2, 0), kCellObstacle);
  }
}

TEST_F(MapFileTest, RefusesBadPgm) {
  EXPECT_TRUE(starts(refusal("P2\n2 2\n255\n0 254\n205 100\n"), "pgm: 100 at column 1, row 1 from the top"));
  EXPECT_NE(refusal("P2\n2 2\n255\n0 254\n205\n"), "");
  EXPECT_NE(refusal("P5\n2 2\n255\n\xFE"), "");
  EXPECT_NE(refusal("P5\n100000 100000\n255\n\xFE"), "");
  EXPECT_TRUE(starts(refusal("P5\n2001 1\n255\n" + std::string(2001, '\xFE')), "pgm: 2001 x 1 cells"));
}

TEST_F(MapFileTest, RefusesWhatIsNoMap) {
  EXPECT_NE(refusal(""), "");
  EXPECT_TRUE(starts(refusal("  \n"), "map: is neither"));
  EXPECT_TRUE(starts(refusal("[1,2]"), "map: is neither"));
  EXPECT_TRUE(starts(refusal("P6\n1 1\n255\nabc"), "map: is neither"));
  EXPECT_TRUE(starts(refusal("{}"), "rows: is missing"));
  EXPECT_TRUE(starts(refusal(kSmall + "x"), "map: is not valid JSON"));
  EXPECT_TRUE(starts(refusal("{\"rows\":" + std::string(100'000, '[')), "map: is nested too deep"));
  EXPECT_THROW(read_map(folder_.path("none"), 0.1), InputError);
  EXPECT_THROW(read_map(folder_.path("."), 0.1), InputError);
}

TEST_F(MapFileTest, RefusesEveryTruncation) {
  for (std::size_t length = 0; length < kSmall.size(); ++length)
    EXPECT_NE(refusal(kSmall.substr(0, length)), "") << length;
}

TEST_F(MapFileTest, RefusesBadSizes) {
  for (const char* rows :
       {"0", "-2", "2001", "4294967298", "1e9", "2.0", "\"2\"", "null", "[2]", "18446744073709551615"})
    EXPECT_TRUE(starts(refusal_with("\"rows\":2", std::string("\"rows\":") + rows), "rows: ")) << rows;
  EXPECT_TRUE(starts(refusal_with("\"cols\":3", "\"cols\":0"), "cols: "));
  EXPECT_TRUE(starts(refusal_with("\"cols\":3", "\"columns\":3"), "cols: is missing"));
  for (const char* cell : {"0", "-0.1", "0.0005", "0.10005", "11", "1e300", "\"0.1\"", "true"})
    EXPECT_TRUE(starts(refusal_with("0.1,", std::string(cell) + ","), "cell_m: ")) << cell;
  EXPECT_TRUE(starts(refusal_with("0.1", "1e999"), "map: is not valid JSON"));
}

TEST_F(MapFileTest, RefusesPlanesOfAnotherShape) {
  EXPECT_TRUE(starts(refusal_with("\"rows\":2", "\"rows\":3"), "type: has 2 entries instead of 3"));
  EXPECT_TRUE(starts(refusal_with("\"cols\":3", "\"cols\":2"), "type[0]: has 3 entries instead of 2"));
  EXPECT_TRUE(starts(refusal_with("[1,1,1]", "[1,1]"), "type[1]: has 2 entries"));
  EXPECT_TRUE(starts(refusal_with("[1,1,1]", "7"), "type[1]: is not an array"));
  EXPECT_TRUE(starts(refusal_with("[[0,1,2],[1,1,1]]", "7"), "type: is not an array"));
  EXPECT_TRUE(starts(refusal_with("\"type\"", "\"kind\""), "type: is missing"));
  EXPECT_TRUE(starts(refusal_of("\"count\":[[1,2,3]]"), "count: has 1 entries"));
}

TEST_F(MapFileTest, RefusesBadValues) {
  for (const char* type : {"3", "-1", "256", "1.0", "\"1\"", "null", "[1]"})
    EXPECT_TRUE(starts(refusal_with("1,2]", std::string(type) + ",2]"), "type[0][1]: ")) << type;
  EXPECT_TRUE(starts(refusal_with("1,2]", "NaN,2]"), "map: is not valid JSON"));
  for (const char* count : {"-1", "4294967296", "0.5", "null"}) {
    EXPECT_TRUE(starts(refusal_of(std::string("\"count\":[[1,2,3],[1,") + count + ",3]]"), "count[1][1]: "))
        << count;
  }
  EXPECT_TRUE(starts(refusal_of("\"mean_height_m\":[[1,2,3],[1,2,\"3\"]]"), "mean_height_m[1][2]: "));
  EXPECT_EQ(refusal_of("\"mean_height_m\":[[1,2,3],[1,2,3.5]]"), "");
}

}  // namespace
}  // namespace lakshya
