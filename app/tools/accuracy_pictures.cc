// Plot and error pictures of `lakshya accuracy`.
#include <algorithm>
#include <array>
#include <cmath>

#include "app/tools/accuracy_report.h"
#include "app/tools/picture_canvas.h"
#include "app/tools/picture_colors.h"
#include "app/tools/picture_panels.h"
#include "kernels/base/units.h"

namespace lakshya {
namespace {

// Okabe and Ito (picture_colors.h).
constexpr std::array<Rgb8, 6> kMatcherColors{
    {{0, 114, 178}, {0, 158, 115}, {230, 159, 0}, {204, 121, 167}, {213, 94, 0}, {110, 114, 120}}};

Rgb8 matcher_color(std::size_t i) {
  return kMatcherColors[i % kMatcherColors.size()];
}

struct PlotAxes {
  Box plot;
  double least_density = 0;
  double most_bad2 = 1;
  Point at(double density, double bad2) const {
    return {plot.x + bad2 / most_bad2 * plot.width,
            plot.bottom() - (density - least_density) / (1 - least_density) * plot.height};
  }
};

PlotAxes axes_for(const std::vector<PairResults>& results, const Box& plot) {
  PlotAxes axes{plot};
  double least = 1;
  double most = 0.01;
  for (const PairResults& pair : results) {
    for (const Evaluation& e : pair.evaluations) {
      if (!std::isfinite(e.errors.bad2)) continue;
      least = std::min(least, e.errors.density);
      most = std::max(most, e.errors.bad2);
    }
  }
  axes.least_density = std::max(0.0, std::floor(least * 10) / 10);
  axes.most_bad2 = most * 1.05;
  return axes;
}

void draw_axes(Canvas& sheet, const PlotAxes& axes) {
  const Box& plot = axes.plot;
  const double x_step = round_step(100 * axes.most_bad2 / 10);
  const int x_lines = static_cast<int>(100 * axes.most_bad2 / x_step);
  for (int i = 0; i <= x_lines; ++i) {
    const double x = i * x_step;
    const Point p = axes.at(axes.least_density, x / 100);
    sheet.fill({static_cast<int>(p.x), plot.y, 1, plot.height}, kRule);
    sheet.text({p.x, plot.bottom() + 18.0}, decimal(x, x_step < 1 ? 1 : 0), kSmallText, kInk, Align::center);
  }
  const double y_step = round_step(100 * (1 - axes.least_density) / 12);
  const int y_lines = static_cast<int>((100.001 - 100 * axes.least_density) / y_step);
  for (int i = 0; i <= y_lines; ++i) {
    const double y = 100 * axes.least_density + i * y_step;
    const Point p = axes.at(y / 100, 0);
    sheet.fill({plot.x, static_cast<int>(p.y), plot.width, 1}, kRule);
    sheet.text({plot.x - 8.0, p.y + kSmallText / 2}, decimal(y, 0), kSmallText, kInk, Align::right);
  }
  sheet.frame(plot, kFaintInk);
  sheet.text({plot.x + plot.width / 2.0, plot.bottom() + 42.0},
             "wrong by more than 2 px, % of the estimates (bad2)", kBodyText, kInk, Align::center);
  sheet.text({static_cast<double>(plot.x), plot.y - 12.0}, "density: % of the ground-truth pixels with an estimate",
             kBodyText, kInk);
}

void disc(Canvas& sheet, Point center, double radius, Rgb8 color, double opacity) {
  std::vector<Point> points = arc_points(center, radius, -3.15, 3.15);
  sheet.polygon(points, color, opacity);
}

enum class ErrorBand { unknown, missing, within1, within2, within4, beyond };

ErrorBand error_band(std::int16_t estimate, float truth) {
  if (truth < 0) return ErrorBand::unknown;
  if (estimate < 0) return ErrorBand::missing;
  const double error = std::abs(static_cast<double>(estimate) / kDisparityScale - static_cast<double>(truth));
  if (error <= 1) return ErrorBand::within1;
  if (error <= 2) return ErrorBand::within2;
  return error <= 4 ? ErrorBand::within4 : ErrorBand::beyond;
}

struct Band {
  const char* text;
  Rgb8 color;
};
constexpr std::array<Band, 6> kBands{{{"no ground truth", {205, 208, 212}},
                                      {"no estimate", {25, 28, 32}},
                                      {"up to 1 px", {0, 158, 115}},
                                      {"up to 2 px", {240, 228, 66}},
                                      {"up to 4 px", {230, 120, 0}},
                                      {"beyond", {200, 20, 20}}}};

Image<Rgb8> error_image(const Evaluation& e, const Image<float>& truth) {
  Image<Rgb8> image(truth.width(), truth.height());
  for (int v = 0; v < truth.height(); ++v) {
    for (int u = 0; u < truth.width(); ++u) {
      const ErrorBand band = error_band(e.estimate.disparity.view().at(u, v), truth.view().at(u, v));
      image.view().at(u, v) = kBands[static_cast<std::size_t>(band)].color;
    }
  }
  return image;
}

Image<Rgb8> truth_image(const Image<float>& truth) {
  float largest = 1;
  for (int v = 0; v < truth.height(); ++v) {
    for (int u = 0; u < truth.width(); ++u)
      largest = std::max(largest, truth.view().at(u, v));
  }
  Image<Rgb8> image(truth.width(), truth.height());
  for (int v = 0; v < truth.height(); ++v) {
    for (int u = 0; u < truth.width(); ++u) {
      const float d = truth.view().at(u, v);
      image.view().at(u, v) = d < 0 ? kNoDisparityColor : disparity_color(d, largest);
    }
  }
  return image;
}

std::string caption(const Evaluation& e) {
  return e.matcher + ": density " + decimal(100 * e.errors.density, 1) + " %, bad2 " +
         (std::isfinite(e.errors.bad2) ? decimal(100 * e.errors.bad2, 2) : "-") + " %";
}

}  // namespace

Image<Rgb8> accuracy_plot(const std::vector<PairResults>& results) {
  Canvas sheet(1200, 860, kPaper);
  sheet.text({70, 40}, "Accuracy of the matchers over " + std::to_string(results.size()) + " pairs", kTitleText,
             kInk);
  const PlotAxes axes = axes_for(results, {70, 90, 900, 690});
  draw_axes(sheet, axes);
  for (const PairResults& pair : results) {
    for (std::size_t i = 0; i < pair.evaluations.size(); ++i) {
      const DisparityErrors& e = pair.evaluations[i].errors;
      if (std::isfinite(e.bad2)) disc(sheet, axes.at(e.density, e.bad2), 4, matcher_color(i), 0.5);
    }
  }
  const std::vector<MatcherMeans> means = matcher_means(results);
  for (std::size_t i = 0; i < means.size(); ++i) {
    if (!std::isfinite(means[i].bad2)) continue;
    const Point p = axes.at(means[i].density, means[i].bad2);
    disc(sheet, p, 13, kInk, 1);
    disc(sheet, p, 11, matcher_color(i), 1);
  }
  for (std::size_t i = 0; i < means.size(); ++i) {
    const double y = 110 + 44.0 * static_cast<double>(i);
    disc(sheet, {1000, y - 4}, 8, matcher_color(i), 1);
    sheet.text({1016, y}, means[i].matcher, kBodyText, kInk);
    sheet.text({1016, y + 17}, decimal(100 * means[i].density, 1) + " / " + decimal(100 * means[i].bad2, 2),
               kSmallText, kFaintInk);
  }
  sheet.text({988, 110 + 44.0 * static_cast<double>(means.size())}, "large: mean; small: one pair", kSmallText,
             kFaintInk);
  sheet.text({axes.plot.x + 10.0, axes.plot.bottom() - 12.0}, "better: up and left", kSmallText, kFaintInk);
  return sheet.image();
}

Image<Rgb8> error_picture(const std::string& title, const GroundTruthPair& pair,
                          const std::vector<Evaluation>& evaluations) {
  constexpr int kWidth = 620;
  constexpr int kGap = 16;
  constexpr int kTop = 90;
  constexpr int kCaption = 26;
  constexpr int kColumns = 2;
  const int height = std::max(1, kWidth * pair.left.height() / pair.left.width());
  const int panels = 2 + static_cast<int>(evaluations.size());
  const int rows = (panels + kColumns - 1) / kColumns;
  Canvas sheet(kColumns * (kWidth + kGap) + kGap, kTop + rows * (height + kCaption + kGap), kPaper);
  sheet.text({kGap, 36}, title, kTitleText, kInk);
  std::vector<LegendItem> legend;
  legend.reserve(std::size(kBands));
  for (const Band& band : kBands)
    legend.push_back(filled_item(band.text, band.color));
  draw_legend(sheet, {kGap, 50}, kColumns * (kWidth + kGap), legend);
  int panel = 0;
  const auto place = [&](const Image<Rgb8>& image, const std::string& text) {
    const int x = kGap + panel % kColumns * (kWidth + kGap);
    const int y = kTop + panel / kColumns * (height + kCaption + kGap);
    sheet.text({static_cast<double>(x), y + 17.0}, text, kBodyText, kInk);
    sheet.paste(image.view(), {x, y + kCaption, kWidth, height});
    ++panel;
  };
  place(gray_picture(pair.left.view()), "left image");
  place(truth_image(pair.truth), "ground truth (warm is near)");
  for (const Evaluation& e : evaluations)
    place(error_image(e, pair.truth), caption(e));
  return sheet.image();
}

}  // namespace lakshya
