#include "app/tools/picture_map_overlay.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "app/nav/sectors.h"
#include "app/tools/picture_colors.h"

namespace lakshya {
namespace {

constexpr double kPi = std::numbers::pi;

// Labels inside the map that keep clear of each other.
class Labels {
 public:
  explicit Labels(Canvas& area) : area_(&area) {}

  void keep_clear(const Box& box) { taken_.push_back(box); }

  // Near the point, moved up or down until it is free.
  void put(Point at, const std::string& text, Rgb8 color) {
    constexpr int kHeight = 22;
    const int width = text_width(text, kBodyText) + 12;
    Box box{static_cast<int>(at.x) - width / 2, static_cast<int>(at.y) - kHeight / 2, width, kHeight};
    box.x = std::clamp(box.x, 4, std::max(4, area_->width() - width - 4));
    const int wanted = box.y;
    for (int attempt = 0; attempt < 12; ++attempt) {
      const int away = (attempt + 1) / 2 * (kHeight + 3);
      box.y = std::clamp(attempt % 2 == 0 ? wanted - away : wanted + away, 4,
                         std::max(4, area_->height() - kHeight - 4));
      const bool is_free =
          std::none_of(taken_.begin(), taken_.end(), [&](const Box& other) { return overlap(box, other); });
      if (is_free) break;
    }
    taken_.push_back(box);
    area_->fill(box, kPaper, 0.88);
    area_->frame(box, color);
    area_->text({box.x + 6.0, box.y + (kHeight + kBodyText) / 2}, text, kBodyText, color);
  }

