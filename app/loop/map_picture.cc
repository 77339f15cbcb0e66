#include "app/loop/map_picture.h"

#include <algorithm>
#include <cmath>

#include "kernels/base/units.h"

namespace lakshya {
namespace {

constexpr int kLeastSide = 600;  // px
constexpr Rgb8 kObstacle{200, 40, 30};
constexpr Rgb8 kFree{250, 250, 248};
constexpr Rgb8 kUnknown{176, 178, 182};
constexpr Rgb8 kVehicle{230, 159, 0};
constexpr Rgb8 kChosen{0, 90, 181};
constexpr Rgb8 kTarget{20, 20, 20};

class MapCanvas {
 public:
  MapCanvas(ImageView<const std::uint8_t> type, double cell_m)
      : scale_(std::max(1, (kLeastSide + type.height - 1) / std::max(type.height, 1))),
        px_per_m_(scale_ / cell_m),
        image_(type.width * scale_, type.height * scale_, kUnknown) {
    for (int v = 0; v < image_.height(); ++v) {
      for (int u = 0; u < image_.width(); ++u) {
        const std::uint8_t cell = type.at(u / scale_, type.height - 1 - v / scale_);
        image_.view().at(u, v) = cell == kCellObstacle ? kObstacle : cell == kCellUnoccupied ? kFree : kUnknown;
      }
    }
  }

  // Metres from the turning centre.
  void dot(double forward_m, double left_m, double radius_m, Rgb8 color) {
    const double u0 = image_.width() / 2.0 - left_m * px_per_m_;
    const double v0 = image_.height() - forward_m * px_per_m_;
    const double r = std::max(radius_m * px_per_m_, 1.0);
    for (int v = std::max(0, static_cast<int>(v0 - r));
         v <= std::min(image_.height() - 1, static_cast<int>(v0 + r)); ++v) {
      for (int u = std::max(0, static_cast<int>(u0 - r));
           u <= std::min(image_.width() - 1, static_cast<int>(u0 + r)); ++u) {
        if (std::hypot(u - u0, v - v0) <= r) image_.view().at(u, v) = color;
      }
    }
  }

  void ray(double direction, double length_m, Rgb8 color) {
    for (double at = 0; at <= length_m; at += 0.5 / px_per_m_)
      dot(at * std::cos(direction), at * std::sin(direction), 0, color);
  }

  Image<Rgb8> take() { return std::move(image_); }

 private:
  int scale_;
  double px_per_m_;
  Image<Rgb8> image_;
};

}  // namespace

Image<Rgb8> loop_map_picture(ImageView<const std::uint8_t> type, const PlanNote& plan,
                             const VehicleConfig& config) {
  MapCanvas canvas(type, config.grid.cell_m);
  canvas.dot(0, 0, config.vehicle.radius_m, kVehicle);
  constexpr double kTargetLength = 1.0;  // m
  canvas.ray(plan.target, std::max(kTargetLength, 3 * config.vehicle.radius_m), kTarget);
  if (!plan.blocked) canvas.ray(plan.direction, plan.clear_m, kChosen);
  return canvas.take();
}

}  // namespace lakshya
