#include "app/core/pipeline.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <new>
#include <random>
#include <utility>

#include "app/core/input_error.h"
#include "hal/clock/monotonic_clock.h"
#include "tests/support/count_allocations.h"
#include "tests/support/test_image.h"

namespace lakshya {
namespace {

constexpr int kWidth = 240;
constexpr int kHeight = 160;

// A rectified rig: f 160 px, B 0.15 m, so that 12 px are 2 m.
StereoCalibration rig() {
  StereoCalibration c;
  c.width = kWidth;
  c.height = kHeight;
  c.left = {.fx = 160, .fy = 160, .cx = 119.5, .cy = 79.5};
  c.right = c.left;
  c.T = {-0.15, 0, 0};
  c.images_rectified = true;
  return c;
}

VehicleConfig vehicle() {
  VehicleConfig c;
  c.camera.height_m = 0.5;
  c.matcher.disparities = 48;
  c.grid.rows = 60;
  c.grid.cols = 60;
  return c;
}

// The scene as disparities: a floor (d = 0.3 (v - 79.5)), at 2 m a box 0.5 m wide and 0.4 m high, a wall at 5 m
// (4.8 px).
double scene_disparity(int u, int v) {
  const bool box = u >= 100 && u < 140 && v >= 87 && v < 120;
  if (box) return 12;
  return std::max(0.3 * (v - 79.5), 4.8);
}

struct Pair {
  test::PaddedImage<std::uint8_t> left{kWidth, kHeight};
  test::PaddedImage<std::uint8_t> right{kWidth, kHeight};
};

// A random smooth texture on the left; the right shows the same surface points, the nearest where several fall.
Pair render() {
  Pair pair;
  std::mt19937 random(41);
  test::fill_random(pair.left.view(), random, 0, 255);
  for (int v = 0; v < kHeight; ++v) {
    for (int u = 0; u < kWidth; ++u) {
      // Texture of the surface point that the right pixel sees, by search along the row: nearest surface first.
      double value = 128;
      for (int step = 47 * 20; step >= 0; --step) {
        const double d = step * 0.05;
        const double from = u + d;
        const int nearest = static_cast<int>(std::lround(from));
        if (nearest >= kWidth - 1 || std::abs(scene_disparity(nearest, v) - d) > 0.026) continue;
        const int left = static_cast<int>(from);
        const double a = from - left;
        value = (1 - a) * pair.left.view().at(left, v) + a * pair.left.view().at(left + 1, v);
        break;
      }
      pair.right.view().at(u, v) = static_cast<std::uint8_t>(std::lround(value));
    }
  }
  return pair;
}

class PipelineTest : public ::testing::Test {
 protected:
  FrameResult run(Pipeline& pipeline) {
    FrameResult frame;
    EXPECT_EQ(pipeline.process(pair_.left.view(), pair_.right.view(), {}, frame), Status::ok);
    return frame;
  }

