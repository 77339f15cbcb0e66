// The picture of `lakshya soak`.
#include <algorithm>
#include <string>
#include <vector>

#include "app/tools/picture_colors.h"
#include "app/tools/picture_panels.h"
#include "app/tools/picture_plot.h"
#include "app/tools/soak_report.h"

namespace lakshya {
namespace {

constexpr int kWidth = 1200;
constexpr int kLeft = 80;
constexpr int kTop = 120;
constexpr int kHeight = 170;
constexpr int kPitch = 260;  // from one plot to the next

// The samples' values by a member function of ours.
template <class Value>
std::vector<double> values(const SoakResult& result, Value value) {
  std::vector<double> list;
  for (const SoakSample& sample : result.samples)
    list.push_back(value(sample));
  return list;
}

double most(const std::vector<double>& list) {
  return list.empty() ? 0 : *std::ranges::max_element(list);
}

Plot plot_number(int n, const SoakResult& result, double high) {
  const double frames = result.samples.empty() ? 1 : static_cast<double>(result.samples.back().frames) / 1000;
  return {{kLeft, kTop + n * kPitch, kWidth - kLeft - 40, kHeight},
          {.low = 0, .high = frames},
          {.low = 0, .high = std::max(1.15 * high, 1e-6), .most_ticks = 5}};
}

void draw_axes(Canvas& sheet, const Plot& plot, const std::string& title) {
  draw_y_axis(sheet, plot, title);
  draw_x_axis(sheet, plot, "");
  sheet.frame(plot.box, kFaintInk);
}

// The fifths that are compared.
void shade_fifths(Canvas& sheet, const Plot& plot) {
  const int fifth = plot.box.width / 5;
  for (const int n : {1, 4})
    sheet.fill({plot.box.x + n * fifth, plot.box.y, fifth, plot.box.height}, series_color(1), 0.12);
}

void draw_series(Canvas& sheet, const Plot& plot, const SoakResult& result, const std::vector<double>& list,
                 std::size_t color) {
  std::vector<Point> points;
  for (std::size_t i = 0; i < list.size(); ++i)
    points.push_back(plot.at(static_cast<double>(result.samples[i].frames) / 1000, list[i]));
  if (points.size() > 1) sheet.line(points, series_color(color), 2);
}

}  // namespace

Image<Rgb8> soak_picture(const SoakResult& result) {
  Canvas sheet(kWidth, kTop + 3 * kPitch, kPaper);
  const SoakGrowth growth = soak_growth(result);
  const bool passed = soak_verdict(result).failures.empty();
  sheet.text({kLeft, 40}, std::string("Endurance: ") + (passed ? "passed" : "FAILED"), kTitleText,
             passed ? kInk : kBlockedColor);
  sheet.text({kLeft, 68},
             std::to_string(result.frames) + " frames of " + std::to_string(result.width) + "x" +
                 std::to_string(result.height) + ", " + std::to_string(result.faults) + " faults, seed " +
                 std::to_string(result.settings.seed) + "; shaded: the fifths of the run that are compared",
             kBodyText, kFaintInk);

  const auto resident =
      values(result, [](const SoakSample& s) { return static_cast<double>(s.resident_bytes) / 1e6; });
  const Plot memory = plot_number(0, result, most(resident));
  shade_fifths(sheet, memory);
  draw_axes(sheet, memory,
            "resident memory, MB; means of the shaded fifths: " + decimal(growth.resident_before / 1e6, 2) +
                " and " + decimal(growth.resident_after / 1e6, 2));
  draw_series(sheet, memory, result, resident, 0);

  const auto handles = values(result, [](const SoakSample& s) { return static_cast<double>(s.handles); });
  const auto faults = values(result, [](const SoakSample& s) { return static_cast<double>(s.faults); });
  const Plot counts = plot_number(1, result, std::max(most(handles), most(faults)));
  shade_fifths(sheet, counts);
  draw_axes(sheet, counts, "open handles, and faults begun since the sample before");
  draw_series(sheet, counts, result, faults, 4);
  draw_series(sheet, counts, result, handles, 0);
  draw_legend(sheet, {kWidth - 340.0, counts.box.y - 30.0}, 300,
              {line_item("handles", series_color(0), 2, Stroke::solid),
               line_item("faults", series_color(4), 2, Stroke::solid)});

  const auto p50 = values(result, [](const SoakSample& s) { return static_cast<double>(s.p50) / 1e6; });
  const auto p99 = values(result, [](const SoakSample& s) { return static_cast<double>(s.p99) / 1e6; });
  const Plot times = plot_number(2, result, most(p99));
  shade_fifths(sheet, times);
  draw_axes(sheet, times,
            "time of a frame in perception, ms; medians of the shaded fifths: " + decimal(growth.p50_before_ms, 1) +
                " and " + decimal(growth.p50_after_ms, 1));
  draw_series(sheet, times, result, p99, 4);
  draw_series(sheet, times, result, p50, 0);
  draw_legend(sheet, {kWidth - 340.0, times.box.y - 30.0}, 300,
              {line_item("median", series_color(0), 2, Stroke::solid),
               line_item("99 %", series_color(4), 2, Stroke::solid)});
  sheet.text({times.box.x + times.box.width / 2.0, times.box.bottom() + 42.0}, "thousand frames", kBodyText, kInk,
             Align::center);
  return sheet.image();
}

}  // namespace lakshya
