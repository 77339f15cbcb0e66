// What the colours mean: legends, the disparity scale and the pixel counts.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "app/tools/picture_colors.h"
#include "app/tools/picture_panels.h"

namespace lakshya {
namespace {

constexpr int kSwatchWidth = 26;
constexpr int kSwatchHeight = 14;
constexpr int kSwatchGap = 8;
constexpr int kItemGap = 22;
constexpr std::uint8_t kLegendGray = 150;  // the image under a class's tint

LegendItem circle_item(const std::string& text, void (*paint)(Canvas&, const std::vector<Point>&)) {
  return {text, [paint](Canvas& canvas, const Box& swatch) {
            const Point center{swatch.x + swatch.width / 2.0, swatch.y + swatch.height / 2.0};
            paint(canvas, arc_points(center, swatch.height / 2.0, -std::numbers::pi, std::numbers::pi));
          }};
}

LegendItem height_item(double clearance_m) {
  return {"obstacle, mean height 0 to " + decimal(clearance_m, 1) + " m", [](Canvas& canvas, const Box& swatch) {
            for (int x = 0; x < swatch.width; ++x)
              canvas.fill({swatch.x + x, swatch.y, 1, swatch.height}, height_color(x, swatch.width));
          }};
}

LegendItem chosen_item() {
  return {"chosen, up to the clear distance", [](Canvas& canvas, const Box& swatch) {
            const double y = swatch.y + swatch.height / 2.0;
            canvas.arrow({{static_cast<double>(swatch.x), y}, {static_cast<double>(swatch.right()), y}},
                         kChosenColor, 3);
          }};
}

struct CountRow {
  std::string name;
  Rgb8 color;
  std::uint32_t pixels;
};

CountRow class_row(const char* name, PixelClass pixel_class, const PixelCounts& counts) {
  return {name, class_color(pixel_class, 0, kLegendGray), counts.by_class[static_cast<int>(pixel_class)]};
}

CountRow reason_row(const char* name, NoDisparity reason, const PixelCounts& counts) {
  return {name, class_color(PixelClass::no_disparity, reason, kLegendGray), counts.by_reason[-reason - 1]};
}

std::uint32_t without_reason(const PixelCounts& counts) {
  std::uint32_t rest = counts.by_class[static_cast<int>(PixelClass::no_disparity)];
  for (const std::uint32_t reason : counts.by_reason)
    rest -= std::min(rest, reason);
  return rest;
}

void draw_count(Canvas& sheet, const Box& line, const CountRow& row, double all) {
  const double baseline = line.y + (line.height + kBodyText) / 2;
  const Box swatch{line.x, line.y + (line.height - kSwatchHeight) / 2, kSwatchWidth, kSwatchHeight};
  sheet.fill(swatch, row.color);
  sheet.frame(swatch, kFaintInk);
  sheet.text({swatch.right() + 8.0, baseline}, row.name, kBodyText, kInk);
  sheet.text({line.right() - 62.0, baseline}, std::to_string(row.pixels), kBodyText, kFaintInk, Align::right);
  sheet.text({static_cast<double>(line.right()), baseline}, decimal(100 * row.pixels / all, 1) + "%", kBodyText,
             kInk, Align::right);
}

// Labels that keep a least distance from the one before.
class Spaced {
 public:
  bool fits(double x, double half_width) {
    if (x - half_width < end_) return false;
    end_ = x + half_width + 12;
    return true;
  }

