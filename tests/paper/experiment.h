// What the tests of the paper's experiments share: made-up scenes whose every pixel is known, the real pipeline on
// them, and counts by what a pixel truly shows.
//
// Every scene is run with the matched disparity and with the true one. The pruning steps are told apart by running
// the same disparity through the pipeline with the later steps' limits out of reach.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "app/core/pipeline.h"
#include "app/core/vehicle_config.h"
#include "hal/clock/monotonic_clock.h"
#include "tests/support/ray_caster.h"

namespace lakshya::paper {

// What a surface is; the ray-caster's object number.
enum class Object : std::uint8_t { nothing, floor, ceiling, wall, newspaper, box, lamp };
inline constexpr int kObjects = 7;
const char* to_string(Object object);

// A cuboid that the scene holds, for checks by its footprint.
struct Thing {
  Object object = Object::box;
  test::Cuboid cuboid;
};

struct PaperScene {
  std::string name;    // of its sheet, without ".png"
  std::string title;   // what the sheet shows
  std::string remark;  // what to look for, one line
  test::CameraRig rig{};
  test::Surfaces surfaces{};
  std::vector<Thing> things{};
};

// Adds the cuboid to both lists.
void add_thing(PaperScene& scene, Object object, const test::Cuboid& cuboid, const test::SurfaceTexture& texture);
// The ground plane.
void add_floor(PaperScene& scene);

// The scene's pair, made once per name and test executable: rendering takes as long as matching.
const test::RenderedPair& rendered(const PaperScene& scene);

// ---- running

StereoCalibration calibration_of(const test::CameraRig& rig);
// A built-in profile for the rig; sets as on the command line.
VehicleConfig config_for(const test::CameraRig& rig, const std::string& profile,
                         std::vector<std::string> sets = {});

// One frame and what it came from; keeps the pipeline whose memory the frame's views show.
class ProcessedFrame {
 public:
  ProcessedFrame(const test::RenderedPair& pair, const test::CameraRig& rig, const VehicleConfig& config);
  // With this disparity instead of a matched one.
  ProcessedFrame(const test::RenderedPair& pair, const test::CameraRig& rig, const VehicleConfig& config,
                 ImageView<const std::int16_t> disparity);

  const FrameResult& frame() const { return frame_; }
  const Pipeline& pipeline() const { return *pipeline_; }
  const VehicleConfig& config() const { return config_; }

 private:
  void process(const test::RenderedPair& pair, const test::CameraRig& rig, const KernelTable& kernels);

  VehicleConfig config_;
  MonotonicClock clock_;
  std::unique_ptr<Pipeline> pipeline_;
  FrameResult frame_;
};

// ---- the pruning steps

inline constexpr int kSteps = 4;
inline constexpr std::array<const char*, kSteps> kStepNames = {"no pruning", "floor", "+ ceiling", "+ depth"};

using ObjectCounts = std::array<int, kObjects>;
int total(const ObjectCounts& counts);
int of(const ObjectCounts& counts, Object object);

// Points kept after each step, by what their pixel truly shows. "no pruning" is every pixel with a finite depth.
using StepCounts = std::array<ObjectCounts, kSteps>;

struct Experiment {
  Experiment(const PaperScene& scene, const test::RenderedPair& pair, const VehicleConfig& config,
             ImageView<const std::int16_t> disparity);

  std::array<std::unique_ptr<ProcessedFrame>, kSteps> frames;  // [0] is empty
  StepCounts kept;
  const ProcessedFrame& last() const { return *frames[kSteps - 1]; }
};

// ---- checks by what is truly there

// Share of an object's pixels whose class is `wanted`, of those with a disparity, leaving out pixels within
// `margin_px` of another object (the matcher's window sees both there) and, for a least height, lower ones.
struct Share {
  int pixels = 0;
  int with_class = 0;
  double value() const { return pixels == 0 ? 0 : static_cast<double>(with_class) / pixels; }
};
struct Selection {
  Object object = Object::floor;
  int margin_px = 0;
  double min_height_m = -1;
  double max_height_m = 100;
};
Share share_of(const PaperScene& scene, const test::RenderedPair& pair, const FrameResult& frame,
               const Selection& selection, PixelClass wanted);

// Type of the cell at a place in the body frame, metres.
CellType cell_at(const NavGrid& grid, double forward_m, double left_m);

// How far from a thing's outline an obstacle cell may lie: margin_m (cells), and what an error of disparity_px does to
// the depth of a surface there, z^2 disparity_px / (f B). Beside silhouettes, where only the left camera sees the background, no match is right: what
// the left-right check (1 px, after rounding either way) lets pass there is 2 px off, and up to 3 px on a few pixels,
// enough for a cell in the doorway experiment.
struct Clearance {
  double margin_m = 0;
  double disparity_px = 0;
};
inline constexpr Clearance kTrueClearance{0.15, 0.1};
inline constexpr Clearance kMatchedClearance{0.2, 2.5};

// Obstacle cells that are farther than that from every thing, as text; empty when there is none.
std::string stray_obstacles(const PaperScene& scene, const NavGrid& grid, const Clearance& clearance);

// Share of the width of a cuboid's front (yaw 0) along which an obstacle cell lies within `margin_m` of it in depth.
double front_found(const NavGrid& grid, const test::Cuboid& cuboid, double margin_m);

// A part of the map, metres; left_m > right_m.
struct Area {
  double near_m = 0;
  double far_m = 0;
  double right_m = 0;
  double left_m = 0;
};
// Cells wholly inside the area that are not unoccupied, as text; empty when there is none.
std::string not_free(const NavGrid& grid, const Area& area);

}  // namespace lakshya::paper