  Pair pair_ = render();
  MonotonicClock clock_;
};

TEST_F(PipelineTest, MapsABoxOnAFloorBeforeAWall) {
  Pipeline pipeline(vehicle(), rig(), kWidth, kHeight, kReferenceKernels, clock_);
  const FrameResult f = run(pipeline);
  const auto type = [&](double forward, double left) {
    return f.grid.type.at(static_cast<int>(30 - left * 10), static_cast<int>(forward * 10));
  };
  EXPECT_EQ(type(2.05, 0.0), kCellObstacle);
  EXPECT_EQ(type(1.6, 0.0), kCellUnoccupied);
  EXPECT_EQ(type(1.6, 0.7), kCellUnoccupied);
  EXPECT_EQ(type(3.0, 0.95), kCellUnoccupied);
  EXPECT_EQ(type(3.0, 0.0), kCellUnknown);  // behind the box
  // 4.8 px are 5 m; an eighth of a pixel more, to which the parabola leans here, is 4.87 m.
  EXPECT_TRUE(type(4.85, 1.5) == kCellObstacle || type(4.95, 1.5) == kCellObstacle ||
              type(5.05, 1.5) == kCellObstacle);
  EXPECT_EQ(type(0.05, 0.0), kCellUnknown);  // below the view
  EXPECT_EQ(f.grid.below_count.at(30, 16), 0U);
}

TEST_F(PipelineTest, CountsEveryPixelOnce) {
  Pipeline pipeline(vehicle(), rig(), kWidth, kHeight, kReferenceKernels, clock_);
  const FrameResult f = run(pipeline);
  std::uint32_t classes = 0;
  std::uint32_t reasons = 0;
  for (const std::uint32_t n : f.pixels.by_class)
    classes += n;
  for (const std::uint32_t n : f.pixels.by_reason)
    reasons += n;
  EXPECT_EQ(classes, static_cast<std::uint32_t>(kWidth * kHeight));
  EXPECT_LE(reasons, f.pixels.by_class[static_cast<int>(PixelClass::no_disparity)]);
  EXPECT_GT(f.pixels.by_class[static_cast<int>(PixelClass::obstacle)], 1000U);
  EXPECT_GT(f.pixels.by_class[static_cast<int>(PixelClass::floor)], 5000U);
  for (const Nanoseconds t : f.times.took)
    EXPECT_GE(t, 0);
}

TEST_F(PipelineTest, AllocatesNothingAfterTheStart) {
  Pipeline pipeline(vehicle(), rig(), kWidth, kHeight, kReferenceKernels, clock_);
  FrameResult frame = run(pipeline);
  const int before = test::allocations;
  const Status status = pipeline.process(pair_.left.view(), pair_.right.view(), {}, frame);
  EXPECT_EQ(test::allocations, before);
  EXPECT_EQ(status, Status::ok);
}

TEST_F(PipelineTest, RemappingAnIdealRigChangesNothingMuch) {
  // A tiny distortion forces the maps; the images move by less than 0.01 px.
  StereoCalibration c = rig();
  c.images_rectified = false;
  c.left.distortion[0] = 1e-5;
  c.right.distortion[0] = 1e-5;
  Pipeline plain(vehicle(), rig(), kWidth, kHeight, kReferenceKernels, clock_);
  Pipeline remapped(vehicle(), c, kWidth, kHeight, kReferenceKernels, clock_);
  const FrameResult a = run(plain);
  const FrameResult b = run(remapped);
  int same = 0;
  int both = 0;
  for (int v = 0; v < kHeight; ++v) {
    for (int u = 0; u < kWidth; ++u) {
      if (a.disparity.at(u, v) < 0 || b.disparity.at(u, v) < 0) continue;
      ++both;
      if (std::abs(a.disparity.at(u, v) - b.disparity.at(u, v)) <= 2) ++same;
    }
  }
  EXPECT_GT(both, kWidth * kHeight / 2);
  EXPECT_GT(same, both * 98 / 100);
}

TEST_F(PipelineTest, RefusesImagesOfAnotherSize) {
  Pipeline pipeline(vehicle(), rig(), kWidth, kHeight, kReferenceKernels, clock_);
  test::PaddedImage<std::uint8_t> other(kWidth - 1, kHeight);
  FrameResult frame;
  EXPECT_EQ(pipeline.process(other.view(), pair_.right.view(), {}, frame), Status::size_mismatch);
  EXPECT_EQ(pipeline.process(pair_.left.view(), other.view(), {}, frame), Status::size_mismatch);
}

TEST_F(PipelineTest, RefusesAFloorToleranceAboveTheCamera) {
  VehicleConfig c = vehicle();
  c.prune.floor_tolerance_m = 0.6;
  EXPECT_THROW(Pipeline(c, rig(), kWidth, kHeight, kReferenceKernels, clock_), InputError);
}

TEST_F(PipelineTest, RefusesASearchRangeOutsideTheImage) {
  VehicleConfig c = vehicle();
  c.matcher.min_disparity = kWidth;
  EXPECT_THROW(Pipeline(c, rig(), kWidth, kHeight, kReferenceKernels, clock_), InputError);
}

TEST_F(PipelineTest, RefusesKernelsWhoseBuffersLieElsewhere) {
  KernelTable elsewhere = kReferenceKernels;
  elsewhere.memory = Memory::device;
  EXPECT_THROW(Pipeline(vehicle(), rig(), kWidth, kHeight, elsewhere, clock_), InputError);
}

TEST_F(PipelineTest, AFailedFrameLeavesNoCommandBehind) {
  Pipeline pipeline(vehicle(), rig(), kWidth, kHeight, kReferenceKernels, clock_);
  FrameResult frame = run(pipeline);
  ASSERT_FALSE(frame.plan.blocked);
  EXPECT_EQ(pipeline.process({}, {}, {}, frame), Status::size_mismatch);
  EXPECT_TRUE(frame.plan.blocked);
  EXPECT_EQ(frame.plan.speed_mps, 0);
}

TEST_F(PipelineTest, TheGroundIsFoundDespiteAWrongPitchAndFollowedAtABoundedRate) {
  VehicleConfig wrong = vehicle();
  wrong.camera.pitch_deg = 1.0;
  wrong.prune.ground_rate_deg = 0.2;
  Pipeline pipeline(wrong, rig(), kWidth, kHeight, kReferenceKernels, clock_);
  const FrameResult f = run(pipeline);
  // (f B / H) * 1 degree = 48 * 0.01745 = 0.84 px too much in the mount's plane.
  EXPECT_NEAR(f.ground_offset16, -0.84 * 16, 4);  // a quarter of a pixel
  EXPECT_EQ(f.grid.type.at(30, 16), kCellUnoccupied);
  // A frame without any ground lets go of it by the bounded rate only.
  const test::PaddedImage<std::uint8_t> black(kWidth, kHeight);
  FrameResult next;
  ASSERT_EQ(pipeline.process(black.view(), black.view(), {}, next), Status::ok);
  EXPECT_EQ(next.ground_offset16, f.ground_offset16 + 3);  // 0.2 degrees are 2.7 sixteenths
}

// What a frame leaves behind.
void expect_same(const FrameResult& a, const FrameResult& b) {
  EXPECT_TRUE(test::equal_images(a.disparity, b.disparity));
  EXPECT_TRUE(test::equal_images(a.grid.type, b.grid.type));
  EXPECT_TRUE(test::equal_images(a.grid.count, b.grid.count));
  EXPECT_EQ(a.ground_offset16, b.ground_offset16);
  EXPECT_EQ(a.plan.histogram, b.plan.histogram);
  EXPECT_EQ(a.plan.binary, b.plan.binary);
  EXPECT_EQ(a.plan.blocked, b.plan.blocked);
  EXPECT_EQ(a.plan.direction, b.plan.direction);
  EXPECT_EQ(a.plan.speed_mps, b.plan.speed_mps);
}

TEST_F(PipelineTest, InAPartOfALargerArenaItGivesTheSameAndHarmsNobody) {
  Pipeline own(vehicle(), rig(), kWidth, kHeight, kReferenceKernels, clock_);
  const FrameResult expected = run(own);

  const std::size_t bytes = Pipeline::memory_bytes(vehicle(), rig(), kWidth, kHeight, kReferenceKernels);
  constexpr std::uint8_t kCanary = 0xA5;
  Arena arena(64 + bytes + 64);
  const auto before = arena.take<std::uint8_t>(64);
  Arena part = arena.part(bytes);
  const auto after = arena.take<std::uint8_t>(64);
  for (const auto neighbour : {before, after})
    std::fill(neighbour.begin(), neighbour.end(), kCanary);
  Pipeline guest(vehicle(), rig(), kWidth, kHeight, kReferenceKernels, clock_, std::move(part));
  EXPECT_EQ(guest.arena_bytes(), bytes);
  const FrameResult found = run(guest);
  EXPECT_GT(reinterpret_cast<const std::uint8_t*>(found.disparity.data), before.data());
  EXPECT_LT(reinterpret_cast<const std::uint8_t*>(found.disparity.data), after.data());
  expect_same(found, expected);
  for (const auto neighbour : {before, after}) {
    for (const std::uint8_t byte : neighbour)
      EXPECT_EQ(byte, kCanary);
  }
}

TEST_F(PipelineTest, RefusesAPartThatIsTooSmall) {
  const std::size_t bytes = Pipeline::memory_bytes(vehicle(), rig(), kWidth, kHeight, kReferenceKernels);
  Arena arena(bytes);
  EXPECT_THROW(
      Pipeline(vehicle(), rig(), kWidth, kHeight, kReferenceKernels, clock_, arena.part(bytes - Arena::kAlignment)),
      std::bad_alloc);
}

// The floor of the frames before, the histogram's memory and the times are all forgotten.
TEST_F(PipelineTest, BegunAnewItGivesWhatItGaveAtFirst) {
  VehicleConfig wrong = vehicle();
  wrong.camera.pitch_deg = 1.0;
  Pipeline pipeline(wrong, rig(), kWidth, kHeight, kReferenceKernels, clock_);
  const test::PaddedImage<std::uint8_t> black(kWidth, kHeight);
  const auto see_black = [&](Pipeline& by) {
    FrameResult frame;
    EXPECT_EQ(by.process(black.view(), black.view(), {}, frame), Status::ok);
    return frame;
  };
  Pipeline fresh(wrong, rig(), kWidth, kHeight, kReferenceKernels, clock_);
  const FrameResult expected = see_black(fresh);

  (void)run(pipeline);
  EXPECT_NE(see_black(pipeline).ground_offset16, expected.ground_offset16);  // it remembers
  (void)run(pipeline);
  EXPECT_EQ(pipeline.times().frame().count(), 3U);
  pipeline.begin_anew();
  EXPECT_EQ(pipeline.times().frame().count(), 0U);
  expect_same(see_black(pipeline), expected);
  EXPECT_EQ(pipeline.times().frame().count(), 1U);
  expect_same(run(pipeline), run(fresh));
}

TEST(PipelineSizes, TinyImagesAreProcessed) {
  const MonotonicClock clock;
  for (const int width : {1, 8, 9, 17}) {
    for (const int height : {1, 6, 7, 12}) {
      StereoCalibration c = rig();
      c.width = width;
      c.height = height;
      Pipeline pipeline(vehicle(), c, width, height, kReferenceKernels, clock);
      const test::PaddedImage<std::uint8_t> image(width, height);
      FrameResult frame;
      EXPECT_EQ(pipeline.process(image.view(), image.view(), {}, frame), Status::ok) << width << "x" << height;
      EXPECT_TRUE(frame.plan.blocked);
    }
  }
}

}  // namespace
}  // namespace lakshya
