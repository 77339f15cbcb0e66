// A frame gives the same with any number of threads, to the last bit: what a band writes belongs to it, and what bands
// write together (the map's cells) are sums of integers. Under ./dev test --preset tsan the same frames show data races.
#include <gtest/gtest.h>
#include <omp.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "app/core/matcher.h"
#include "app/core/pipeline.h"
#include "hal/clock/monotonic_clock.h"
#include "tests/support/stereo_pair.h"

namespace lakshya {
namespace {

using test::StereoRig;
using Bytes = std::vector<std::byte>;

constexpr int kManyThreads[] = {2, 3, 7};

template <class T>
Bytes bytes_of(const T& value) {
  const auto bytes = std::bit_cast<std::array<std::byte, sizeof(T)>>(value);
  return {bytes.begin(), bytes.end()};
}

template <class T>
Bytes bytes_of(const ImageView<T>& image) {
  Bytes all;
  for (int v = 0; v < image.height; ++v) {
    const auto* row = reinterpret_cast<const std::byte*>(image.row(v));
    all.insert(all.end(), row, row + sizeof(T) * static_cast<std::size_t>(image.width));
  }
  return all;
}

// A wall at 2.5 m (4 px) and the floor before it: d = f B / Z = 0.25 px per row below the horizon at 0.4 m height.
test::StereoPair scene() {
  return test::textured_pair([](int v) { return v < 76 ? 4 : (v - 60) / 4; });
}

// With lenses that bend a little, so that the frame begins with rectification.
StereoCalibration rig() {
  StereoCalibration c;
  c.width = StereoRig::kWidth;
  c.height = StereoRig::kHeight;
  c.left = {.fx = 100, .fy = 100, .cx = 79.5, .cy = StereoRig::kCenterV};
  c.right = c.left;
  c.left.distortion[0] = 1e-3;
  c.right.distortion[0] = -1e-3;
  c.T = {-0.1, 0, 0};
  return c;
}

VehicleConfig vehicle(const std::string& matcher) {
  VehicleConfig c;
  c.camera.height_m = 0.4;
  c.matcher.name = matcher;
  c.matcher.disparities = 32;
  c.matcher.bands = 7;  // work for each of as many threads
  c.grid.rows = 60;
  c.grid.cols = 60;
  return c;
}

class Threads : public testing::TestWithParam<const char*> {
 protected:
  void TearDown() override { omp_set_num_threads(usual_); }

  test::StereoPair pair_ = scene();

 private:
  int usual_ = omp_get_max_threads();
};

Bytes match(const MatcherConfig& config, const KernelTable& kernels, const test::StereoPair& pair) {
  Arena measuring;
  const Matcher measured(config, 0, StereoRig::kWidth, StereoRig::kHeight, kernels, measuring);
  Arena arena(measuring.used());
  Matcher matcher(config, 0, StereoRig::kWidth, StereoRig::kHeight, kernels, arena);
  ImageView<const std::int16_t> disparity;
  EXPECT_EQ(matcher.match(pair.left.view(), pair.right.view(), disparity), Status::ok);
  return bytes_of(disparity);
}

// Everything that two frames leave behind; the second starts from the first one's floor.
std::map<std::string, Bytes> process(const VehicleConfig& config, const KernelTable& kernels,
                                     const test::StereoPair& pair) {
  const MonotonicClock clock;
  Pipeline pipeline(config, rig(), StereoRig::kWidth, StereoRig::kHeight, kernels, clock);
  FrameResult f;
  for (int frame = 0; frame < 2; ++frame)
    EXPECT_EQ(pipeline.process(pair.left.view(), pair.right.view(), {}, f), Status::ok);
  return {{"left", bytes_of(f.left)},
          {"right", bytes_of(f.right)},
          {"disparity", bytes_of(f.disparity)},
          {"classes", bytes_of(f.classes)},
          {"ground offset", bytes_of(f.ground_offset16)},
          {"pixels", bytes_of(f.pixels)},
          {"count", bytes_of(f.grid.count)},
          {"height sum", bytes_of(f.grid.height_sum)},
          {"floor count", bytes_of(f.grid.floor_count)},
          {"below count", bytes_of(f.grid.below_count)},
          {"type", bytes_of(f.grid.type)},
          {"histogram", bytes_of(f.plan.histogram)},
          {"selectable", bytes_of(f.plan.selectable)},
          {"direction", bytes_of(f.plan.direction)},
          {"speed", bytes_of(f.plan.speed_mps)},
          {"wheels", bytes_of(f.plan.wheels)}};
}

TEST_P(Threads, MatchTheSame) {
  for (const Backend& backend : kBackends) {
    omp_set_num_threads(1);
    const Bytes one = match(vehicle(GetParam()).matcher, *backend.kernels, pair_);
    for (const int threads : kManyThreads) {
      omp_set_num_threads(threads);
      EXPECT_EQ(match(vehicle(GetParam()).matcher, *backend.kernels, pair_), one)
          << backend.name << ", " << threads << " threads";
    }
  }
}

TEST_P(Threads, ProcessTheSame) {
  for (const Backend& backend : kBackends) {
    omp_set_num_threads(1);
    const auto one = process(vehicle(GetParam()), *backend.kernels, pair_);
    for (const int threads : kManyThreads) {
      omp_set_num_threads(threads);
      const auto many = process(vehicle(GetParam()), *backend.kernels, pair_);
      for (const auto& [what, bytes] : one)
        EXPECT_TRUE(many.at(what) == bytes) << what << ", " << backend.name << ", " << threads << " threads";
    }
  }
}

// Equal results of an empty frame would say nothing.
TEST_P(Threads, TheSceneIsSeen) {
  const auto frame = process(vehicle(GetParam()), kReferenceKernels, pair_);
  for (const char* what : {"count", "height sum", "floor count", "type", "histogram"}) {
    const Bytes& bytes = frame.at(what);
    EXPECT_GT(std::count(bytes.begin(), bytes.end(), std::byte{0}), 0) << what;
    EXPECT_LT(std::count(bytes.begin(), bytes.end(), std::byte{0}), std::ssize(bytes)) << what;
  }
}

INSTANTIATE_TEST_SUITE_P(EachMatcher, Threads, testing::Values("sgm", "census", "sad"),
                         [](const auto& matcher) { return std::string(matcher.param); });

}  // namespace
}  // namespace lakshya
