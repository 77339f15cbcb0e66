// Private to picture_*.cc: drawing on an RGB sheet. Coordinates in px, x right, y down, pixel (x, y) covers
// [x, x+1) x [y, y+1); everything is clipped to the canvas. The only pictures header with OpenCV in it.
#pragma once

#include <opencv2/core/mat.hpp>
#include <string>
#include <vector>

#include "app/core/image.h"

namespace lakshya {

struct Point {
  double x = 0;
  double y = 0;
};

struct Box {
  int x = 0;
  int y = 0;
  int width = 0;
  int height = 0;
  int right() const { return x + width; }
  int bottom() const { return y + height; }
};

bool overlap(const Box& a, const Box& b);

enum class Align { left, center, right };
enum class Stroke { solid, dashed };
enum class Enlarge { sharp, smooth };

// Cap heights in px.
inline constexpr double kSmallText = 9.5;
inline constexpr double kBodyText = 11.0;
inline constexpr double kHeadText = 13.0;
inline constexpr double kTitleText = 19.0;

int text_width(const std::string& text, double cap_height);

// The start of the text that fits, with "..." where something is left out.
std::string text_that_fits(const std::string& text, double cap_height, int width);

// "12.5"; never "-0.0".
std::string decimal(double value, int places);
// A direction in degrees: "+12.5 deg".
std::string degrees_text(double radians);

// 1, 2 or 5 times a power of ten, at least `least` (> 0): for axis ticks and scale bars.
double round_step(double least);

// An arc of a circle, angles counter-clockwise from straight up.
std::vector<Point> arc_points(Point center, double radius, double from, double to);

class Canvas {
 public:
  Canvas(int width, int height, Rgb8 background);

  int width() const { return pixels_.cols; }
  int height() const { return pixels_.rows; }
  Image<Rgb8> image() const;

  // The part of this canvas inside the box (clipped to it), sharing its pixels, with its own origin.
  Canvas part(const Box& box) const;

  void set(int x, int y, Rgb8 color);
  void fill(const Box& box, Rgb8 color, double opacity = 1);
  void frame(const Box& box, Rgb8 color);
  void line(const std::vector<Point>& points, Rgb8 color, double thickness, Stroke stroke = Stroke::solid);
  void polygon(const std::vector<Point>& points, Rgb8 color, double opacity = 1);
  // With a white rim, so that it shows on any ground.
  void arrow(const std::vector<Point>& shaft, Rgb8 color, double thickness);
  void hatch(const Box& box, Rgb8 color, int spacing);

  // `at`: the baseline's left end, middle or right end.
  void text(Point at, const std::string& text, double cap_height, Rgb8 color, Align align = Align::left,
            int thickness = 1);
  // The image scaled to fill the box: when enlarged as said, averaged when reduced.
  void paste(ImageView<const Rgb8> image, const Box& box, Enlarge how = Enlarge::sharp);

 private:
  explicit Canvas(cv::Mat pixels) : pixels_(std::move(pixels)) {}
  void solid_line(const std::vector<Point>& points, Rgb8 color, double thickness);

  cv::Mat pixels_;  // RGB
};

}  // namespace lakshya
