// The way through the simulated world: path, vehicle, start, goals and what happened.
#include <algorithm>
#include <cmath>
#include <vector>

#include "app/tools/picture_colors.h"
#include "app/tools/picture_plot.h"
#include "app/tools/sim_course.h"

namespace lakshya {
namespace {

using sim::Ending;
using sim::RunResult;
using sim::TracePoint;

constexpr double kStands = 0.02;     // m/s
constexpr double kLeastStand = 0.5;  // s, that are shown
constexpr double kBegins = 1.5;      // s, in which the firmware gets ready
constexpr double kDiscStep = 2;      // s
constexpr double kSamePlace = 0.3;   // m
constexpr double kPathWidth = 5;
constexpr Rgb8 kGoalColor{0, 120, 88};
const Rgb8 kBlockedHalo = mix(kPaper, kBlockedColor, 0.5);

std::vector<Point> circle(Point center, double radius) {
  return arc_points(center, radius, -3.15, 3.15);
}

Point place_of(const CourseView& view, const TracePoint& p) {
  return view.at(p.x, p.y);
}

// Where it stood, or turned on the spot, and for how long in all.
struct Stand {
  std::size_t first = 0;
  double seconds = 0;
};

double distance(const TracePoint& a, const TracePoint& b) {
  return std::hypot(a.x - b.x, a.y - b.y);
}

std::vector<Stand> stands(const std::vector<TracePoint>& trace) {
  std::vector<Stand> list;
  for (std::size_t i = 0; i < trace.size();) {
    std::size_t end = i;
    while (end < trace.size() && std::abs(trace[end].speed_mps) < kStands)
      ++end;
    if (end == i) {
      ++i;
      continue;
    }
    const double seconds = trace[end - 1].time_s - trace[i].time_s;
    if (seconds >= kLeastStand && trace[end - 1].time_s > kBegins) {
      const auto same = std::ranges::find_if(
          list, [&](const Stand& s) { return distance(trace[s.first], trace[i]) < kSamePlace; });
      if (same != list.end())
        same->seconds += seconds;
      else
        list.push_back({i, seconds});
    }
    i = end;
  }
  return list;
}

void draw_discs(Canvas& map, const CourseView& view, const std::vector<TracePoint>& trace, double radius_px) {
  constexpr double kMoved = 0.1;  // m; one disc where it stands, however long
  const TracePoint* last = nullptr;
  for (const TracePoint& p : trace) {
    if (last != nullptr && (p.time_s < last->time_s + kDiscStep - 0.05 || distance(p, *last) < kMoved)) continue;
    last = &p;
    map.polygon(circle(place_of(view, p), radius_px), kVehicleColor, 0.16);
    map.line(circle(place_of(view, p), radius_px), mix(kVehicleColor, kPaper, 0.3), 1);
  }
}

void draw_path(Canvas& map, const CourseView& view, const std::vector<TracePoint>& trace, double fastest) {
  std::vector<Point> way;
  for (const TracePoint& p : trace)
    way.push_back(place_of(view, p));
  for (std::size_t i = 1; i < trace.size(); ++i) {
    if (trace[i].blocked) map.line({way[i - 1], way[i]}, kBlockedHalo, kPathWidth + 10);
  }
  map.line(way, kInk, kPathWidth + 2);
  for (std::size_t i = 1; i < trace.size(); ++i)
    map.line({way[i - 1], way[i]}, speed_color(std::abs(trace[i].speed_mps) / fastest), kPathWidth);
}

// The body with its nose.
void draw_vehicle(Canvas& map, const CourseView& view, const TracePoint& p, double radius_m, Rgb8 rim) {
  const Point center = place_of(view, p);
  const double radius = std::max(radius_m * view.scale, 4.0);
  map.polygon(circle(center, radius), kVehicleColor, 0.75);
  map.line(circle(center, radius), rim, 2);
  map.line({center, view.at(p.x + radius_m * std::cos(p.yaw), p.y + radius_m * std::sin(p.yaw))}, kInk, 2);
}

void draw_cross(Canvas& map, Point at, double size) {
  for (const auto& [color, thickness] : {std::pair{kPaper, 9.0}, std::pair{Rgb8{214, 20, 20}, 5.0}}) {
    map.line({{at.x - size, at.y - size}, {at.x + size, at.y + size}}, color, thickness);
    map.line({{at.x - size, at.y + size}, {at.x + size, at.y - size}}, color, thickness);
  }
}

void draw_goal(Canvas& map, Point at) {
  disc(map, at, 12, kPaper);
  disc(map, at, 11, kGoalColor);
  disc(map, at, 7, kPaper);
  disc(map, at, 4, kGoalColor);
}

void draw_start(Canvas& map, Point at) {
  disc(map, at, 8, kPaper);
  disc(map, at, 7, kChosenColor);
  disc(map, at, 3, kPaper);
}

// Texts do not lie on what they are about.
void keep_way_free(Labels& labels, const CourseView& view, const std::vector<TracePoint>& trace, double radius_px) {
  const auto half = static_cast<int>(kPathWidth) + 2;
  for (const TracePoint& p : trace) {
    const Point at = place_of(view, p);
    labels.keep_free({static_cast<int>(at.x) - half, static_cast<int>(at.y) - half, 2 * half, 2 * half});
  }
  if (trace.empty()) return;
  const Point end = place_of(view, trace.back());
  const auto r = static_cast<int>(radius_px * 0.8);
  labels.keep_free({static_cast<int>(end.x) - r, static_cast<int>(end.y) - r, 2 * r, 2 * r});
}

void label_marks(Canvas& map, const CourseView& view, const sim::World& world, Labels& labels) {
  const auto mark = [&](Point at, const std::string& text, Rgb8 color) {
    labels.keep_free({static_cast<int>(at.x) - 10, static_cast<int>(at.y) - 10, 20, 20});
    labels.put(map, at, 15, text, kHeadText, color);
  };
  mark(view.at(world.start.x, world.start.y), "start", kChosenColor);
  for (std::size_t i = 0; i < world.goals.size(); ++i) {
    const bool is_last = i + 1 == world.goals.size();
    mark(view.at(world.goals[i].x(), world.goals[i].y()), is_last ? "goal" : "way point " + std::to_string(i + 1),
         kGoalColor);
  }
}

// What became of it, where it ended.
std::string what_happened(const RunResult& r) {
  switch (r.ending) {
    case Ending::reached:
      return "";
    case Ending::collision:
      return r.hit.empty() ? "collision" : "hit " + r.hit;
    case Ending::dropoff:
      return "drop-off";
    case Ending::stuck:
      return "stuck here";
    case Ending::timeout:
      return "here when time was over";
  }
  return "";
}

// Ticks of time along the way, as many as are readable.
void label_times(Canvas& map, const CourseView& view, const std::vector<TracePoint>& trace, Labels& labels) {
  const double step = std::max(5.0, round_step(trace.back().time_s / 9));
  double next = step;
  for (const TracePoint& p : trace) {
    if (p.time_s < next - 0.01) continue;
    next += step;
    disc(map, place_of(view, p), 4, kInk);
    disc(map, place_of(view, p), 2.5, kPaper);
    labels.put(map, place_of(view, p), 9, decimal(p.time_s, 0) + " s", kSmallText, kFaintInk);
  }
}

void draw_stands(Canvas& map, const CourseView& view, const std::vector<TracePoint>& trace, Labels& labels) {
  for (const Stand& stand : stands(trace)) {
    const Point at = place_of(view, trace[stand.first]);
    disc(map, at, 8, kInk);
    disc(map, at, 6, {255, 214, 60});
    labels.put(map, at, 11, "stood " + decimal(stand.seconds, 1) + " s", kSmallText, kInk);
  }
}

LegendItem disc_item(const std::string& text, Rgb8 rim, Rgb8 fill) {
  return {text, [=](Canvas& canvas, const Box& swatch) {
            const Point center{swatch.x + swatch.width / 2.0, swatch.y + swatch.height / 2.0};
            disc(canvas, center, swatch.height / 2.0, rim);
            disc(canvas, center, swatch.height / 2.0 - 1.5, fill);
          }};
}

std::vector<LegendItem> drive_legend(const std::vector<TracePoint>& trace) {
  std::vector<LegendItem> items{disc_item("vehicle, every " + decimal(kDiscStep, 0) + " s",
                                          mix(kVehicleColor, kPaper, 0.45), mix(kPaper, kVehicleColor, 0.2))};
  if (!stands(trace).empty()) items.push_back(disc_item("stood or turned on the spot", kInk, {255, 214, 60}));
  if (std::ranges::any_of(trace, &TracePoint::blocked))
    items.push_back(filled_item("saw no way open", kBlockedHalo));
  return items;
}

}  // namespace

Rgb8 speed_color(double share) {
  // Turbo without its ends: dark blue is nearly ink, red means harm in this picture.
  constexpr double kFirst = 0.1;
  constexpr double kLast = 0.74;
  return turbo(kFirst + (kLast - kFirst) * std::clamp(share, 0.0, 1.0));
}

CourseLegend draw_drive(Canvas& map, const CourseView& view, const sim::World& world, const RunResult& result,
                        double vehicle_radius_m, Labels& labels) {
  CourseLegend legend;
  const std::vector<TracePoint>& trace = result.trace;
  double fastest = 0.1;
  for (const TracePoint& p : trace)
    fastest = std::max(fastest, std::abs(p.speed_mps));
  legend.fastest_mps = std::ceil(fastest * 10 - 1e-6) / 10;
  const double radius = vehicle_radius_m * view.scale;
  draw_discs(map, view, trace, radius);
  if (trace.size() > 1) draw_path(map, view, trace, legend.fastest_mps);
  for (const Eigen::Vector2d& goal : world.goals)
    draw_goal(map, view.at(goal.x(), goal.y()));
  draw_start(map, view.at(world.start.x, world.start.y));
  if (trace.empty()) {
    label_marks(map, view, world, labels);
    return legend;
  }
  legend.items = drive_legend(trace);
  const bool bad = result.ending != Ending::reached;
  draw_vehicle(map, view, trace.back(), vehicle_radius_m, bad ? kBlockedColor : kInk);
  keep_way_free(labels, view, trace, radius);
  const Point end = place_of(view, trace.back());
  const bool hit = result.ending == Ending::collision || result.ending == Ending::dropoff;
  if (hit) draw_cross(map, end, 11);
  if (bad) labels.put(map, end, std::max(radius, 16.0), what_happened(result), kTitleText * 0.8, {190, 10, 10});
  label_marks(map, view, world, labels);
  draw_stands(map, view, trace, labels);
  label_times(map, view, trace, labels);
  return legend;
}

}  // namespace lakshya
