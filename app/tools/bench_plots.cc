// Plots of `./dev bench`.
#include <algorithm>
#include <array>
#include <cmath>

#include "app/tools/bench_report.h"
#include "app/tools/bench_suite.h"
#include "app/tools/picture_colors.h"
#include "app/tools/picture_panels.h"
#include "app/tools/picture_plot.h"

namespace lakshya {
namespace {

std::string setting_text(const BenchResult& r) {
  return std::to_string(r.width) + "x" + std::to_string(r.height) + "x" + std::to_string(r.disparities) + ", " +
         std::to_string(r.threads) + (r.threads == 1 ? " thread, " : " threads, ") + r.isa;
}

// Colour by instruction set, shade by number of threads.
Rgb8 setting_color(const SuiteResults& results, const BenchResult& r) {
  std::size_t isa = 0;
  while (isa < results.peaks.size() && results.peaks[isa].isa != r.isa)
    ++isa;
  return r.threads == 1 ? mix(series_color(isa), kPaper, 0.45) : series_color(isa);
}

}  // namespace

Image<Rgb8> speedup_plot(const SuiteResults& results) {
  Canvas sheet(1500, 720, kPaper);
  sheet.text({60, 40}, "How many times as long OpenCV takes", kTitleText, kInk);
  double low = 0.5;
  double high = 2;
  for (const BenchResult& r : results.settings) {
    for (const BenchRow& row : r.rows) {
      while (row.speedup().value_or(1) < low)
        low /= 2;
      while (row.speedup().value_or(1) > high)
        high *= 2;
    }
  }
  const Plot plot{{60, 110, 1410, 470}, {0, 1}, {low, high, 2}};
  draw_y_axis(sheet, plot, "speed-up, each doubling one step; thick line: equally fast");
  const auto& rows = results.settings.front().rows;
  const auto with_peer =
      std::count_if(rows.begin(), rows.end(), [](const BenchRow& r) { return r.peer_ms.has_value(); });
  const double group = plot.box.width / static_cast<double>(std::max<std::ptrdiff_t>(with_peer, 1));
  const double bar = 0.86 * group / static_cast<double>(results.settings.size());
  const double one = plot.at(0, 1).y;
  double left = plot.box.x;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (!rows[i].peer_ms) continue;
    double x = left + 0.07 * group;
    for (const BenchResult& r : results.settings) {
      const double y = plot.at(0, r.rows[i].speedup().value_or(1)).y;
      const int top = static_cast<int>(std::lround(std::min(y, one)));
      const int height = std::max(1, static_cast<int>(std::lround(std::abs(y - one))));
      sheet.fill({static_cast<int>(x), top, std::max(1, static_cast<int>(bar) - 1), height},
                 setting_color(results, r));
      x += bar;
    }
    sheet.text({left + group / 2, plot.box.bottom() + 22.0}, rows[i].name, kHeadText, kInk, Align::center);
    sheet.text({left + group / 2, plot.box.bottom() + 42.0},
               text_that_fits(rows[i].peer, kSmallText, static_cast<int>(group) - 8), kSmallText, kFaintInk,
               Align::center);
    left += group;
  }
  sheet.fill({plot.box.x, static_cast<int>(one) - 1, plot.box.width, 3}, kInk);
  std::vector<LegendItem> legend;
  std::vector<std::string> seen;
  for (const BenchResult& r : results.settings) {
    const std::string name = r.isa + ", " + std::to_string(r.threads) + (r.threads == 1 ? " thread" : " threads");
    if (std::find(seen.begin(), seen.end(), name) != seen.end()) continue;
    seen.push_back(name);
    legend.push_back(filled_item(name, setting_color(results, r)));
  }
  draw_legend(sheet, {60, 50}, plot.box.width, legend);
  sheet.text(
      {60, plot.box.bottom() + 78.0},
      "bars from left: " + setting_text(results.settings.front()) + " to " + setting_text(results.settings.back()),
      kBodyText, kFaintInk);
  return sheet.image();
}

