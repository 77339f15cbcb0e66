#include "app/tools/picture_canvas.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <numbers>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <utility>

#include "app/nav/sectors.h"
#include "app/tools/picture_colors.h"

namespace lakshya {
namespace {

constexpr int kFont = cv::FONT_HERSHEY_SIMPLEX;
constexpr double kFontCapHeight = 21.0;  // of the Hershey simplex glyphs at scale 1
constexpr int kFractionBits = 4;         // of coordinates handed to OpenCV
constexpr double kFarAway = 1e5;         // px; keeps fixed-point coordinates in range
constexpr double kDash = 9.0;            // px
constexpr double kGap = 7.0;

cv::Scalar scalar(Rgb8 c) {
  return {static_cast<double>(c.r), static_cast<double>(c.g), static_cast<double>(c.b)};
}

// OpenCV's integer coordinates are pixel centres.
cv::Point fixed(Point p) {
  constexpr double kScale = 1 << kFractionBits;
  return {static_cast<int>(std::lround((std::clamp(p.x, -kFarAway, kFarAway) - 0.5) * kScale)),
          static_cast<int>(std::lround((std::clamp(p.y, -kFarAway, kFarAway) - 0.5) * kScale))};
}

std::vector<cv::Point> fixed(const std::vector<Point>& points) {
  std::vector<cv::Point> out;
  out.reserve(points.size());
  for (const Point& p : points)
    out.push_back(fixed(p));
  return out;
}

cv::Rect inside(const Box& box, const cv::Mat& pixels) {
  return cv::Rect(box.x, box.y, std::max(box.width, 0), std::max(box.height, 0)) &
         cv::Rect(0, 0, pixels.cols, pixels.rows);
}

Point between(Point a, Point b, double share) {
  return {a.x + share * (b.x - a.x), a.y + share * (b.y - a.y)};
}

double distance(Point a, Point b) {
  return std::hypot(b.x - a.x, b.y - a.y);
}

// The dashes along a polyline.
std::vector<std::vector<Point>> dashes(const std::vector<Point>& points) {
  std::vector<std::vector<Point>> out;
  double along = 0;  // since the last dash began
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    const double length = distance(points[i], points[i + 1]);
    for (double done = 0; done < length;) {
      const bool ink = along < kDash;
      const double step = std::min((ink ? kDash : kDash + kGap) - along, length - done);
      if (ink) {
        if (along == 0 || out.empty()) out.push_back({between(points[i], points[i + 1], done / length)});
        out.back().push_back(between(points[i], points[i + 1], (done + step) / length));
      }
      done += step;
      along += step;
      if (along >= kDash + kGap - 1e-9) along = 0;
    }
  }
  return out;
}

}  // namespace

bool overlap(const Box& a, const Box& b) {
  return a.x < b.right() && b.x < a.right() && a.y < b.bottom() && b.y < a.bottom();
}

int text_width(const std::string& text, double cap_height) {
  int baseline = 0;
  return cv::getTextSize(text, kFont, cap_height / kFontCapHeight, 1, &baseline).width;
}

std::string text_that_fits(const std::string& text, double cap_height, int width) {
  // Only so much of a long text can ever fit: a glyph is wider than a pixel.
  std::string fitting = text.substr(0, static_cast<std::size_t>(std::max(width, 0)));
  if (fitting.size() == text.size() && text_width(text, cap_height) <= width) return text;
  while (!fitting.empty() && text_width(fitting + "...", cap_height) > width)
    fitting.pop_back();
  return fitting.empty() ? fitting : fitting + "...";
}

std::string decimal(double value, int places) {
  const double unit = std::pow(10.0, -places);
  std::array<char, 64> text{};
  // Adding zero turns the -0 that rounding leaves into 0.
  (void)std::snprintf(text.data(), text.size(), "%.*f", places, std::round(value / unit) * unit + 0.0);
  return text.data();
}

std::string degrees_text(double radians) {
  const std::string text = decimal(degrees(radians), 1);
  return (text[0] == '-' || text == "0.0" ? "" : "+") + text + " deg";
}

double round_step(double least) {
  const double decade = std::pow(10.0, std::floor(std::log10(least)));
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (factor * decade >= least * (1 - 1e-9)) return factor * decade;
  }
  return 10 * decade;
}

std::vector<Point> arc_points(Point center, double radius, double from, double to) {
  constexpr double kSag = 0.1;  // px between arc and chord
  const double chords = std::abs(to - from) / std::sqrt(8 * kSag / std::max(radius, 1.0));
  const int steps = static_cast<int>(std::clamp(std::ceil(chords), 12.0, 4000.0));
  std::vector<Point> points;
  for (int i = 0; i <= steps; ++i) {
    const double angle = from + (to - from) * i / steps;
    points.push_back({center.x - radius * std::sin(angle), center.y - radius * std::cos(angle)});
  }
  return points;
}

Canvas::Canvas(int width, int height, Rgb8 background) : pixels_(height, width, CV_8UC3, scalar(background)) {}

