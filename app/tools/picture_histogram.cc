// The polar histogram as bars, on a logarithmic axis: one cell at arm's length counts a thousand times the least.
#include <algorithm>
#include <cmath>

#include "app/nav/sectors.h"
#include "app/tools/picture_colors.h"
#include "app/tools/picture_panels.h"

namespace lakshya {
namespace {

constexpr int kOuterSector = 18;  // 90 degrees
constexpr int kBars = 2 * kOuterSector + 1;
constexpr Rgb8 kSelectable{205, 236, 224};
constexpr Rgb8 kBlocked{248, 208, 202};
constexpr Rgb8 kMasked{250, 228, 180};
constexpr Rgb8 kNotSeenHatch{150, 154, 160};
constexpr Rgb8 kBar{70, 76, 86};
constexpr int kHatchSpacing = 7;

class Axes {
 public:
  Axes(const Box& plot, const PictureInput& input) : plot_(plot) {
    double most = 10.0 * histogram_thresholds(input.config.planner).high;
    for (int k = -kOuterSector; k <= kOuterSector; ++k)
      most = std::max(most, static_cast<double>(input.frame.plan.histogram[sector_index(k)]));
    decades_ = std::log10(1 + most) * 1.03;
  }

  // Left is on the left.
  double x(double sector) const { return plot_.x + (kOuterSector + 0.5 - sector) * plot_.width / kBars; }
  double y(double value) const { return plot_.bottom() - std::log10(1 + value) / decades_ * plot_.height; }
  double decades() const { return decades_; }

  Box column(int sector) const {
    const auto left = static_cast<int>(std::lround(x(sector + 0.5)));
    return {left, plot_.y, static_cast<int>(std::lround(x(sector - 0.5))) - left, plot_.height};
  }