 private:
  Canvas* area_;
  std::vector<Box> taken_;
};

Point towards(const MapView& view, double direction, double distance_m) {
  return view.at(distance_m * std::cos(direction), distance_m * std::sin(direction));
}

// Direction on the ground of the image column u, on the row of the principal point.
double column_direction(const PictureInput& input, double u) {
  const double pitch = radians(input.config.camera.pitch_deg);
  const double roll = radians(input.config.camera.roll_deg);
  const double x = (u - input.camera.cx_left) / input.camera.focal_px;
  const double forward = std::cos(pitch) - std::sin(pitch) * std::sin(roll) * x;
  return std::atan2(-std::cos(roll) * x, forward) + radians(input.config.camera.yaw_deg);
}

struct FieldOfView {
  double left = 0;
  double right = 0;
};

FieldOfView field_of_view(const PictureInput& input) {
  return {column_direction(input, -0.5), column_direction(input, input.camera.width - 0.5)};
}

void draw_field_of_view(Canvas& area, const MapView& view, const PictureInput& input) {
  const FieldOfView fov = field_of_view(input);
  const CameraConfig& camera = input.config.camera;
  for (const double side : {fov.left, fov.right}) {
    const double range = input.config.prune.max_depth_m / std::max(std::cos(side), 0.1);
    const Point near = view.at(camera.forward_m, camera.left_m);
    const Point far = view.at(camera.forward_m + range * std::cos(side), camera.left_m + range * std::sin(side));
    area.line({near, far}, kViewColor, 1);
  }
  area.line(arc_points(view.origin, input.blind_zone_m * view.scale, fov.right, fov.left), kViewColor, 1,
            Stroke::dashed);
}

void draw_vehicle(Canvas& area, const MapView& view, const VehicleParams& vehicle) {
  const double radius = vehicle.radius_m * view.scale;
  const double ring = radius + vehicle.safety_distance_m * view.scale;
  const auto body = arc_points(view.origin, radius, -kPi, kPi);
  area.polygon(body, kVehicleColor, 0.55);
  area.line(body, kInk, 2);
  area.line(arc_points(view.origin, ring, -kPi, kPi), kInk, 1);
  area.polygon(arc_points(view.origin, 3, -kPi, kPi), kInk);
}

// Where arcs and the target's line end: at the active radius, as far as the plot shows it.
double plan_radius_m(const MapView& view, const PictureInput& input) {
  return std::min(input.config.planner.active_radius_m, 0.9 * view.origin.y / view.scale);
}

void draw_openings(Canvas& area, const MapView& view, const Openings& openings, double radius_m, double thickness) {
  for (const Opening& opening : openings.view()) {
    const double right = sector_centre(opening.first) - kSectorAngle / 2;
    const auto arc = arc_points(view.origin, radius_m * view.scale, right, right + opening.count * kSectorAngle);
    area.line(arc, kPaper, thickness + 3);
    area.line(arc, kOpeningColor, thickness);
  }
}

void draw_target(Canvas& area, const MapView& view, double target, double radius_m) {
  const std::vector<Point> line{view.origin, towards(view, target, radius_m)};
  area.line(line, kPaper, 5);
  area.line(line, kTargetColor, 2, Stroke::dashed);
  const Point end = line.back();
  area.polygon(arc_points(end, 7, -kPi, kPi), kPaper);
  area.polygon(arc_points(end, 5, -kPi, kPi), kTargetColor);
}

// As long as the clear distance, but never shorter than can be seen.
Point chosen_tip(const MapView& view, const PictureInput& input) {
  const Plan& plan = input.frame.plan;
  return towards(view, plan.direction, std::max(plan.clear_distance_m, 40 / view.scale));
}

void draw_recovery(Canvas& area, const MapView& view, const PictureInput& input) {
  const VehicleParams& vehicle = input.config.vehicle;
  const double radius = std::max(1.35 * (vehicle.radius_m + vehicle.safety_distance_m) * view.scale, 24.0);
  const double side = input.frame.plan.recovery == Side::left ? 1 : -1;
  area.arrow(arc_points(view.origin, radius, -0.35 * kPi * side, 0.4 * kPi * side), kBlockedColor, 4);
}

void draw_blocked_banner(Canvas& area, const Plan& plan) {
  const std::string text = plan.recovery == Side::left ? "BLOCKED: turn left" : "BLOCKED: turn right";
  const int width = text_width(text, kTitleText) + 40;
  const Box box{(area.width() - width) / 2, 16, width, 44};
  area.fill(box, kBlockedColor);
  area.text({area.width() / 2.0, box.y + (box.height + kTitleText) / 2}, text, kTitleText, kPaper, Align::center,
            2);
}

void draw_labels(Canvas& area, const MapView& view, const PictureInput& input, double radius_m) {
  const Plan& plan = input.frame.plan;
  Labels labels(area);
  labels.keep_clear({0, area.height() - 34, 170, 34});  // the scale bar
  if (plan.blocked) {
    labels.keep_clear({0, 10, area.width(), 56});  // the banner
  } else {
    const Point tip = chosen_tip(view, input);
    labels.put({tip.x, std::max(tip.y, 30.0) - 18}, "chosen " + degrees_text(plan.direction), kChosenColor);
  }
  const Point end = towards(view, input.target_rad, radius_m);
  labels.put({end.x, end.y - 20}, "target " + degrees_text(input.target_rad), kTargetColor);
  const double active = input.config.planner.active_radius_m;
  const double outward =
      std::min(radians(58), std::asin(std::min(0.92 * view.origin.x / (active * view.scale), 1.0)));
  const Point ring = towards(view, -outward, active);
  if (ring.y > 0) labels.put(ring, "active radius " + decimal(active, 1) + " m", kActiveColor);
}

}  // namespace

void draw_map_overlay(Canvas& area, const MapView& view, const PictureInput& input, MapDetail detail) {
  const Plan& plan = input.frame.plan;
  const double radius_m = plan_radius_m(view, input);
  draw_field_of_view(area, view, input);
  area.line(arc_points(view.origin, input.config.planner.active_radius_m * view.scale, -kPi, kPi), kActiveColor, 1);
  draw_openings(area, view, plan.openings, 0.97 * radius_m, detail == MapDetail::full ? 6 : 3);
  draw_target(area, view, input.target_rad, radius_m);
  draw_vehicle(area, view, input.config.vehicle);
  if (plan.blocked) {
    draw_recovery(area, view, input);
    if (detail == MapDetail::full) draw_blocked_banner(area, plan);
  } else {
    area.arrow({view.origin, chosen_tip(view, input)}, kChosenColor, detail == MapDetail::full ? 5 : 3);
  }
  if (detail == MapDetail::full) draw_labels(area, view, input, radius_m);
}

}  // namespace lakshya
