#include "app/tools/sim_film_picture.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "app/nav/sectors.h"
#include "app/tools/picture_colors.h"
#include "app/tools/picture_panels.h"
#include "app/tools/picture_plot.h"

namespace lakshya {
namespace {

constexpr int kPanelWidth = kFilmWidth / 2;
constexpr int kPanelHeight = 360;
constexpr int kStatusY = 386;  // baselines
constexpr int kLegendTop = 394;
constexpr std::uint8_t kNoCamera = 110;  // grey under the tints
constexpr Rgb8 kObstacleCell{200, 60, 45};

Rgb8 cell_color(std::uint8_t type) {
  return type == kCellObstacle ? kObstacleCell : type == kCellUnoccupied ? kFreeCell : kUnknownCell;
}

// class_color() of everything that there is: every frame of a drive is tinted.
class TintTable {
 public:
  TintTable() {
    for (std::size_t row = 0; row < kRows; ++row) {
      const auto pixel_class = static_cast<PixelClass>(row < kPixelClasses ? row : 0);
      // Row 0: matched, but nothing concluded; those after the classes: no disparity, for a reason.
      const int reason = row < kPixelClasses ? 0 : kPixelClasses - 1 - static_cast<int>(row);
      for (std::size_t gray = 0; gray < 256; ++gray)
        colors_[row][gray] =
            class_color(pixel_class, static_cast<std::int16_t>(reason), static_cast<std::uint8_t>(gray));
    }
  }
  Rgb8 at(PixelClass pixel_class, std::int16_t disparity, std::uint8_t gray) const {
    const bool has_reason =
        pixel_class == PixelClass::no_disparity && disparity < 0 && disparity >= -kNoDisparityReasons;
    const int row = has_reason ? kPixelClasses - 1 - disparity : static_cast<int>(pixel_class);
    return colors_[static_cast<std::size_t>(row)][gray];
  }

