#include "app/nav/clear_distance.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "kernels/base/units.h"

namespace lakshya {
namespace {

// cos(pi / 2) is not quite zero in floating point, and a ray to the side must not leave row 0.
double snapped(double x) {
  return std::abs(x) < 1e-12 ? 0.0 : x;
}

// What lies on a border to within rounding counts as beyond it, on both sides of the vehicle alike.
constexpr double kRounding = 1e-9;

enum class Meets : std::uint8_t { free, obstacle, unknown, outside };

Meets meets(std::uint8_t type) {
  if (type == kCellObstacle) return Meets::obstacle;
  return type == kCellUnoccupied ? Meets::free : Meets::unknown;
}

Meets worse(Meets a, Meets b) {
  if (a == Meets::obstacle || b == Meets::obstacle) return Meets::obstacle;
  return a == Meets::free ? b : a;
}

// A straight line from the turning centre. Lengths in cells; columns are counted outward from the middle, the same
// on both sides.
class Ray {
 public:
  Ray(ImageView<const std::uint8_t> type, const GridGeometry& geometry, double direction)
      : type_(type),
        geometry_(geometry),
        forward_(snapped(std::cos(direction))),
        left_(snapped(std::sin(direction))),
        middle_width_(geometry.cols % 2 == 0 ? 0.0 : 0.5) {}

  Meets at(double length) const {
    const double row = row_at(length);
    const double outward = outward_at(length);
    if (row < 0 || row >= geometry_.rows || 2 * outward >= geometry_.cols) return Meets::outside;
    const int r = static_cast<int>(row);
    const int on_left = (geometry_.cols - 1) / 2 - static_cast<int>(outward);
    const int on_right = geometry_.cols / 2 + static_cast<int>(outward);
    if (left_ > 0) return meets(type_.at(on_left, r));
    if (left_ < 0) return meets(type_.at(on_right, r));
    return worse(meets(type_.at(on_left, r)), meets(type_.at(on_right, r)));
  }

  // Where the ray enters the cell that it is in after `length`.
  double entry(double length) const {
    const double row = row_at(length);
    const double outward = outward_at(length);
    const double by_row = row > 0 ? row / forward_ : 0.0;
    const double by_column = outward > 0 ? (outward - middle_width_) / std::abs(left_) : 0.0;
    return std::min(length, std::max(by_row, by_column));
  }

 private:
  double row_at(double length) const { return std::floor(length * forward_ + kRounding); }
  double outward_at(double length) const {
    return std::floor(length * std::abs(left_) + middle_width_ + kRounding);
  }

  ImageView<const std::uint8_t> type_;
  GridGeometry geometry_;
  double forward_;
  double left_;
  double middle_width_;
};

double cell_metres(const GridGeometry& geometry) {
  return geometry.cell_mm / 1000.0;
}

}  // namespace

RayView look_along(ImageView<const std::uint8_t> type, const GridGeometry& geometry, double direction,
                   double blind_zone_m) {
  const Ray ray(type, geometry, direction);
  const double cell_m = cell_metres(geometry);
  const double blind_cells = blind_zone_m / cell_m + 1 + kRounding;
  bool known = false;
  double gap = -1;  // where the unknown cells begin that the ray is passing over
  for (int half_cells = 1;; ++half_cells) {
    const double length = half_cells / 2.0;
    const bool blind = length <= blind_cells;
    const Meets there = ray.at(length);
    if (there == Meets::free && (blind || (known && gap < 0))) {
      known = true;
      gap = -1;
      continue;
    }
    if (there == Meets::unknown && blind) {
      if (gap < 0) gap = ray.entry(length) * cell_m;
      continue;
    }
    const bool is_obstacle = there == Meets::obstacle;
    if (!known && (!is_obstacle || !blind)) return {};
    if (gap >= 0 && !(is_obstacle && blind)) return {true, gap, ClearEnd::unknown};
    return {true, ray.entry(length) * cell_m, is_obstacle ? ClearEnd::obstacle : ClearEnd::unknown};
  }
}

double corridor_obstacle_m(ImageView<const std::uint8_t> type, const GridGeometry& geometry, double direction,
                           double radius_m) {
  const double forward = snapped(std::cos(direction));
  const double left = snapped(std::sin(direction));
  const double cell_m = cell_metres(geometry);
  const double reach_m = std::max(radius_m, cell_m * std::numbers::sqrt2 / 2);
  double nearest = std::numeric_limits<double>::infinity();
  for (int r = 0; r < geometry.rows; ++r) {
    const double ahead = (r + 0.5) * cell_m;
    for (int c = 0; c < geometry.cols; ++c) {
      if (type.at(c, r) != kCellObstacle) continue;
      const double aside = (geometry.cols - 1 - 2 * c) * cell_m / 2;
      const double along = ahead * forward + aside * left;
      const double beside = std::abs(ahead * left - aside * forward);
      if (along >= -kRounding && beside <= reach_m + kRounding)
        nearest = std::min(nearest, std::max(0.0, along - cell_m / 2));
    }
  }
  return nearest;
}

ClearDistance clear_distance(ImageView<const std::uint8_t> type, const GridGeometry& geometry, double direction,
                             double blind_zone_m, double radius_m) {
  const RayView ray = look_along(type, geometry, direction, blind_zone_m);
  const double obstacle_m = corridor_obstacle_m(type, geometry, direction, radius_m);
  if (obstacle_m <= ray.clear_m) return {obstacle_m, ClearEnd::obstacle};
  return {ray.clear_m, ray.end};
}

}  // namespace lakshya