 private:
  double end_ = -1e9;
};

// Where a disparity lies on the bar.
double bar_x(const Box& bar, const DisparityScale& scale, double d) {
  return bar.x + (d - scale.first) / (scale.last - scale.first) * bar.width;
}

void draw_pixel_ticks(Canvas& sheet, const Box& bar, const DisparityScale& scale) {
  const double step = round_step((scale.last - scale.first) * 60 / bar.width);
  for (int k = static_cast<int>(std::ceil(scale.first / step)); k * step <= scale.last; ++k) {
    const double d = k * step;
    const double x = bar_x(bar, scale, d);
    sheet.fill({static_cast<int>(x), bar.bottom(), 1, 5}, kInk);
    sheet.text({x, bar.bottom() + 9 + kSmallText}, decimal(d, step < 1 ? 1 : 0), kSmallText, kInk, Align::center);
  }
}

// Round distances from far (left) to near, as many as there is room for.
void draw_metre_ticks(Canvas& sheet, const Box& bar, const DisparityScale& scale, double focal_baseline) {
  constexpr std::array kMetres = {100.0, 50.0, 30.0, 20.0, 15.0, 10.0, 8.0, 7.0,  6.0, 5.0, 4.0,
                                  3.5,   3.0,  2.5,  2.0,  1.8,  1.6,  1.4, 1.2,  1.0, 0.9, 0.8,
                                  0.7,   0.6,  0.5,  0.4,  0.3,  0.25, 0.2, 0.15, 0.1, 0.05};
  Spaced spaced;
  const auto tick = [&](double d, const std::string& label) {
    const double x = bar_x(bar, scale, d);
    if (!spaced.fits(x, text_width(label, kSmallText) / 2.0)) return;
    sheet.fill({static_cast<int>(x), bar.y - 5, 1, 5}, kInk);
    sheet.text({x, bar.y - 9.0}, label, kSmallText, kInk, Align::center);
  };
  if (scale.first == 0) tick(0, "inf");
  for (const double z : kMetres) {
    const double d = focal_baseline / z;
    if (d >= scale.first && d <= scale.last) tick(d, decimal(z, z < 0.995 ? 2 : 1));
  }
}

}  // namespace

LegendItem filled_item(const std::string& text, Rgb8 color) {
  return {text, [color](Canvas& canvas, const Box& swatch) { canvas.fill(swatch, color); }};
}

LegendItem line_item(const std::string& text, Rgb8 color, double thickness, Stroke stroke) {
  return {text, [=](Canvas& canvas, const Box& swatch) {
            const double y = swatch.y + swatch.height / 2.0;
            canvas.line({{static_cast<double>(swatch.x), y}, {static_cast<double>(swatch.right()), y}}, color,
                        thickness, stroke);
          }};
}

int draw_legend(Canvas& sheet, Point top_left, int width, const std::vector<LegendItem>& items) {
  const auto left = static_cast<int>(top_left.x);
  int x = left;
  auto y = static_cast<int>(top_left.y);
  for (const LegendItem& item : items) {
    const int needed = kSwatchWidth + kSwatchGap + text_width(item.text, kSmallText);
    if (x > left && x + needed > left + width) {
      x = left;
      y += kLegendRow;
    }
    const Box swatch{x, y + (kLegendRow - kSwatchHeight) / 2, kSwatchWidth, kSwatchHeight};
    item.draw(sheet, swatch);
    sheet.text({x + kSwatchWidth + kSwatchGap + 0.0, y + (kLegendRow + kSmallText) / 2}, item.text, kSmallText,
               kInk);
    x += needed + kItemGap;
  }
  return y + kLegendRow - static_cast<int>(top_left.y);
}

std::vector<LegendItem> map_legend(const PictureInput& input) {
  const auto cell = [](const std::string& text, Rgb8 color) {
    return LegendItem{text, [color](Canvas& canvas, const Box& swatch) {
                        canvas.fill(swatch, color);
                        canvas.frame(swatch, kFaintInk);
                      }};
  };
  return {height_item(input.config.prune.clearance_m),
          cell("drop-off", kDropOffCell),
          cell("unoccupied", kFreeCell),
          cell("unknown", kUnknownCell),
          circle_item("vehicle and safety distance",
                      [](Canvas& canvas, const std::vector<Point>& circle) {
                        canvas.polygon(circle, kVehicleColor, 0.55);
                        canvas.line(circle, kInk, 2);
                      }),
          line_item("camera's view", kViewColor, 1, Stroke::solid),
          line_item("end of the blind zone", kViewColor, 1, Stroke::dashed),
          line_item("active radius", kActiveColor, 1, Stroke::solid),
          line_item("opening", kOpeningColor, 6, Stroke::solid),
          line_item("target", kTargetColor, 2, Stroke::dashed),
          chosen_item()};
}

void draw_disparity_bar(Canvas& sheet, const Box& box, const PictureInput& input) {
  const DisparityScale scale = disparity_scale(input.frame.disparity);
  const Box bar{box.x + 16, box.y + 34, box.width - 140, 20};
  for (int x = 0; x < bar.width; ++x)
    sheet.fill({bar.x + x, bar.y, 1, bar.height}, disparity_color(x + 0.5, bar.width));
  sheet.frame(bar, kFaintInk);
  draw_pixel_ticks(sheet, bar, scale);
  draw_metre_ticks(sheet, bar, scale, input.camera.focal_px * input.camera.baseline_m);
  sheet.text({bar.right() + 26.0, bar.y - 9.0}, "depth, m", kSmallText, kFaintInk);
  sheet.text({bar.right() + 26.0, bar.bottom() + 9 + kSmallText}, "disparity, px", kSmallText, kFaintInk);
  draw_legend(sheet, {static_cast<double>(bar.x), bar.bottom() + 34.0}, bar.width,
              {filled_item("no disparity", kNoDisparityColor)});
}

void draw_class_counts(Canvas& sheet, const Box& box, const PictureInput& input) {
  const PixelCounts& counts = input.frame.pixels;
  const std::array<CountRow, 12> rows = {
      class_row("obstacle", PixelClass::obstacle, counts),
      class_row("floor", PixelClass::floor, counts),
      class_row("ceiling", PixelClass::ceiling, counts),
      class_row("drop-off", PixelClass::drop_off, counts),
      class_row("too far", PixelClass::too_far, counts),
      {"nothing concluded", class_color(PixelClass::no_disparity, 0, kLegendGray), without_reason(counts)},
      reason_row("not searched", kNotSearched, counts),
      reason_row("low texture", kLowTexture, counts),
      reason_row("not unique", kNotUnique, counts),
      reason_row("left-right check", kLeftRightFailed, counts),
      reason_row("speckle", kNoSupport, counts),
      reason_row("pruned early", kPrunedEarly, counts),
  };
  constexpr int kRow = 22;
  constexpr int kColumnGap = 24;
  const int half = static_cast<int>(rows.size()) / 2;
  const double all = std::max(1.0, static_cast<double>(input.frame.left.width) * input.frame.left.height);
  const int width = (box.width - kColumnGap) / 2;
  for (int i = 0; i < 2 * half; ++i) {
    const Box line{box.x + i / half * (width + kColumnGap), box.y + i % half * kRow, width, kRow};
    draw_count(sheet, line, rows[static_cast<std::size_t>(i)], all);
  }
}

}  // namespace lakshya
