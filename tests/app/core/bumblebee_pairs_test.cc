// BumblebeeCamera with buffers made from real pairs, in both orders of the bytes, by a grey and by colour heads.
#include <gtest/gtest.h>

#include <string>
#include <utility>

#include "app/core/image_file.h"
#include "hal/camera/bumblebee_camera.h"
#include "tests/support/bumblebee_bytes.h"
#include "tests/support/data_path.h"
#include "tests/support/fake_iidc.h"
#include "tests/support/test_image.h"

namespace lakshya {
namespace {

// A grey scene is a mosaic, too: of a grey thing.
void expect_pair(const std::string& name, BayerPattern pattern, bool left_first) {
  const auto whole_left = read_gray(test::data_path(name + "/left.png"));
  const auto whole_right = read_gray(test::data_path(name + "/right.png"));
  ImageView<const std::uint8_t> left = whole_left.view();
  ImageView<const std::uint8_t> right = whole_right.view();
  left.width = right.width = left.width & ~1;
  left.height = right.height = left.height & ~1;
  const auto bytes = left_first ? test::interleaved(left, right) : test::interleaved(right, left);

  ManualClock clock;
  test::FakeIidc bus(clock);
  const auto line = 2 * static_cast<std::size_t>(left.width);
  bus.frames.push_back({clock.now(), {bytes, left.width, left.height, line, 0, false}});
  BumblebeeCamera camera({.width = left.width, .height = left.height, .pattern = pattern, .first_is_left = false},
                         bus, clock);
  ASSERT_EQ(camera.open(), Status::ok) << camera.problem();
  StereoFrame frame;
  ASSERT_EQ(camera.capture(clock.now() + kSecond, frame), Status::ok) << camera.problem();
  for (const auto& [image, seen] : {std::pair(left, frame.left), std::pair(right, frame.right)}) {
    Image<std::uint8_t> grey(image.width, image.height);
    ASSERT_EQ(grey_of_bayer(image, pattern, grey.view()), Status::ok);
    EXPECT_TRUE(test::equal_images(seen, grey.view())) << name;
  }
}

TEST(BumblebeePairs, LeftIsLeftWhicheverByteItIs) {
  if (test::data_path("middlebury/motorcycle/left.png").empty()) GTEST_SKIP() << "LAKSHYA_DATA has no stereo pairs";
  for (const char* name : {"middlebury/motorcycle", "middlebury/tsukuba", "rendered/s3", "eth3d/playground"}) {
    for (const BayerPattern pattern : {BayerPattern::none, BayerPattern::bggr, BayerPattern::grbg}) {
      expect_pair(name, pattern, true);
      expect_pair(name, pattern, false);
    }
  }
}

}  // namespace
}  // namespace lakshya
