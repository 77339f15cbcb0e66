#include "tests/paper/experiment.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>
#include <stdexcept>

#include "app/core/vehicle_config_file.h"
#include "app/core/vehicle_config_text.h"
#include "tests/support/given_disparity.h"

namespace lakshya::paper {
namespace {

// Limits that nothing in a scene reaches.
constexpr double kNoDepthLimit = 100;
constexpr double kNoClearanceLimit = 10;

double height_of(const test::CameraRig& rig, const test::CameraAxes& axes, int u, int v, double depth) {
  return rig.height_m + depth * test::pixel_ray(rig, axes, u, v).z;
}

bool near_another_object(const ImageView<const std::uint8_t>& object, int u, int v, int margin) {
  for (int y = std::max(v - margin, 0); y <= std::min(v + margin, object.height - 1); ++y) {
    for (int x = std::max(u - margin, 0); x <= std::min(u + margin, object.width - 1); ++x) {
      if (object.at(x, y) != object.at(u, v)) return true;
    }
  }
  return false;
}

// From a place to the outline of a cuboid on the ground; 0 inside.
double distance_to(const test::Cuboid& c, double forward, double left) {
  const double x = forward - c.base.x;
  const double y = left - c.base.y;
  const double along = std::cos(c.yaw) * x + std::sin(c.yaw) * y;
  const double across = -std::sin(c.yaw) * x + std::cos(c.yaw) * y;
  return std::hypot(std::max(std::abs(along) - c.size.x / 2, 0.0), std::max(std::abs(across) - c.size.y / 2, 0.0));
}

struct Place {
  double forward = 0;
  double left = 0;
};

Place center_of(const GridGeometry& g, int row, int col) {
  const double cell = g.cell_mm / 1000.0;
  return {(row + 0.5) * cell, (g.cols / 2.0 - col - 0.5) * cell};
}

std::string place_text(const Place& p) {
  return "(" + number_text(p.forward) + " m ahead, " + number_text(p.left) + " m left) ";
}

template <class Keep>
ObjectCounts count_pixels(const test::RenderedPair& pair, Keep keep) {
  ObjectCounts counts{};
  const auto object = pair.left.object.view();
  for (int v = 0; v < object.height; ++v) {
    for (int u = 0; u < object.width; ++u) {
      if (keep(u, v)) ++counts[object.at(u, v)];
    }
  }
  return counts;
}

}  // namespace

const char* to_string(Object object) {
  constexpr std::array<const char*, kObjects> kNames = {"sky",       "floor", "ceiling", "wall",
                                                        "newspaper", "box",   "lamp"};
  return kNames[static_cast<std::size_t>(object)];
}

void add_thing(PaperScene& scene, Object object, const test::Cuboid& cuboid, const test::SurfaceTexture& texture) {
  add_cuboid(scene.surfaces, cuboid, static_cast<std::uint8_t>(object), texture);
  scene.things.push_back({object, cuboid});
}

void add_floor(PaperScene& scene) {
  scene.surfaces.push_back({{-5, -100, 0},
                            {1, 0, 0},
                            {0, 1, 0},
                            205,
                            200,
                            static_cast<std::uint8_t>(Object::floor),
                            {.gray = 105, .contrast = 38, .seed = 1000}});
}

const test::RenderedPair& rendered(const PaperScene& scene) {
  static std::map<std::string, test::RenderedPair> pairs;
  const auto known = pairs.find(scene.name);
  if (known != pairs.end()) return known->second;
  return pairs.emplace(scene.name, render_pair(scene.surfaces, scene.rig)).first->second;
}

StereoCalibration calibration_of(const test::CameraRig& rig) {
  StereoCalibration c;
  c.source = "made-up rig";
  c.width = rig.width;
  c.height = rig.height;
  c.left = {.fx = rig.focal_px, .fy = rig.focal_px, .cx = rig.center_u(), .cy = rig.center_v()};
  c.right = c.left;
  c.T = {-rig.baseline_m, 0, 0};
  c.images_rectified = true;
  return c;
}

VehicleConfig config_for(const test::CameraRig& rig, const std::string& profile, std::vector<std::string> sets) {
  sets.push_back("camera.height_m=" + number_text(rig.height_m));
  sets.push_back("camera.pitch_deg=" + number_text(rig.pitch_deg));
  sets.push_back("camera.roll_deg=" + number_text(rig.roll_deg));
  return load_vehicle_config("", profile, sets);
}

ProcessedFrame::ProcessedFrame(const test::RenderedPair& pair, const test::CameraRig& rig,
                               const VehicleConfig& config)
    : config_(config) {
  process(pair, rig, kReferenceKernels);
}

ProcessedFrame::ProcessedFrame(const test::RenderedPair& pair, const test::CameraRig& rig,
                               const VehicleConfig& config, ImageView<const std::int16_t> disparity)
    : config_(config) {
  const test::GivenDisparity given(disparity);
  process(pair, rig, test::GivenDisparity::kernels());
}

void ProcessedFrame::process(const test::RenderedPair& pair, const test::CameraRig& rig,
                             const KernelTable& kernels) {
  pipeline_ = std::make_unique<Pipeline>(config_, calibration_of(rig), rig.width, rig.height, kernels, clock_);
  const Status status = pipeline_->process(pair.left.gray.view(), pair.right.gray.view(), {}, frame_);
  if (status != Status::ok) throw std::runtime_error(lakshya::to_string(status));
}

int total(const ObjectCounts& counts) {
  int sum = 0;
  for (const int n : counts)
    sum += n;
  return sum;
}

int of(const ObjectCounts& counts, Object object) {
  return counts[static_cast<std::size_t>(object)];
}

Experiment::Experiment(const PaperScene& scene, const test::RenderedPair& pair, const VehicleConfig& config,
                       ImageView<const std::int16_t> disparity) {
  kept[0] = count_pixels(pair, [&](int u, int v) { return disparity.at(u, v) > 0; });
  for (std::size_t step = 1; step < kSteps; ++step) {
    VehicleConfig c = config;
    if (step < 3) c.prune.max_depth_m = kNoDepthLimit;
    if (step < 2) c.prune.clearance_m = kNoClearanceLimit;
    frames[step] = std::make_unique<ProcessedFrame>(pair, scene.rig, c, disparity);
    const auto classes = frames[step]->frame().classes;
    kept[step] = count_pixels(pair, [&](int u, int v) { return classes.at(u, v) == PixelClass::obstacle; });
  }
}

Share share_of(const PaperScene& scene, const test::RenderedPair& pair, const FrameResult& frame,
               const Selection& selection, PixelClass wanted) {
  const test::CameraAxes axes = camera_axes(scene.rig);
  const auto object = pair.left.object.view();
  Share share;
  for (int v = 0; v < object.height; ++v) {
    for (int u = 0; u < object.width; ++u) {
      if (object.at(u, v) != static_cast<std::uint8_t>(selection.object) || frame.disparity.at(u, v) <= 0) continue;
      const double height = height_of(scene.rig, axes, u, v, pair.left.depth.view().at(u, v));
      if (height < selection.min_height_m || height > selection.max_height_m) continue;
      if (near_another_object(object, u, v, selection.margin_px)) continue;
      ++share.pixels;
      if (frame.classes.at(u, v) == wanted) ++share.with_class;
    }
  }
  return share;
}

CellType cell_at(const NavGrid& grid, double forward_m, double left_m) {
  const GridGeometry& g = grid.geometry;
  const double cell = g.cell_mm / 1000.0;
  const int row = static_cast<int>(std::floor(forward_m / cell));
  const int col = static_cast<int>(std::floor(g.cols / 2.0 - left_m / cell));
  return static_cast<CellType>(grid.type.at(col, row));
}

std::string stray_obstacles(const PaperScene& scene, const NavGrid& grid, const Clearance& clearance) {
  const double per_disparity = clearance.disparity_px / (scene.rig.focal_px * scene.rig.baseline_m);
  std::ostringstream text;
  for (int row = 0; row < grid.geometry.rows; ++row) {
    for (int col = 0; col < grid.geometry.cols; ++col) {
      const Place p = center_of(grid.geometry, row, col);
      if (grid.type.at(col, row) != kCellObstacle) continue;
      const double allowed = clearance.margin_m + p.forward * p.forward * per_disparity;
      const bool known = std::any_of(scene.things.begin(), scene.things.end(), [&](const Thing& t) {
        return distance_to(t.cuboid, p.forward, p.left) <= allowed;
      });
      if (!known) text << place_text(p);
    }
  }
  return text.str();
}

double front_found(const NavGrid& grid, const test::Cuboid& cuboid, double margin_m) {
  const double cell = grid.geometry.cell_mm / 1000.0;
  const double front = cuboid.base.x - cuboid.size.x / 2;
  const double right = cuboid.base.y - cuboid.size.y / 2;
  const int columns = static_cast<int>(std::lround(cuboid.size.y / cell));
  const int rows = static_cast<int>(std::lround(2 * margin_m / cell)) + 1;
  int found = 0;
  for (int column = 0; column < columns; ++column) {
    bool obstacle = false;
    const double left = right + (column + 0.5) * cell;
    for (int row = 0; row <= rows; ++row)
      obstacle = obstacle || cell_at(grid, front - margin_m + row * cell, left) == kCellObstacle;
    if (obstacle) ++found;
  }
  return columns == 0 ? 0 : static_cast<double>(found) / columns;
}

std::string not_free(const NavGrid& grid, const Area& area) {
  const double cell = grid.geometry.cell_mm / 1000.0;
  std::ostringstream text;
  int cells = 0;
  for (int row = 0; row < grid.geometry.rows; ++row) {
    for (int col = 0; col < grid.geometry.cols; ++col) {
      const Place p = center_of(grid.geometry, row, col);
      const bool inside = p.forward - cell / 2 >= area.near_m - 1e-9 && p.forward + cell / 2 <= area.far_m + 1e-9 &&
                          p.left - cell / 2 >= area.right_m - 1e-9 && p.left + cell / 2 <= area.left_m + 1e-9;
      cells += inside ? 1 : 0;
      if (inside && grid.type.at(col, row) != kCellUnoccupied) text << place_text(p);
    }
  }
  return cells == 0 ? "no cell is inside" : text.str();
}

}  // namespace lakshya::paper
