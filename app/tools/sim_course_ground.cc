// The simulated world's ground from above.
#include <algorithm>
#include <cmath>

#include "app/tools/picture_colors.h"
#include "app/tools/sim_course.h"

namespace lakshya {
namespace {

using sim::GroundPatch;

constexpr Rgb8 kIndoorFloor{246, 243, 237};
constexpr Rgb8 kOutdoorGround{232, 238, 222};
constexpr Rgb8 kLevelPatch{238, 226, 200};
constexpr Rgb8 kRampLow{240, 226, 196};
constexpr Rgb8 kRampHigh{214, 176, 120};
constexpr Rgb8 kKerb{150, 146, 140};
constexpr Rgb8 kDropOff{52, 30, 58};
constexpr Rgb8 kDropOffHatch{150, 90, 150};

bool is_ramp(const GroundPatch& p) {
  return !p.dropoff && !p.obstacle && (p.slope_x != 0 || p.slope_y != 0);
}

void draw_ramp(Canvas& map, const CourseView& view, const GroundPatch& p) {
  constexpr int kStrips = 24;
  const bool along_x = std::abs(p.slope_x) >= std::abs(p.slope_y);
  const bool rises = along_x ? p.slope_x > 0 : p.slope_y > 0;
  for (int i = 0; i < kStrips; ++i) {
    const double from = static_cast<double>(i) / kStrips;
    const double to = (i + 1.0) / kStrips;
    const Rgb8 color = mix(kRampLow, kRampHigh, rises ? from : 1 - from);
    const double w = p.x1 - p.x0;
    const double h = p.y1 - p.y0;
    map.fill(along_x ? view.box(p.x0 + from * w, p.y0, p.x0 + to * w, p.y1)
                     : view.box(p.x0, p.y0 + from * h, p.x1, p.y0 + to * h),
             color);
  }
  const Point low{along_x ? (rises ? p.x0 : p.x1) : 0, along_x ? 0 : (rises ? p.y0 : p.y1)};
  const Point high{along_x ? (rises ? p.x1 : p.x0) : 0, along_x ? 0 : (rises ? p.y1 : p.y0)};
  for (const double across : {0.2, 0.8}) {
    const double x = p.x0 + across * (p.x1 - p.x0);
    const double y = p.y0 + across * (p.y1 - p.y0);
    const auto at = [&](double share) {
      return along_x ? view.at(low.x + share * (high.x - low.x), y) : view.at(x, low.y + share * (high.y - low.y));
    };
    map.arrow({at(0.15), at(0.85)}, {130, 92, 44}, 1.5);
  }
}

LegendItem framed_item(const std::string& text, Rgb8 color, bool hatched) {
  return {text, [=](Canvas& canvas, const Box& swatch) {
            canvas.fill(swatch, color);
            if (hatched) canvas.hatch(swatch, kDropOffHatch, 7);
            canvas.frame(swatch, kFaintInk);
          }};
}

void draw_patch(Canvas& map, const CourseView& view, const GroundPatch& p) {
  const Box box = view.box(p.x0, p.y0, p.x1, p.y1);
  if (p.dropoff) {
    map.fill(box, kDropOff);
    map.hatch(box, kDropOffHatch, 9);
  } else if (p.obstacle) {
    map.fill(box, kKerb);
  } else if (is_ramp(p)) {
    draw_ramp(map, view, p);
  } else {
    map.fill(box, p.height_m == 0 ? kLevelPatch : mix(kRampLow, kRampHigh, 0.8));
  }
  map.frame(box, mix(kFaintInk, kPaper, p.height_m == 0 && !p.dropoff ? 0.6 : 0.0));
}

std::vector<LegendItem> ground_legend(const std::vector<GroundPatch>& patches) {
  const auto any = [&](auto is) { return std::ranges::any_of(patches, is); };
  std::vector<LegendItem> items;
  if (any(is_ramp)) items.push_back(framed_item("ramp, arrows uphill", mix(kRampLow, kRampHigh, 0.6), false));
  if (any([](const GroundPatch& p) { return !p.dropoff && !p.obstacle && !is_ramp(p) && p.height_m != 0; }))
    items.push_back(framed_item("platform", mix(kRampLow, kRampHigh, 0.8), false));
  if (any([](const GroundPatch& p) { return p.obstacle; })) items.push_back(framed_item("kerb", kKerb, false));
  if (any([](const GroundPatch& p) { return p.dropoff; })) items.push_back(framed_item("drop-off", kDropOff, true));
  return items;
}

}  // namespace

std::vector<LegendItem> draw_ground(Canvas& map, const CourseView& view, const sim::World& world) {
  const sim::Ground& ground = world.ground;
  map.fill({0, 0, map.width(), map.height()}, kOutsideMap);
  map.fill(view.box(ground.x0, ground.y0, ground.x1, ground.y1), world.indoor ? kIndoorFloor : kOutdoorGround);
  std::vector<GroundPatch> shown;
  for (const GroundPatch& patch : ground.patches) {
    const Box box = view.box(patch.x0, patch.y0, patch.x1, patch.y1);
    if (!overlap(box, {0, 0, map.width(), map.height()})) continue;
    draw_patch(map, view, patch);
    shown.push_back(patch);
  }
  return ground_legend(shown);
}

}  // namespace lakshya
