#include "app/tools/picture_plot.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "app/tools/picture_colors.h"

namespace lakshya {
namespace {

constexpr std::array<Rgb8, 6> kSeriesColors{
    {{0, 114, 178}, {230, 159, 0}, {0, 158, 115}, {204, 121, 167}, {213, 94, 0}, {86, 180, 233}}};

std::vector<double> ticks(const Axis& axis) {
  std::vector<double> values;
  const bool logarithmic = axis.factor > 0;
  const double step = logarithmic ? 0 : round_step((axis.high - axis.low) / axis.most_ticks);
  double value = logarithmic ? axis.low : std::ceil(axis.low / step) * step;
  while (value <= axis.high * 1.001) {
    values.push_back(value);
    value = logarithmic ? value * axis.factor : value + step;
  }
  return values;
}

std::string tick_text(double value) {
  return decimal(value, value >= 10 || value == std::round(value) ? 0 : value >= 0.1 ? 2 : 3);
}

}  // namespace

Rgb8 series_color(std::size_t i) {
  return kSeriesColors[i % kSeriesColors.size()];
}

double Axis::share(double value) const {
  if (factor == 0) return (value - low) / (high - low);
  return std::log(std::max(value, low) / low) / std::log(high / low);
}

Point Plot::at(double vx, double vy) const {
  return {box.x + x.share(vx) * box.width, box.bottom() - y.share(vy) * box.height};
}

void draw_y_axis(Canvas& sheet, const Plot& plot, const std::string& title) {
  for (const double value : ticks(plot.y)) {
    const Point p = plot.at(plot.x.low, value);
    sheet.fill({plot.box.x, static_cast<int>(p.y), plot.box.width, 1}, kRule);
    sheet.text({plot.box.x - 8.0, p.y + kSmallText / 2}, tick_text(value), kSmallText, kInk, Align::right);
  }
  sheet.text({static_cast<double>(plot.box.x), plot.box.y - 12.0}, title, kBodyText, kInk);
}

void draw_x_axis(Canvas& sheet, const Plot& plot, const std::string& title) {
  for (const double value : ticks(plot.x)) {
    const Point p = plot.at(value, plot.y.low);
    sheet.fill({static_cast<int>(p.x), plot.box.y, 1, plot.box.height}, kRule);
    sheet.text({p.x, plot.box.bottom() + 18.0}, tick_text(value), kSmallText, kInk, Align::center);
  }
  sheet.text({plot.box.x + plot.box.width / 2.0, plot.box.bottom() + 42.0}, title, kBodyText, kInk, Align::center);
}

void disc(Canvas& sheet, Point center, double radius, Rgb8 color) {
  sheet.polygon(arc_points(center, radius, -3.15, 3.15), color);
}

}  // namespace lakshya