 private:
  static constexpr std::size_t kRows = kPixelClasses + kNoDisparityReasons;
  std::array<std::array<Rgb8, 256>, kRows> colors_{};
};

// As much of the map as matters for the next seconds.
double shown_m(const VehicleConfig& config) {
  return std::clamp(1.25 * config.planner.active_radius_m, 2.5, 8.0);
}

MapView map_view(const VehicleConfig& config) {
  const double behind = 1.3 * config.vehicle.radius_m;
  const double scale = kPanelHeight / (shown_m(config) + behind);
  return {{kPanelWidth / 2.0, kPanelHeight - behind * scale}, scale};
}

void draw_cells(Canvas& area, const MapView& view, const NavGrid& grid) {
  area.fill({0, 0, area.width(), area.height()}, kOutsideMap);
  const double cell_m = grid.geometry.cell_mm / 1000.0;
  if (grid.type.width <= 0 || grid.type.height <= 0 || cell_m <= 0) return;
  const double per_cell = view.scale * cell_m;
  const double left = view.origin.x - grid.type.width / 2.0 * per_cell;
  for (int y = 0; y < area.height(); ++y) {
    const auto row = static_cast<int>(std::floor((view.origin.y - y - 0.5) / per_cell));
    if (row < 0 || row >= grid.type.height) continue;
    for (int x = 0; x < area.width(); ++x) {
      const auto col = static_cast<int>(std::floor((x + 0.5 - left) / per_cell));
      if (col >= 0 && col < grid.type.width) area.set(x, y, cell_color(grid.type.at(col, row)));
    }
  }
}

void draw_rings(Canvas& area, const MapView& view, double farthest_m) {
  constexpr double kLabels = -0.7;  // rad
  const double step = farthest_m > 4 ? 2 : 1;
  for (double r = step; r < 1.6 * farthest_m; r += step) {
    area.line(arc_points(view.origin, r * view.scale, -1.57, 1.57), mix(kUnknownCell, kInk, 0.25), 1);
    // To the right: ahead lies what is chosen.
    const Point at = view.at(r * std::cos(kLabels), r * std::sin(kLabels));
    if (at.x > area.width() - 40 || at.y < 20) continue;
    area.text({at.x + 4, at.y}, decimal(r, 0) + " m", kSmallText, kPaper, Align::left, 4);
    area.text({at.x + 4, at.y}, decimal(r, 0) + " m", kSmallText, kInk);
  }
}

void draw_vehicle(Canvas& area, const MapView& view, double radius_m) {
  const std::vector<Point> body = arc_points(view.origin, radius_m * view.scale, -3.15, 3.15);
  area.polygon(body, kVehicleColor);
  area.line(body, kInk, 2);
  area.line({view.origin, view.at(radius_m, 0)}, kInk, 2);
}

void draw_ways(Canvas& area, const MapView& view, const PlanNote& plan, double farthest_m) {
  const auto towards = [&](double direction, double length) {
    return view.at(length * std::cos(direction), length * std::sin(direction));
  };
  area.line({view.origin, towards(plan.target, 0.9 * farthest_m)}, kTargetColor, 2, Stroke::dashed);
  if (plan.blocked) return;
  // An arrow of some length even where it is hardly clear.
  const double length = std::clamp(plan.clear_m, 0.25 * farthest_m, 0.95 * farthest_m);
  area.arrow({view.origin, towards(plan.direction, length)}, kChosenColor, 4);
}

void caption(Canvas& area, const std::string& text) {
  const int width = text_width(text, kSmallText) + 12;
  area.fill({0, 0, width, 20}, kPaper, 0.8);
  area.text({6, 14}, text, kSmallText, kInk);
}

void draw_map(Canvas& area, const FilmPicture& input) {
  const MapView view = map_view(input.config);
  const double farthest = shown_m(input.config);
  draw_cells(area, view, input.frame.grid);
  draw_rings(area, view, farthest);
  draw_ways(area, view, input.plan, farthest);
  draw_vehicle(area, view, input.config.vehicle.radius_m);
  caption(area, "map near the vehicle");
  if (!input.plan.blocked) return;
  const Box box{kPanelWidth / 2 - 90, 26, 180, 30};
  area.fill(box, kPaper);
  area.fill({box.x + 2, box.y + 2, box.width - 4, box.height - 4}, kBlockedColor);
  area.text({kPanelWidth / 2.0, 47}, input.plan.recovery == Side::left ? "no way: turn left" : "no way: turn right",
            kHeadText, kPaper, Align::center);
}

// Fields that stay where they are while their numbers change.
void draw_status(Canvas& sheet, const FilmPicture& input) {
  const StatusNote& s = input.status;
  const double speed = (s.wheels.left_mps + s.wheels.right_mps) / 2;
  const auto field = [&](double x, const std::string& text, Rgb8 color) {
    sheet.text({x, kStatusY}, text, kBodyText, color);
  };
  field(10, decimal(input.time_s, 1) + " s", kInk);
  field(86, to_string(s.state), s.state == State::run ? kChosenColor : kBlockedColor);
  field(190, "at " + decimal(s.pose.east_m, 1) + ", " + decimal(s.pose.north_m, 1) + " m", kInk);
  field(338, decimal(speed, 2) + " m/s", kInk);
  field(440, input.plan.blocked ? "no way open" : "steers " + degrees_text(input.plan.direction), kInk);
  field(616, input.plan.nearest_m < 0 ? "no obstacle" : "nearest " + decimal(input.plan.nearest_m, 1) + " m", kInk);
  field(772, "frame " + decimal(static_cast<double>(input.plan.took) / 1e6, 1) + " ms", kFaintInk);
}

LegendItem cell_item(const char* text, Rgb8 color) {
  return {text, [color](Canvas& canvas, const Box& swatch) {
            canvas.fill(swatch, color);
            canvas.frame(swatch, kFaintInk);
          }};
}

void draw_legends(Canvas& sheet) {
  const auto tint = [](const char* text, PixelClass pixel_class) {
    return cell_item(text, class_color(pixel_class, 0, 150));
  };
  draw_legend(sheet, {10, kLegendTop}, kPanelWidth,
              {tint("obstacle", PixelClass::obstacle), tint("floor", PixelClass::floor),
               tint("drop-off", PixelClass::drop_off), tint("overhead", PixelClass::ceiling)});
  draw_legend(
      sheet, {kPanelWidth + 6, kLegendTop}, kPanelWidth,
      {cell_item("obstacle", kObstacleCell), cell_item("free", kFreeCell), cell_item("unknown", kUnknownCell),
       line_item("way", kChosenColor, 4, Stroke::solid), line_item("goal", kTargetColor, 2, Stroke::dashed)});
}

}  // namespace

Image<Rgb8> tinted_picture(const FrameResult& frame, bool has_camera) {
  static const TintTable tints;
  Image<Rgb8> picture(frame.left.width, frame.left.height);
  const auto out = picture.view();
  const bool has_classes = same_size(frame.left, frame.classes) && same_size(frame.left, frame.disparity);
  for (int v = 0; v < out.height; ++v) {
    for (int u = 0; u < out.width; ++u) {
      const std::uint8_t gray = has_camera ? frame.left.at(u, v) : kNoCamera;
      out.at(u, v) =
          has_classes ? tints.at(frame.classes.at(u, v), frame.disparity.at(u, v), gray) : Rgb8{gray, gray, gray};
    }
  }
  return picture;
}

Image<Rgb8> film_picture(const FilmPicture& input) {
  Canvas sheet(kFilmWidth, kFilmHeight, kPaper);
  const ImageView<const std::uint8_t>& left = input.frame.left;
  Canvas camera = sheet.part({0, 0, kPanelWidth, kPanelHeight});
  camera.fill({0, 0, kPanelWidth, kPanelHeight}, kInk);
  if (left.width > 0 && left.height > 0) {
    const double scale = std::min(1.0 * kPanelWidth / left.width, 1.0 * kPanelHeight / left.height);
    const int width = std::max(1, static_cast<int>(scale * left.width));
    const int height = std::max(1, static_cast<int>(scale * left.height));
    camera.paste(tinted_picture(input.frame, input.has_camera).view(),
                 {(kPanelWidth - width) / 2, (kPanelHeight - height) / 2, width, height}, Enlarge::smooth);
  }
  caption(camera, input.has_camera ? "left camera" : "left camera (not looked at by this sensor)");
  Canvas map = sheet.part({kPanelWidth, 0, kPanelWidth, kPanelHeight});
  draw_map(map, input);
  sheet.fill({kPanelWidth, 0, 2, kPanelHeight}, kPaper);
  draw_status(sheet, input);
  draw_legends(sheet);
  return sheet.image();
}

Image<Rgb8> with_ending(const Image<Rgb8>& picture, const std::string& ending, bool ended_well) {
  Canvas sheet(picture.width(), picture.height(), kPaper);
  sheet.paste(picture.view(), {0, 0, picture.width(), picture.height()});
  const std::string text = text_that_fits(ending, kTitleText, picture.width() - 60);
  const int width = text_width(text, kTitleText) + 60;
  const Box box{(picture.width() - width) / 2, kPanelHeight / 2 - 28, width, 56};
  sheet.fill(box, kPaper, 0.92);
  sheet.frame(box, kInk);
  sheet.text({picture.width() / 2.0, kPanelHeight / 2 + 8.0}, text, kTitleText,
             ended_well ? Rgb8{0, 120, 88} : Rgb8{190, 10, 10}, Align::center, 2);
  return sheet.image();
}

}  // namespace lakshya
