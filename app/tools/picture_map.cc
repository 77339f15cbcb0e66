// The navigation map from above, with what the planner made of it.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "app/nav/sectors.h"
#include "app/tools/picture_colors.h"
#include "app/tools/picture_map_overlay.h"
#include "app/tools/picture_panels.h"

namespace lakshya {
namespace {

constexpr int kLeastBehind = 36;      // px
constexpr double kLeastTickGap = 70;  // px

double cell_m(const NavGrid& grid) {
  return grid.geometry.cell_mm / 1000.0;
}

double ring_m(const VehicleConfig& config) {
  return config.vehicle.radius_m + config.vehicle.safety_distance_m;
}

// How far cells reach ahead and to either side.
struct Reach {
  double forward_m = 0;
  double side_m = 0;
};

Reach whole_reach(const NavGrid& grid) {
  return {grid.geometry.rows * cell_m(grid), grid.geometry.cols * cell_m(grid) / 2};
}

Reach known_reach(const NavGrid& grid) {
  Reach reach;
  for (int row = 0; row < grid.geometry.rows; ++row) {
    for (int col = 0; col < grid.geometry.cols; ++col) {
      if (grid.type.at(col, row) == kCellUnknown) continue;
      const int to_side = std::max(grid.geometry.cols / 2 - col, col + 1 - grid.geometry.cols / 2);
      reach.forward_m = (row + 1) * cell_m(grid);
      reach.side_m = std::max(reach.side_m, to_side * cell_m(grid));
    }
  }
  return reach;
}

Rgb8 cell_color(const NavGrid& grid, int col, int row, double clearance_m) {
  switch (grid.type.at(col, row)) {
    case kCellObstacle: {
      const std::uint32_t count = grid.count.at(col, row);
      if (count == 0) return kDropOffCell;
      return height_color(static_cast<double>(grid.height_sum.at(col, row)) / (1000.0 * count), clearance_m);
    }
    case kCellUnoccupied:
      return kFreeCell;
    default:
      return kUnknownCell;
  }
}

void draw_cells(Canvas& area, const MapView& view, const PictureInput& input) {
  const NavGrid& grid = input.frame.grid;
  const double per_cell = view.scale * cell_m(grid);
  const int cols = grid.geometry.cols;
  for (int y = 0; y < area.height(); ++y) {
    const auto row = static_cast<int>(std::floor((view.origin.y - y - 0.5) / per_cell));
    if (row < 0 || row >= grid.geometry.rows) continue;
    for (int x = 0; x < area.width(); ++x) {
      const auto col = static_cast<int>(std::floor(cols / 2.0 - (view.origin.x - x - 0.5) / per_cell));
      if (col < 0 || col >= cols) continue;
      area.set(x, y, cell_color(grid, col, row, input.config.prune.clearance_m));
    }
  }
}

double tick_step(const MapView& view) {
  return round_step(kLeastTickGap / view.scale);
}

std::string metres(double value, double step) {
  return decimal(value, step < 0.99 ? 1 : 0);
}

// Calls f(metres) for every tick from `first` px up to `last` px away from the turning centre.
template <class F>
void for_each_tick(const MapView& view, double first, double last, F f) {
  const double step = tick_step(view);
  for (auto k = static_cast<int>(std::ceil(first / view.scale / step)); k * step * view.scale <= last; ++k)
    f(k * step);
}

void draw_grid_lines(Canvas& area, const MapView& view) {
  constexpr double kOpacity = 0.16;
  for_each_tick(view, 0, view.origin.y, [&](double forward) {
    area.fill({0, static_cast<int>(view.at(forward, 0).y), area.width(), 1}, kInk, kOpacity);
  });
  for_each_tick(view, view.origin.x - area.width(), view.origin.x, [&](double left) {
    area.fill({static_cast<int>(view.at(0, left).x), 0, 1, static_cast<int>(view.origin.y)}, kInk, kOpacity);
  });
}

void draw_axes(Canvas& sheet, const Box& plot, const MapView& view) {
  const double step = tick_step(view);
  for_each_tick(view, 0, view.origin.y - kSmallText, [&](double forward) {
    const double y = plot.y + view.at(forward, 0).y;
    sheet.fill({plot.x - 5, static_cast<int>(y), 5, 1}, kInk);
    sheet.text({plot.x - 9.0, y + kSmallText / 2}, metres(forward, step), kSmallText, kInk, Align::right);
  });
  for_each_tick(view, view.origin.x - plot.width, view.origin.x, [&](double left) {
    const double x = plot.x + view.at(0, left).x;
    sheet.fill({static_cast<int>(x), plot.bottom(), 1, 5}, kInk);
    sheet.text({x, plot.bottom() + 9 + kSmallText}, metres(left, step), kSmallText, kInk, Align::center);
  });
  sheet.text({plot.x - 9.0, plot.y - 10.0}, "ahead", kSmallText, kFaintInk, Align::right);
  sheet.text({plot.x + plot.width / 2.0, plot.bottom() + 24 + kSmallText}, "metres to the left", kSmallText,
             kFaintInk, Align::center);
}

void draw_scale_bar(Canvas& area, const MapView& view) {
  const double length_m = round_step(0.6 * kLeastTickGap / view.scale);
  const auto length = static_cast<int>(std::lround(length_m * view.scale));
  const int y = area.height() - 14;
  area.fill({14, y, length, 4}, kInk);
  area.fill({14, y - 4, 2, 12}, kInk);
  area.fill({12 + length, y - 4, 2, 12}, kInk);
  area.text({22.0 + length, y + 2 + kSmallText / 2}, metres(length_m, length_m) + " m", kSmallText, kInk);
}

MapView bottom_centre(const PictureInput& input, int width, int height, double scale) {
  return {{width / 2.0, static_cast<double>(height - map_behind_px(scale, input.config))}, scale};
}

// The largest scale with which this much fits above the turning centre and on either side of it.
double fitting_scale(const PictureInput& input, int width, int height, const Reach& reach) {
  const double behind_m = 1.15 * ring_m(input.config);
  return std::min({width / (2 * reach.side_m), std::max(height - kLeastBehind, 1) / reach.forward_m,
                   height / (reach.forward_m + behind_m)});
}

}  // namespace

int map_behind_px(double scale, const VehicleConfig& config) {
  return std::max(kLeastBehind, static_cast<int>(std::lround(1.15 * ring_m(config) * scale)));
}

MapView whole_map_view(const PictureInput& input, int width, int height) {
  return bottom_centre(input, width, height, fitting_scale(input, width, height, whole_reach(input.frame.grid)));
}

MapView near_map_view(const PictureInput& input, int width, int height) {
  const NavGrid& grid = input.frame.grid;
  const double active = input.config.planner.active_radius_m;
  const double least = std::max(2 * ring_m(input.config), 0.3 * std::min(active, whole_reach(grid).forward_m));
  Reach reach = known_reach(grid);
  if (reach.forward_m == 0) {
    reach = {std::min(1.1 * active, whole_reach(grid).forward_m), std::min(1.1 * active, whole_reach(grid).side_m)};
  }
  const double most = std::max(1.5 * active, least);
  reach.forward_m = std::clamp(1.05 * reach.forward_m, least, most);
  reach.side_m = std::clamp(1.05 * reach.side_m, least, most);
  return bottom_centre(input, width, height, fitting_scale(input, width, height, reach));
}

void draw_map(Canvas& sheet, const Box& plot, const MapView& view, const PictureInput& input, MapDetail detail,
              const std::string& caption) {
  sheet.text({static_cast<double>(plot.x), plot.y - 10.0}, text_that_fits(caption, kHeadText, plot.width),
             kHeadText, kInk);
  Canvas area = sheet.part(plot);
  area.fill({0, 0, plot.width, plot.height}, kOutsideMap);
  draw_cells(area, view, input);
  draw_grid_lines(area, view);
  draw_map_overlay(area, view, input, detail);
  draw_scale_bar(area, view);
  sheet.frame(plot, kFaintInk);
  draw_axes(sheet, plot, view);
}

}  // namespace lakshya
