#include "app/lakshyad/self_test_command.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <iostream>
#include <memory>
#include <random>
#include <stdexcept>
#include <string>

#include "app/core/image.h"
#include "app/core/pipeline.h"
#include "hal/clock/monotonic_clock.h"
#include "kernels/base/isa.h"

namespace lakshya {
namespace {

constexpr int kWidth = 320;
constexpr int kHeight = 240;

struct Pair {
  Image<std::uint8_t> left{kWidth, kHeight};
  Image<std::uint8_t> right{kWidth, kHeight};
};

// A made-up scene: a floor, and a box on it, with random texture on both.
Pair made_up_pair() {
  Pair pair;
  std::mt19937 random(1);
  for (int v = 0; v < kHeight; ++v) {
    for (int u = 0; u < kWidth; ++u)
      pair.right.view().at(u, v) = static_cast<std::uint8_t>(random() & 0xFFU);
    const bool box_rows = v >= 100 && v < 180;
    for (int u = 0; u < kWidth; ++u) {
      const int floor = std::max(v - kHeight / 2, 0) / 3;
      const int disparity = box_rows && u >= 120 && u < 200 ? 22 : floor;
      pair.left.view().at(u, v) = pair.right.view().at(std::max(u - disparity, 0), v);
    }
  }
  return pair;
}

StereoCalibration made_up_camera() {
  StereoCalibration c;
  c.source = "self-test";
  c.width = kWidth;
  c.height = kHeight;
  c.left = {.fx = 200, .fy = 200, .cx = 160, .cy = 120};
  c.right = c.left;
  c.T = {-0.12, 0, 0};
  c.left.distortion[0] = 1e-3;  // so that images are remapped
  c.right.distortion[0] = 1e-3;
  return c;
}

template <class T>
bool equal(ImageView<const T> a, ImageView<const T> b) {
  for (int v = 0; v < a.height; ++v) {
    if (!std::ranges::equal(row_span(a, v), row_span(b, v))) return false;
  }
  return true;
}

template <class T>
bool equal(ImageView<T> a, ImageView<T> b) {
  return equal(ImageView<const T>(a), ImageView<const T>(b));
}

bool equal(const FrameResult& a, const FrameResult& b) {
  return equal(a.left, b.left) && equal(a.disparity, b.disparity) && equal(a.classes, b.classes) &&
         equal(a.grid.count, b.grid.count) && equal(a.grid.floor_count, b.grid.floor_count) &&
         equal(a.grid.type, b.grid.type) && a.plan.histogram == b.plan.histogram &&
         a.plan.speed_mps == b.plan.speed_mps;
}

void self_test() {
  const VehicleConfig config;
  const StereoCalibration camera = made_up_camera();
  const MonotonicClock clock;
  const Pair pair = made_up_pair();
  Pipeline reference(config, camera, kWidth, kHeight, kReferenceKernels, clock);
  FrameResult expected;
  if (reference.process(pair.left.view(), pair.right.view(), {}, expected) != Status::ok)
    throw CLI::RuntimeError(1);
  bool well = expected.pixels.by_class[static_cast<std::size_t>(PixelClass::obstacle)] > 0;
  std::cout << "reference: " << (well ? "sees the box" : "DOES NOT SEE THE BOX") << '\n';
  for (const char* isa : available_isas()) {
    if (use_isa(isa) != Status::ok) continue;
    Pipeline simd(config, camera, kWidth, kHeight, kSimdKernels, clock);
    FrameResult frame;
    const bool same =
        simd.process(pair.left.view(), pair.right.view(), {}, frame) == Status::ok && equal(frame, expected);
    std::cout << isa << ": " << (same ? "equal to the reference" : "DIFFERS FROM THE REFERENCE") << '\n';
    well = well && same;
  }
  (void)use_isa("best");
  std::cout << "self-test: " << (well ? "passed" : "FAILED") << '\n';
  if (!well) throw CLI::RuntimeError(1);
}

}  // namespace

void add_self_test_command(CLI::App& app) {
  CLI::App* command = app.add_subcommand(
      "self-test", "Compare every instruction set of this machine with the reference on a made-up pair");
  command->callback([] { self_test(); });
}

}  // namespace lakshya
