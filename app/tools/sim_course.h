// Private to sim_*.cc: the parts of a course's picture.
#pragma once

#include <array>
#include <set>
#include <string>
#include <vector>

#include "app/tools/picture_panels.h"
#include "app/tools/sim/run_result.h"
#include "app/tools/sim/world.h"

namespace lakshya {

// What things are told apart by in the picture; drawn in this order.
enum class Look : std::uint8_t {
  lying,  // may be driven over
  rock,
  furniture,
  plant,
  pole,
  wall,
  other,
  glass,
  person,
  hanging_low,
  hanging_high,  // may be driven under
};
inline constexpr std::size_t kLooks = 11;

Look look_of(const sim::Thing& thing, const sim::Ground& ground);
// A ceiling, which would hide everything: not drawn. Nor is what has no shape.
bool is_left_out(const sim::Thing& thing, const sim::Ground& ground);
LegendItem legend_of(Look look);

// A rectangle of the world frame, metres.
struct Extent {
  double x0 = 0, y0 = 0, x1 = 0, y1 = 0;
  double width() const { return x1 - x0; }
  double height() const { return y1 - y0; }
  void take(double x, double y);
  void grow(double by);
};

// From metres in the world frame to px of the map.
struct CourseView {
  Extent extent;
  bool turned = false;  // north is to the right instead of up
  double scale = 1;     // px per metre
  Point at(double x, double y) const {
    return turned ? Point{(y - extent.y0) * scale, (x - extent.x0) * scale}
                  : Point{(x - extent.x0) * scale, (extent.y1 - y) * scale};
  }
  Box box(double x0, double y0, double x1, double y1) const;
  int width() const;
  int height() const;
};

CourseView course_view(const sim::World& world, const sim::RunResult& result, int width, int most_height);

// Texts that give way to each other and to what must stay in sight.
class Labels {
 public:
  explicit Labels(const Box& area) : area_(area) {}
  void keep_free(const Box& box) { taken_.push_back(box); }
  // Free where there is room elsewhere.
  void rather_free(const Box& box) { avoided_.push_back(box); }
  // Beside the box, so many px away, wherever there is room; within it where it is large and `inside`. false: nowhere, nothing
  // is drawn.
  bool put(Canvas& canvas, const Box& about, double away, const std::string& text, double cap_height, Rgb8 color,
           bool inside = false);
  bool put(Canvas& canvas, Point about, double away, const std::string& text, double cap_height, Rgb8 color) {
    return put(canvas, Box{static_cast<int>(about.x), static_cast<int>(about.y), 0, 0}, away, text, cap_height,
               color);
  }

 private:
  bool is_free(const Box& box, bool strictly) const;

  Box area_;
  std::vector<Box> taken_;
  std::vector<Box> avoided_;
};

// Floor and patches; gives the legend of those that are in the picture.
std::vector<LegendItem> draw_ground(Canvas& map, const CourseView& view, const sim::World& world);

// Ground and things; who walks is where he was at the end. Gives what was drawn, for the legend.
struct DrawnWorld {
  std::set<Look> looks;
  std::vector<LegendItem> ground;
  bool walks = false;
};
DrawnWorld draw_world(Canvas& map, const CourseView& view, const sim::World& world, const sim::WalkTimes& walks);

// What a thing covers, px; empty where it has no shape. walked_s: his own time, of somebody who walks.
Box box_of(const sim::Thing& thing, double walked_s, const CourseView& view);

struct CourseLegend {
  std::vector<LegendItem> items;
  double fastest_mps = 1;  // end of the colour scale
};
// The way, the vehicle on it, start, goals and what happened.
CourseLegend draw_drive(Canvas& map, const CourseView& view, const sim::World& world, const sim::RunResult& result,
                        double vehicle_radius_m, Labels& labels);
Rgb8 speed_color(double share);

}  // namespace lakshya
