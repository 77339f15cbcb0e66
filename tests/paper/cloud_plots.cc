#include "tests/paper/cloud_plots.h"

#include <algorithm>
#include <cmath>

#include "app/tools/picture_colors.h"

namespace lakshya::paper {
namespace {

constexpr double kBelow = 0.3;        // m of the side view below the floor
constexpr double kLeastTickGap = 60;  // px

struct SideView {
  double per_forward = 1;  // px per metre
  double per_height = 1;
  double zero_y = 0;  // of the floor
  Point at(double forward_m, double height_m) const {
    return {forward_m * per_forward, zero_y - height_m * per_height};
  }
};

template <class Keep>
Cloud cloud_of(const test::RenderedPair& pair, const ProcessedFrame& run, Keep keep) {
  const FrameResult& frame = run.frame();
  const auto object = pair.left.object.view();
  Cloud cloud;
  for (int v = 0; v < object.height; ++v) {
    for (int u = 0; u < object.width; ++u) {
      if (!keep(frame.disparity.at(u, v), frame.classes.at(u, v))) continue;
      const ObstaclePoint p = reproject_pixel(run.pipeline().prune_model(), u, v, frame.disparity.at(u, v));
      cloud.push_back(
          {p.forward_mm / 1000.0, p.left_mm / 1000.0, p.height_mm / 1000.0, static_cast<Object>(object.at(u, v))});
    }
  }
  return cloud;
}

void dot_at(Canvas& area, Point p, Rgb8 color) {
  const int x = static_cast<int>(std::floor(p.x));
  const int y = static_cast<int>(std::floor(p.y));
  if (x >= 0 && x < area.width() && y >= 0 && y < area.height()) area.set(x, y, color);
}

// Large surfaces first, so that they do not cover the things before them.
template <class At>
void draw_points(Canvas& area, const Cloud& cloud, At at) {
  for (int object = 0; object < kObjects; ++object) {
    for (const CloudPoint& p : cloud) {
      if (p.object == static_cast<Object>(object)) dot_at(area, at(p), color_of(p.object));
    }
  }
}

std::string metres(double value, double step) {
  return decimal(value, step < 0.99 ? 1 : 0);
}

void draw_bottom_axis(Canvas& sheet, const Box& plot, double origin_x, double per_metre, double sign,
                      const std::string& name) {
  const double step = round_step(kLeastTickGap / per_metre);
  const auto last = static_cast<int>(std::ceil(plot.width / per_metre / step));
  for (int k = -last; k <= last; ++k) {
    const double x = origin_x + sign * k * step * per_metre;
    if (x < 0 || x > plot.width) continue;
    sheet.fill({plot.x + static_cast<int>(x), plot.bottom(), 1, 5}, kInk);
    sheet.text({plot.x + x, plot.bottom() + 9 + kSmallText}, metres(k * step, step), kSmallText, kInk,
               Align::center);
  }
  sheet.text({plot.x + plot.width / 2.0, plot.bottom() + 24 + kSmallText}, name, kSmallText, kFaintInk,
             Align::center);
}

void draw_left_axis(Canvas& sheet, const Box& plot, double zero_y, double per_metre, const std::string& name) {
  const double step = round_step(0.6 * kLeastTickGap / per_metre);
  for (int k = 0; k * step * per_metre <= zero_y - kSmallText; ++k) {
    const double y = zero_y - k * step * per_metre;
    sheet.fill({plot.x - 5, plot.y + static_cast<int>(y), 5, 1}, kInk);
    sheet.text({plot.x - 9.0, plot.y + y + kSmallText / 2}, metres(k * step, step), kSmallText, kInk, Align::right);
  }
  sheet.text({plot.x - 9.0, plot.y - 10.0}, name, kSmallText, kFaintInk, Align::right);
}

// A label that ends here, on a white ground, so that points do not swallow it.
void draw_note(Canvas& area, Point end, const std::string& text) {
  const int width = text_width(text, kSmallText);
  area.fill({static_cast<int>(end.x) - width - 2, static_cast<int>(end.y - kSmallText) - 3, width + 4, 15}, kPaper,
            0.85);
  area.text(end, text, kSmallText, kInk, Align::right);
}

void draw_limits(Canvas& area, const SideView& view, const PruneConfig& limits, double ahead_m, double up_m) {
  area.line({view.at(0, 0), view.at(ahead_m, 0)}, kInk, 1);
  if (limits.clearance_m < up_m) {
    area.line({view.at(0, limits.clearance_m), view.at(ahead_m, limits.clearance_m)}, kInk, 1, Stroke::dashed);
    const Point end = view.at(ahead_m, limits.clearance_m);
    draw_note(area, {end.x - 6, end.y - 6}, "clearance " + decimal(limits.clearance_m, 1) + " m");
  }
  if (limits.max_depth_m < ahead_m) {
    area.line({view.at(limits.max_depth_m, -kBelow), view.at(limits.max_depth_m, up_m)}, kInk, 1, Stroke::dashed);
    const Point top = view.at(limits.max_depth_m, up_m);
    draw_note(area, {top.x - 6, top.y + 17}, "depth " + decimal(limits.max_depth_m, 1) + " m");
  }
}

void draw_side_outlines(Canvas& area, const SideView& view, const PaperScene& scene) {
  for (const Thing& t : scene.things) {
    const test::Cuboid& c = t.cuboid;
    const double half =
        (std::abs(std::cos(c.yaw)) * c.size.x + std::abs(std::sin(c.yaw)) * c.size.y) / 2;  // along forward
    const Point low = view.at(c.base.x - half, c.base.z);
    const Point high = view.at(c.base.x + half, c.base.z + c.size.z);
    area.line({low, {low.x, high.y}, high, {high.x, low.y}, low}, kInk, 1);
  }
}

}  // namespace

Rgb8 color_of(Object object) {
  constexpr std::array<Rgb8, kObjects> kColors = {{{120, 120, 120},
                                                   {150, 152, 156},
                                                   {86, 180, 233},
                                                   {0, 114, 178},
                                                   {230, 159, 0},
                                                   {213, 94, 0},
                                                   {204, 121, 167}}};
  return kColors[static_cast<std::size_t>(object)];
}

Cloud whole_cloud(const test::RenderedPair& pair, const ProcessedFrame& run) {
  return cloud_of(pair, run, [](std::int16_t d, PixelClass) { return d > 0; });
}

Cloud pruned_cloud(const test::RenderedPair& pair, const ProcessedFrame& run) {
  return cloud_of(pair, run, [](std::int16_t, PixelClass c) { return c == PixelClass::obstacle; });
}

void draw_side_view(Canvas& sheet, const Box& plot, const PaperScene& scene, const Cloud& cloud,
                    const PruneConfig& limits, double ahead_m, double up_m) {
  const double per_height = plot.height / (up_m + kBelow);
  const SideView view{plot.width / ahead_m, per_height, up_m * per_height};
  Canvas area = sheet.part(plot);
  area.fill({0, 0, plot.width, plot.height}, kFreeCell);
  draw_points(area, cloud, [&](const CloudPoint& p) { return view.at(p.forward_m, p.height_m); });
  draw_side_outlines(area, view, scene);
  draw_limits(area, view, limits, ahead_m, up_m);
  sheet.frame(plot, kFaintInk);
  draw_bottom_axis(sheet, plot, 0, view.per_forward, 1, "metres ahead");
  draw_left_axis(sheet, plot, view.zero_y, per_height, "up");
}

void draw_outlines(Canvas& area, const MapView& view, const PaperScene& scene) {
  for (const Thing& t : scene.things) {
    const test::Cuboid& c = t.cuboid;
    std::vector<Point> outline;
    for (const auto& [a, b] : {std::pair{-0.5, -0.5}, {-0.5, 0.5}, {0.5, 0.5}, {0.5, -0.5}, {-0.5, -0.5}}) {
      const double x = a * c.size.x;
      const double y = b * c.size.y;
      outline.push_back(view.at(c.base.x + std::cos(c.yaw) * x - std::sin(c.yaw) * y,
                                c.base.y + std::sin(c.yaw) * x + std::cos(c.yaw) * y));
    }
    area.line(outline, color_of(t.object), 2);
  }
}

void draw_top_view(Canvas& sheet, const Box& plot, const MapView& view, const PaperScene& scene,
                   const Cloud& cloud) {
  Canvas area = sheet.part(plot);
  area.fill({0, 0, plot.width, plot.height}, kFreeCell);
  draw_points(area, cloud, [&](const CloudPoint& p) { return view.at(p.forward_m, p.left_m); });
  draw_outlines(area, view, scene);
  area.arrow({view.at(0, 0), {view.origin.x, view.origin.y - 34}}, kInk, 3);
  sheet.frame(plot, kFaintInk);
  draw_bottom_axis(sheet, plot, view.origin.x, view.scale, -1, "metres to the left");
  draw_left_axis(sheet, plot, view.origin.y, view.scale, "ahead");
}

void draw_step_bars(Canvas& sheet, const Box& box, const StepCounts& kept) {
  constexpr int kRow = 38;
  constexpr int kName = 100;
  constexpr int kCount = 66;
  const double all = std::max(1, total(kept[0]));
  for (std::size_t step = 0; step < kSteps; ++step) {
    const int y = box.y + static_cast<int>(step) * kRow;
    const double baseline = y + (kRow + kBodyText) / 2;
    sheet.text({static_cast<double>(box.x), baseline}, kStepNames[step], kBodyText, kInk);
    double x = box.x + kName;
    for (int object = 0; object < kObjects; ++object) {
      const double width = (box.width - kName - kCount) * kept[step][static_cast<std::size_t>(object)] / all;
      sheet.fill({static_cast<int>(std::lround(x)), y + 6,
                  static_cast<int>(std::lround(x + width) - std::lround(x)), kRow - 12},
                 color_of(static_cast<Object>(object)));
      x += width;
    }
    sheet.text({static_cast<double>(box.right()), baseline}, std::to_string(total(kept[step])), kBodyText, kInk,
               Align::right);
  }
}

}  // namespace lakshya::paper