 private:
  Box plot_;
  double decades_ = 1;
};

Rgb8 sector_color(const Plan& plan, std::size_t k) {
  if (plan.binary[k]) return kBlocked;
  if (plan.masked[k]) return kMasked;
  return plan.selectable[k] ? kSelectable : kPaper;
}

void draw_sectors(Canvas& sheet, const Axes& axes, const Plan& plan) {
  for (int sector = -kOuterSector; sector <= kOuterSector; ++sector) {
    const std::size_t k = sector_index(sector);
    const Box column = axes.column(sector);
    sheet.fill(column, sector_color(plan, k));
    if (!plan.seen[k]) sheet.hatch(column, kNotSeenHatch, kHatchSpacing);
    const auto top = static_cast<int>(std::lround(axes.y(plan.histogram[k])));
    sheet.fill({column.x + 2, top, column.width - 3, column.bottom() - top}, kBar);
  }
}

void draw_direction_axis(Canvas& sheet, const Box& plot, const Axes& axes) {
  constexpr int kStepDegrees = 15;
  for (int angle = -90; angle <= 90; angle += kStepDegrees) {
    const double x = axes.x(static_cast<double>(angle) / kPolarSectorDegrees);
    sheet.fill({static_cast<int>(x), plot.bottom(), 1, 5}, kInk);
    const std::string label = (angle > 0 ? "+" : "") + std::to_string(angle);
    sheet.text({x, plot.bottom() + 9 + kSmallText}, label, kSmallText, kInk, Align::center);
  }
  const double y = plot.bottom() + 25 + kSmallText;
  sheet.text({plot.x + plot.width / 2.0, y}, "direction in degrees", kSmallText, kFaintInk, Align::center);
  sheet.text({static_cast<double>(plot.x), y}, "left", kSmallText, kFaintInk);
  sheet.text({static_cast<double>(plot.right()), y}, "right", kSmallText, kFaintInk, Align::right);
}

void draw_value_axis(Canvas& sheet, const Box& plot, const Axes& axes) {
  sheet.text({plot.x - 9.0, plot.bottom() + 0.0}, "0", kSmallText, kInk, Align::right);
  double value = 10;
  for (int decade = 1; decade <= axes.decades(); ++decade, value *= 10) {
    const double y = axes.y(value);
    sheet.fill({plot.x - 5, static_cast<int>(y), 5, 1}, kInk);
    sheet.text({plot.x - 9.0, y + kSmallText / 2}, decimal(value, 0), kSmallText, kInk, Align::right);
  }
}

// One label above its line and one below, so that close thresholds stay legible.
void draw_thresholds(Canvas& sheet, const Box& plot, const Axes& axes, const PlannerParams& planner) {
  const double right = plot.right();
  const auto draw = [&](double value, double text_y, const std::string& name) {
    const double y = axes.y(value);
    sheet.line({{static_cast<double>(plot.x), y}, {right, y}}, kBlockedColor, 1);
    sheet.text({right + 6, y + text_y}, name + " " + decimal(value, 0), kSmallText, kBlockedColor);
  };
  const Thresholds thresholds = histogram_thresholds(planner);
  if (thresholds.low == thresholds.high) {
    draw(thresholds.high, kSmallText / 2.0, "limit");
    return;
  }
  draw(thresholds.high, -2, "high");
  draw(thresholds.low, 3 + kSmallText, "low");
}

struct Mark {
  std::string text;
  double direction = 0;
  Rgb8 color;
  Stroke stroke = Stroke::solid;
};

// A vertical line with its label on one of the two rows above the plot.
void draw_mark(Canvas& sheet, const Box& plot, const Axes& axes, const Mark& mark, int row) {
  const double sector = wrap_angle(mark.direction) / kSectorAngle;
  const double x = std::clamp(axes.x(sector), static_cast<double>(plot.x), static_cast<double>(plot.right()));
  const double baseline = plot.y - 10.0 - 18.0 * row;
  if (std::abs(sector) <= kOuterSector + 0.5) {
    sheet.line({{x, static_cast<double>(plot.y)}, {x, static_cast<double>(plot.bottom())}}, kPaper, 5);
    sheet.line({{x, plot.y - 5.0}, {x, static_cast<double>(plot.bottom())}}, mark.color, 2, mark.stroke);
  }
  const double half = text_width(mark.text, kBodyText) / 2.0 + 3;
  const double middle = std::clamp(x, plot.x + half, plot.right() - half);
  sheet.text({middle, baseline}, mark.text, kBodyText, mark.color, Align::center);
}

std::vector<LegendItem> sector_legend() {
  return {filled_item("selectable", kSelectable),
          filled_item("blocked", kBlocked),
          filled_item("out of reach of the turning circle", kMasked),
          {"not seen", [](Canvas& canvas, const Box& swatch) {
             canvas.fill(swatch, kPaper);
             canvas.hatch(swatch, kNotSeenHatch, kHatchSpacing);
           }}};
}

}  // namespace

void draw_histogram(Canvas& sheet, const Box& plot, const PictureInput& input) {
  const Plan& plan = input.frame.plan;
  const Axes axes(plot, input);
  sheet.text({static_cast<double>(plot.x), plot.y - 54.0}, "Polar histogram (obstacles by direction, log scale)",
             kHeadText, kInk);
  draw_sectors(sheet, axes, plan);
  draw_thresholds(sheet, plot, axes, input.config.planner);
  draw_mark(sheet, plot, axes,
            {"target " + degrees_text(input.target_rad), input.target_rad, kTargetColor, Stroke::dashed}, 1);
  if (!plan.blocked) {
    draw_mark(sheet, plot, axes, {"chosen " + degrees_text(plan.direction), plan.direction, kChosenColor}, 0);
  }
  sheet.frame(plot, kFaintInk);
  draw_direction_axis(sheet, plot, axes);
  draw_value_axis(sheet, plot, axes);
  draw_legend(sheet, {static_cast<double>(plot.x), plot.bottom() + 52.0}, plot.width + kHistogramRight,
              sector_legend());
}

}  // namespace lakshya
