// hal/camera/eye_order on every real pair of the data sets, and on the rendered ones, as it is and swapped.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "app/core/image_file.h"
#include "hal/camera/eye_order.h"
#include "tests/support/data_path.h"

namespace lakshya {
namespace {

namespace fs = std::filesystem;

using Paths = std::vector<std::pair<std::string, std::string>>;

// The files of both folders by the same names, where `right` replaces `left` at the name's beginning.
void add_folder(const std::string& left_folder, const std::string& right_folder, const std::string& left,
                const std::string& right, Paths& paths) {
  if (left_folder.empty() || right_folder.empty()) return;
  for (const auto& entry : fs::directory_iterator(left_folder)) {
    const std::string name = entry.path().filename();
    if (!name.starts_with(left)) continue;
    const std::string extension = entry.path().extension();
    if (extension != ".png" && extension != ".jpg") continue;
    const fs::path other = fs::path(right_folder) / (right + name.substr(left.size()));
    if (fs::exists(other)) paths.emplace_back(entry.path(), other);
  }
}

Paths all_pairs() {
  Paths paths;
  for (const char* folder :
       {"middlebury/aloe", "middlebury/cloth3", "middlebury/cones", "middlebury/motorcycle", "middlebury/tsukuba",
        "middlebury2021_nogt/curule", "eth3d/playground", "chessboard_opencv", "rendered/s1", "rendered/s2",
        "rendered/s3", "rendered/s4", "rendered/s5"}) {
    add_folder(test::data_path(folder), test::data_path(folder), "left", "right", paths);
  }
  for (const std::string set : {"kitti2012", "kitti_odometry_06"})
    add_folder(test::data_path(set + "/left"), test::data_path(set + "/right"), "", "", paths);
  add_folder(test::data_path("euroc_v1_01_part_a/cam0"), test::data_path("euroc_v1_01_part_a/cam1"), "", "", paths);
  std::sort(paths.begin(), paths.end());
  return paths;
}

TEST(EyeOrderPairs, EveryPairIsToldAsItIsAndSwapped) {
  const Paths paths = all_pairs();
  if (paths.empty()) GTEST_SKIP() << "LAKSHYA_DATA has no stereo pairs";
  const auto finder = std::make_unique<EyeOrderFinder>();
  for (const auto& [left_path, right_path] : paths) {
    const auto left = read_gray(left_path);
    const auto right = read_gray(right_path);
    const EyeVotes as_is = finder->look(left.view(), right.view());
    const EyeVotes swapped = finder->look(right.view(), left.view());
    EXPECT_EQ(as_is.order, EyeOrder::left_first) << left_path;
    EXPECT_EQ(swapped.order, EyeOrder::right_first) << left_path;
    std::printf("%s: %d : %d (rows %d : %d, %d apart), swapped %d : %d\n", left_path.c_str(), as_is.left_first,
                as_is.right_first, as_is.lower_left, as_is.lower_right, as_is.rows_apart, swapped.left_first,
                swapped.right_first);
  }
  std::printf("%zu pairs\n", paths.size());
}

}  // namespace
}  // namespace lakshya