Image<Rgb8> Canvas::image() const {
  static_assert(sizeof(Rgb8) == 3);
  Image<Rgb8> out(width(), height());
  const auto view = out.view();
  for (int y = 0; y < height(); ++y) {
    std::memcpy(view.row(y), pixels_.ptr(y), static_cast<std::size_t>(width()) * sizeof(Rgb8));
  }
  return out;
}

Canvas Canvas::part(const Box& box) const {
  return Canvas(pixels_(inside(box, pixels_)));
}

void Canvas::set(int x, int y, Rgb8 color) {
  pixels_.at<cv::Vec3b>(y, x) = {color.r, color.g, color.b};
}

void Canvas::fill(const Box& box, Rgb8 color, double opacity) {
  cv::Mat area = pixels_(inside(box, pixels_));
  if (area.empty()) return;
  const cv::Mat plain(area.size(), CV_8UC3, scalar(color));
  cv::addWeighted(plain, opacity, area, 1 - opacity, 0, area);
}

void Canvas::frame(const Box& box, Rgb8 color) {
  cv::rectangle(pixels_, {box.x, box.y}, {box.right() - 1, box.bottom() - 1}, scalar(color), 1);
}

void Canvas::solid_line(const std::vector<Point>& points, Rgb8 color, double thickness) {
  const std::vector<std::vector<cv::Point>> lines{fixed(points)};
  cv::polylines(pixels_, lines, false, scalar(color), std::max(1, static_cast<int>(std::lround(thickness))),
                cv::LINE_AA, kFractionBits);
}

void Canvas::line(const std::vector<Point>& points, Rgb8 color, double thickness, Stroke stroke) {
  if (stroke == Stroke::solid) {
    solid_line(points, color, thickness);
    return;
  }
  for (const auto& dash : dashes(points))
    solid_line(dash, color, thickness);
}

void Canvas::polygon(const std::vector<Point>& points, Rgb8 color, double opacity) {
  cv::Mat filled = opacity < 1 ? pixels_.clone() : pixels_;
  const std::vector<std::vector<cv::Point>> areas{fixed(points)};
  cv::fillPoly(filled, areas, scalar(color), cv::LINE_AA, kFractionBits);
  if (opacity < 1) cv::addWeighted(filled, opacity, pixels_, 1 - opacity, 0, pixels_);
}

void Canvas::arrow(const std::vector<Point>& shaft, Rgb8 color, double thickness) {
  if (shaft.size() < 2) return;
  const Point tip = shaft.back();
  const Point before = shaft[shaft.size() - 2];
  const double length = std::max(distance(before, tip), 1e-9);
  const Point along{(tip.x - before.x) / length, (tip.y - before.y) / length};
  const auto head = [&](double size) {
    const double half = 0.55 * size;
    const Point base{tip.x - size * along.x, tip.y - size * along.y};
    return std::vector<Point>{tip,
                              {base.x - half * along.y, base.y + half * along.x},
                              {base.x + half * along.y, base.y - half * along.x}};
  };
  const double size = 4.5 * thickness;
  std::vector<Point> stem = shaft;
  stem.back() = {tip.x - 0.8 * size * along.x, tip.y - 0.8 * size * along.y};
  std::vector<Point> rim = head(size);
  rim.push_back(tip);
  solid_line(stem, kPaper, thickness + 3);
  solid_line(rim, kPaper, 4);
  solid_line(stem, color, thickness);
  polygon(head(size), color);
}

void Canvas::hatch(const Box& box, Rgb8 color, int spacing) {
  Canvas area = part(box);
  for (int x = -area.height(); x < area.width(); x += spacing) {
    area.solid_line({{static_cast<double>(x), static_cast<double>(area.height())},
                     {static_cast<double>(x + area.height()), 0.0}},
                    color, 1);
  }
}

void Canvas::text(Point at, const std::string& text, double cap_height, Rgb8 color, Align align, int thickness) {
  const int width = align == Align::left ? 0 : text_width(text, cap_height);
  const double x = at.x - (align == Align::center ? width / 2 : width);
  cv::putText(pixels_, text, {static_cast<int>(std::lround(x)), static_cast<int>(std::lround(at.y))}, kFont,
              cap_height / kFontCapHeight, scalar(color), thickness, cv::LINE_AA);
}

void Canvas::paste(ImageView<const Rgb8> image, const Box& box, Enlarge how) {
  if (image.width <= 0 || image.height <= 0) return;
  // cv::Mat has no read-only form; nothing is written to it.
  const cv::Mat source(image.height, image.width, CV_8UC3, const_cast<Rgb8*>(image.data),
                       static_cast<std::size_t>(image.stride) * sizeof(Rgb8));
  cv::Mat area = pixels_(inside(box, pixels_));
  if (area.empty()) return;
  const bool enlarge = area.cols > image.width;
  const int enlarged = how == Enlarge::sharp ? cv::INTER_NEAREST : cv::INTER_LINEAR;
  cv::resize(source, area, area.size(), 0, 0, enlarge ? enlarged : cv::INTER_AREA);
}

}  // namespace lakshya