Image<Rgb8> scaling_plot(const SuiteResults& results) {
  Canvas sheet(1280, 760, kPaper);
  sheet.text({70, 40}, "Time against work, one thread, " + results.scaling.front().isa, kTitleText, kInk);
  constexpr std::array<const char*, 4> kRows{"sad", "census", "sgm", "frame"};
  double most_x = 0;
  double most_y = 0;
  for (const char* row : kRows) {
    for (const Point& p : scaling_points(results.scaling, row)) {
      most_x = std::max(most_x, p.x);
      most_y = std::max(most_y, p.y);
    }
  }
  const Plot plot{{70, 90, 800, 580}, {0, 1.05 * most_x}, {0, 1.08 * most_y}};
  draw_y_axis(sheet, plot, "ms");
  draw_x_axis(sheet, plot, "pixels x disparities, millions");
  sheet.frame(plot.box, kFaintInk);
  for (std::size_t i = 0; i < kRows.size(); ++i) {
    const std::vector<Point> points = scaling_points(results.scaling, kRows[i]);
    const LineFit fit = fit_line(points);
    sheet.line({plot.at(0, std::max(fit.intercept, 0.0)), plot.at(most_x, fit.intercept + fit.slope * most_x)},
               series_color(i), 2);
    for (const Point& p : points)
      disc(sheet, plot.at(p.x, p.y), 6, series_color(i));
    const double y = 120 + 52.0 * static_cast<double>(i);
    disc(sheet, {900, y - 4}, 8, series_color(i));
    sheet.text({916, y}, kRows[i], kHeadText, kInk);
    sheet.text({916, y + 19}, decimal(fit.slope, 3) + " ns per pixel-disparity, R2 " + decimal(fit.r2, 4),
               kSmallText, kFaintInk);
  }
  return sheet.image();
}

Image<Rgb8> roofline_plot(const SuiteResults& results) {
  Canvas sheet(1300, 820, kPaper);
  sheet.text({80, 40}, "Kernels beside the limits of one core", kTitleText, kInk);
  double high = 10;
  double low = 1;
  for (const MachinePeak& p : results.peaks)
    high = std::max(high, 2e-9 * p.operations_per_s);
  for (const KernelTime& k : results.kernels)
    low = std::min(low, 0.5e-9 * k.operations_per_s());
  const Plot plot{{80, 90, 900, 640},
                  {0.5, 512, 2},
                  {std::pow(10, std::floor(std::log10(low))), std::pow(10, std::ceil(std::log10(high))), 10}};
  draw_y_axis(sheet, plot, "10^9 operations on one byte per second");
  draw_x_axis(sheet, plot, "operations per byte from beyond the first-level cache");
  sheet.frame(plot.box, kFaintInk);
  for (std::size_t i = 0; i < results.peaks.size(); ++i) {
    const MachinePeak& p = results.peaks[i];
    const auto roof = [&](double bytes_per_s, double x) {
      return 1e-9 * std::min(p.operations_per_s, bytes_per_s * x);
    };
    const double ridge = std::clamp(p.operations_per_s / p.l2_bytes_per_s, plot.x.low, plot.x.high);
    sheet.line(
        {plot.at(plot.x.low, roof(p.l2_bytes_per_s, plot.x.low)), plot.at(ridge, roof(p.l2_bytes_per_s, ridge)),
         plot.at(plot.x.high, roof(p.l2_bytes_per_s, plot.x.high))},
        series_color(i), 2);
    const double far_ridge = std::clamp(p.operations_per_s / p.memory_bytes_per_s, plot.x.low, plot.x.high);
    sheet.line({plot.at(plot.x.low, roof(p.memory_bytes_per_s, plot.x.low)),
                plot.at(far_ridge, roof(p.memory_bytes_per_s, far_ridge))},
               series_color(i), 1.5, Stroke::dashed);
    const double y = 120 + 70.0 * static_cast<double>(i);
    sheet.fill({1000, static_cast<int>(y) - 12, 14, 14}, series_color(i));
    sheet.text({1022, y}, p.isa, kHeadText, kInk);
    sheet.text({1022, y + 19}, "peak " + decimal(1e-9 * p.operations_per_s, 0) + " 10^9/s", kSmallText, kFaintInk);
    sheet.text({1022, y + 36},
               "L2 " + decimal(1e-9 * p.l2_bytes_per_s, 0) + ", memory " + decimal(1e-9 * p.memory_bytes_per_s, 0) +
                   " GB/s",
               kSmallText, kFaintInk);
    for (const KernelTime& k : results.kernels) {
      if (k.isa != p.isa) continue;
      const Point at = plot.at(k.work.operations / k.work.bytes, 1e-9 * k.operations_per_s());
      disc(sheet, at, 6, series_color(i));
      if (i == 0) sheet.text({at.x + 9, at.y + 4}, k.work.name, kSmallText, kInk);
    }
  }
  const double y = 120 + 70.0 * static_cast<double>(results.peaks.size());
  sheet.text({1000, y}, "solid: second-level cache", kSmallText, kFaintInk);
  sheet.text({1000, y + 18}, "dashed: memory", kSmallText, kFaintInk);
  return sheet.image();
}

}  // namespace lakshya
