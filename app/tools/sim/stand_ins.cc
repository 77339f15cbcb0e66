#include "app/tools/sim/stand_ins.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "kernels/base/units.h"

namespace lakshya::sim {
namespace {

constexpr double kLaserHeight = 0.3;  // m
constexpr double kLaserRange = 10;    // m
constexpr double kLaserStep = 0.25 * std::numbers::pi / 180;
constexpr double kLaserSide = 135 * std::numbers::pi / 180;

void fill(ImageView<std::uint8_t> image, std::uint8_t value) {
  for (int v = 0; v < image.height; ++v)
    std::fill_n(image.row(v), image.width, value);
}

}  // namespace

RayTable rectified_rays(const RectifiedGeometry& camera) {
  return {{.fx = camera.focal_px, .fy = camera.focal_px, .cx = camera.cx_left, .cy = camera.cy},
          camera.width,
          camera.height};
}

TrueDepth::TrueDepth(Renderer& renderer, const RectifiedGeometry& camera, double max_disparity_px, const Shot& shot)
    : renderer_(&renderer),
      camera_(camera),
      max_disparity_px_(max_disparity_px),
      shot_(&shot),
      rays_(rectified_rays(camera)),
      depth_(camera.width, camera.height),
      thing_(camera.width, camera.height),
      disparity_(camera.width, camera.height) {}

Status TrueDepth::match(ImageView<const std::uint8_t> /*left*/, ImageView<const std::uint8_t> /*right*/,
                        ImageView<const std::int16_t>& disparity) {
  renderer_->set_time(shot_->walks);
  renderer_->depth(rays_, shot_->rectified, true, depth_.view(), thing_.view());
  const double scale = camera_.focal_px * camera_.baseline_m;
  for (int v = 0; v < camera_.height; ++v) {
    for (int u = 0; u < camera_.width; ++u) {
      const double d = scale / static_cast<double>(depth_.view().at(u, v));
      disparity_.view().at(u, v) = d < max_disparity_px_
                                       ? static_cast<std::int16_t>(std::lround(d * kDisparityScale))
                                       : std::int16_t{kNotSearched};
    }
  }
  disparity = disparity_.view();
  return Status::ok;
}

LevelLaser::LevelLaser(Renderer& renderer, int width, int height, const Shot& shot)
    : renderer_(&renderer), shot_(&shot), nothing_(width, height, std::int16_t{kNotSearched}) {}

Status LevelLaser::match(ImageView<const std::uint8_t> /*left*/, ImageView<const std::uint8_t> /*right*/,
                         ImageView<const std::int16_t>& disparity) {
  disparity = nothing_.view();
  return Status::ok;
}

Status LevelLaser::see(const NavGrid& grid) {
  renderer_->set_time(shot_->walks);
  fill(grid.type, kCellUnknown);
  const int beams = static_cast<int>(kLaserSide / kLaserStep);
  for (int i = -beams; i <= beams; ++i)
    scan(i * kLaserStep, grid);
  return Status::ok;
}

void LevelLaser::scan(double bearing, const NavGrid& grid) const {
  const VehicleState& v = shot_->vehicle;
  const Eigen::Vector3d forward(std::cos(bearing), std::sin(bearing), 0);
  const Eigen::Vector3d along = world_from_body(v) * forward;
  const double range = renderer_->range({v.x, v.y, v.z + kLaserHeight}, along, false);
  const double cell_m = grid.geometry.cell_mm / 1000.0;
  const auto mark = [&](double length, std::uint8_t type) {
    const int row = static_cast<int>(std::floor(length * forward.x() / cell_m));
    const int col = grid.geometry.cols / 2 - 1 - static_cast<int>(std::floor(length * forward.y() / cell_m));
    if (row < 0 || row >= grid.geometry.rows || col < 0 || col >= grid.geometry.cols) return;
    std::uint8_t& cell = grid.type.at(col, row);
    if (cell == kCellObstacle) return;
    cell = type;
    if (type != kCellObstacle) return;
    grid.count.at(col, row) = 100;
    grid.height_sum.at(col, row) = std::lround(100 * 1000 * kLaserHeight);
  };
  const double free = std::min(range, kLaserRange) - cell_m / 2;
  for (double length = 0; length < free; length += cell_m / 2)
    mark(length, kCellUnoccupied);
  if (range < kLaserRange) mark(range, kCellObstacle);
}

}  // namespace lakshya::sim
