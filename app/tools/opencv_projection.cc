#include "app/tools/opencv_projection.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <opencv2/calib3d.hpp>

#include "kernels/base/units.h"

namespace lakshya {
namespace {

// Metres from the turning centre on the ground.
struct Spot {
  float forward, left;
};

struct Cell {
  int row, col;
};

// The frame's numbers as floats.
class CloudBinner {
 public:
  CloudBinner(const PruneGeometry& g, const PruneModel& model, const NavGrid& grid)
      : grid_(grid),
        cells_per_m_(1000.0F / static_cast<float>(grid.geometry.cell_mm)),
        half_cols_(0.5F * static_cast<float>(grid.geometry.cols)),
        focal_times_baseline_(static_cast<float>(g.focal_px * g.baseline_m)),
        max_depth_(static_cast<float>(g.max_depth_m)),
        max_floor_disparity_(static_cast<float>(g.max_disparity_px)),
        height_(static_cast<float>(g.height_m)),
        clearance_(static_cast<float>(g.clearance_m)),
        tolerance_(static_cast<float>(g.floor_tolerance_m)),
        mount_forward_(static_cast<float>(g.forward_m)),
        mount_left_(static_cast<float>(g.left_m)) {
    // k s, with what the pipeline added to it for this image.
    const double noise_px = static_cast<double>(model.floor_absolute.constant - model.floor.constant) / 65536.0;
    noise_per_depth_ = static_cast<float>(noise_px * g.height_m / (g.focal_px * g.baseline_m));
    const double n[3] = {std::cos(g.pitch) * std::sin(g.roll), std::cos(g.pitch) * std::cos(g.roll),
                         std::sin(g.pitch)};
    const double ahead[3] = {-std::sin(g.pitch) * std::sin(g.roll), -std::sin(g.pitch) * std::cos(g.roll),
                             std::cos(g.pitch)};
    const double across[3] = {std::cos(g.roll), -std::sin(g.roll), 0};
    for (int i = 0; i < 3; ++i) {
      down_[i] = static_cast<float>(n[i]);
      forward_[i] = static_cast<float>(std::cos(g.yaw) * ahead[i] + std::sin(g.yaw) * across[i]);
      left_[i] = static_cast<float>(std::sin(g.yaw) * ahead[i] - std::cos(g.yaw) * across[i]);
    }
    const double mount_floor =
        g.baseline_m / g.height_m * (n[2] * g.focal_px - n[0] * g.center_u - n[1] * g.center_v);
    const double offset_px = static_cast<double>(model.floor.constant) / 65536.0 - mount_floor;
    sunk_per_depth_ = static_cast<float>(offset_px * g.height_m / (g.focal_px * g.baseline_m));
    half_row_ = static_cast<float>(g.baseline_m / g.height_m * n[1] / 2);
    min_disparity_ = static_cast<float>(g.focal_px * g.baseline_m / g.max_depth_m);
  }

  void add(const cv::Vec3f& p) const {
    const float z = p[2];
    if (!(z > 0 && z <= max_depth_)) return;  // no disparity, or too far
    const float sunk = down_[0] * p[0] + down_[1] * p[1] + (down_[2] + sunk_per_depth_) * z;
    const float disparity = focal_times_baseline_ / z;
    const float floor_disparity = disparity * sunk / height_;
    if (floor_disparity > max_floor_disparity_) return;
    const float height = height_ - sunk;
    if (sunk > 0) {
      const float tolerance = std::max(tolerance_, noise_per_depth_ * z);
      if (height < -tolerance) return add_strip(p, std::max(disparity, floor_disparity), grid_.below_count);
      if (height <= tolerance) return add_strip(p, std::max(disparity, floor_disparity), grid_.floor_count);
    }
    if (height > clearance_) return;
    Cell c = cell_of({along(forward_, p) + mount_forward_, along(left_, p) + mount_left_});
    c.row = std::max(c.row, 0);
    if (!inside(c)) return;
    ++grid_.count.at(c.col, c.row);
    grid_.height_sum.at(c.col, c.row) += static_cast<std::int64_t>(height * 1000.0F);
  }

 private:
  static float along(const float (&direction)[3], const cv::Vec3f& p) {
    return direction[0] * p[0] + direction[1] * p[1] + direction[2] * p[2];
  }
  Cell cell_of(const Spot& s) const {
    return {static_cast<int>(std::floor(s.forward * cells_per_m_)),
            static_cast<int>(std::floor(half_cols_ - s.left * cells_per_m_))};
  }
  bool inside(const Cell& c) const {
    return c.row >= 0 && c.row < grid_.geometry.rows && c.col >= 0 && c.col < grid_.geometry.cols;
  }

  // The cells along the pixel's footprint, from its lower to its upper edge.
  void add_strip(const cv::Vec3f& p, float disparity, const ImageView<std::uint32_t>& plane) const {
    const float forward = along(forward_, p) / p[2];
    const float left = along(left_, p) / p[2];
    const auto at_depth = [&](float z) { return Spot{forward * z + mount_forward_, left * z + mount_left_}; };
    const Spot near = at_depth(focal_times_baseline_ / (disparity + half_row_));
    const Spot far = at_depth(focal_times_baseline_ / std::max(disparity - half_row_, min_disparity_));
    const Cell first = cell_of(near);
    const Cell last = cell_of(far);
    const int steps = std::max(std::abs(last.row - first.row), std::abs(last.col - first.col));
    if (steps == 0) {
      if (inside(first)) ++plane.at(first.col, first.row);
      return;
    }
    for (int i = 0; i <= steps; ++i) {
      const float share = static_cast<float>(i) / static_cast<float>(steps);
      const Cell c = cell_of(
          {near.forward + share * (far.forward - near.forward), near.left + share * (far.left - near.left)});
      if (inside(c)) ++plane.at(c.col, c.row);
    }
  }

  const NavGrid& grid_;
  float cells_per_m_, half_cols_, focal_times_baseline_, max_depth_, max_floor_disparity_, height_, clearance_,
      tolerance_, mount_forward_, mount_left_;
  float down_[3], forward_[3], left_[3];
  float noise_per_depth_;  // k s as a height, per metre of depth
  float sunk_per_depth_;   // the floor's shift likewise
  float half_row_;         // of the floor's disparity
  float min_disparity_;
};

}  // namespace

OpencvProjection make_opencv_projection(const PruneGeometry& g) {
  const cv::Matx44d q(1, 0, 0, -g.center_u,  //
                      0, 1, 0, -g.center_v,  //
                      0, 0, 0, g.focal_px,   //
                      0, 0, 1 / (g.baseline_m * kDisparityScale), 0);
  return {g, cv::Mat(q, true), {}};
}

void project_and_bin_opencv(ImageView<const std::int16_t> disparity, OpencvProjection& projection,
                            const PruneModel& model, const NavGrid& grid) {
  const cv::Mat image(disparity.height, disparity.width, CV_16SC1, const_cast<std::int16_t*>(disparity.data),
                      static_cast<std::size_t>(disparity.stride) * sizeof(std::int16_t));
  cv::reprojectImageTo3D(image, projection.cloud, projection.Q, false, CV_32F);
  const CloudBinner binner(projection.geometry, model, grid);
  for (int v = 0; v < image.rows; ++v) {
    const auto* row = projection.cloud.ptr<cv::Vec3f>(v);
    for (int u = 0; u < image.cols; ++u)
      binner.add(row[u]);
  }
}

}  // namespace lakshya
