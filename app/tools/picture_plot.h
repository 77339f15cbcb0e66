// Private to pictures: a plot's axes.
#pragma once

#include <string>
#include <vector>

#include "app/tools/picture_canvas.h"

namespace lakshya {

// Colour of the i-th series: those of Okabe and Ito (picture_colors.h), from the beginning again after the sixth.
Rgb8 series_color(std::size_t i);

// A value's place along one side of the plot, linear or logarithmic.
struct Axis {
  double low = 0;
  double high = 1;
  double factor = 0;    // from tick to tick of a logarithmic axis; 0: linear
  int most_ticks = 10;  // of a linear one
  double share(double value) const;
};

struct Plot {
  Box box;
  Axis x;
  Axis y;
  Point at(double vx, double vy) const;
};

// Rules across the plot with their values beside, and what they are.
void draw_y_axis(Canvas& sheet, const Plot& plot, const std::string& title);
void draw_x_axis(Canvas& sheet, const Plot& plot, const std::string& title);
void disc(Canvas& sheet, Point center, double radius, Rgb8 color);

}  // namespace lakshya
