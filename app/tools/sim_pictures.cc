#include "app/tools/sim_pictures.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>

#include "app/tools/picture_colors.h"
#include "app/tools/sim_course.h"

namespace lakshya {
namespace {

using sim::RunResult;

constexpr int kWidth = 1200;
constexpr int kMargin = 24;
constexpr int kCourseTop = 86;
constexpr int kMostMapHeight = 900;
constexpr int kScaleRow = 48;
constexpr std::size_t kFewThings = 14;  // that are all named
constexpr double kNear = 1.2;           // m from the way to a thing that is named among many

std::string metres(double value) {
  return std::isfinite(value) ? decimal(value, value < 10 ? 2 : 1) + " m" : "-";
}

std::string figures_text(const RunResult& r) {
  std::string text = decimal(r.time_s, 1) + " s,  path " + metres(r.path_m);
  if (r.shortest_m > 0) text += " (shortest " + metres(r.shortest_m) + ")";
  text += ",  nearest clearance " + metres(r.min_clearance_m) + ",  " + decimal(r.mean_speed_mps, 2) +
          " m/s on average";
  if (r.false_stops > 0) text += ",  " + std::to_string(r.false_stops) + " false stops";
  return text;
}

void draw_title(Canvas& sheet, const RunResult& r) {
  const int room = kWidth - 2 * kMargin;
  const std::string name = text_that_fits(world_label(r.world), kTitleText, room / 2) + ", seed " +
                           std::to_string(r.seed) + ", " + r.sensor + ":";
  sheet.text({kMargin, 40}, name, kTitleText, kInk, Align::left, 2);
  const int name_width = text_width(name, kTitleText);
  sheet.text({kMargin + name_width + 14.0, 40}, text_that_fits(ending_text(r), kTitleText, room - name_width - 14),
             kTitleText, r.ending == sim::Ending::reached ? Rgb8{0, 120, 88} : Rgb8{190, 10, 10}, Align::left, 2);
  sheet.text({kMargin, 68}, text_that_fits(figures_text(r), kHeadText, room), kHeadText, kFaintInk);
}

double distance_to_way(const CourseView& view, const std::vector<sim::TracePoint>& trace, const Box& box) {
  double least = std::numeric_limits<double>::infinity();
  for (const sim::TracePoint& p : trace) {
    const Point at = view.at(p.x, p.y);
    least = std::min(least, std::hypot(std::max({box.x - at.x, at.x - box.right(), 0.0}),
                                       std::max({box.y - at.y, at.y - box.bottom(), 0.0})));
  }
  return least / view.scale;
}

struct Named {
  double distance_m;
  Box box;
  const std::string* name;
  bool walks;
};

// What a text rather does not lie on, and what gets one itself, the nearest to the way first.
std::vector<Named> things_to_name(const CourseView& view, const sim::World& world, const RunResult& r,
                                  Labels& labels) {
  std::vector<Named> named;
  for (std::size_t i = 0; i < world.things.size(); ++i) {
    const sim::Thing& thing = world.things[i];
    if (is_left_out(thing, world.ground)) continue;
    const Box box = box_of(thing, r.walks.of(i), view);
    labels.rather_free(box);
    if (look_of(thing, world.ground) == Look::wall) continue;
    if (thing.name != r.hit)
      named.push_back({distance_to_way(view, r.trace, box), box, &thing.name, thing.walk.has_value()});
  }
  for (const sim::GroundPatch& p : world.ground.patches) {
    if (p.dropoff) labels.rather_free(view.box(p.x0, p.y0, p.x1, p.y1));
  }
  std::ranges::stable_sort(named, {}, &Named::distance_m);
  if (named.size() > kFewThings)
    std::erase_if(named, [](const Named& n) { return n.distance_m > kNear && !n.walks; });
  return named;
}

void draw_north(Canvas& map, const CourseView& view, Labels& labels) {
  const Point at{map.width() - 34.0, 40};
  map.fill({map.width() - 62, 10, 52, 58}, kPaper, 0.75);
  labels.keep_free({map.width() - 62, 10, 52, 58});
  const Point tip = view.turned ? Point{at.x + 17, at.y} : Point{at.x, at.y - 17};
  const Point tail = view.turned ? Point{at.x - 17, at.y} : Point{at.x, at.y + 13};
  map.arrow({tail, tip}, kInk, 2.5);
  map.text(view.turned ? Point{at.x, at.y + 22.0} : Point{at.x - 15, at.y + 2.0}, "N", kBodyText, kInk,
           Align::center);
}

void draw_scale(Canvas& sheet, double top, double scale) {
  const double length_m = round_step(80 / scale);
  const auto length = static_cast<int>(std::lround(length_m * scale));
  const auto y = static_cast<int>(top) + 20;
  sheet.fill({kMargin, y, length, 4}, kInk);
  sheet.fill({kMargin, y - 4, 2, 12}, kInk);
  sheet.fill({kMargin + length - 2, y - 4, 2, 12}, kInk);
  sheet.text({kMargin + length + 10.0, y + 7.0}, decimal(length_m, length_m < 1 ? 1 : 0) + " m", kBodyText, kInk);
}

void draw_speeds(Canvas& sheet, double top, double fastest_mps) {
  constexpr int kBar = 220;
  const int left = kWidth - kMargin - kBar - 90;
  const auto y = static_cast<int>(top) + 12;
  sheet.text({left - 12.0, y + 14.0}, "speed   0", kBodyText, kInk, Align::right);
  for (int x = 0; x < kBar; ++x)
    sheet.fill({left + x, y, 1, 18}, speed_color(x / (kBar - 1.0)));
  sheet.frame({left, y, kBar, 18}, kFaintInk);
  sheet.text({left + kBar + 12.0, y + 14.0}, decimal(fastest_mps, 1) + " m/s", kBodyText, kInk);
}

std::vector<LegendItem> legend_items(const DrawnWorld& drawn, const CourseLegend& drive) {
  std::vector<LegendItem> items = drive.items;
  for (const Look look : drawn.looks)
    items.push_back(legend_of(look));
  if (drawn.walks)
    items.push_back(line_item("walk to and fro, ring: where at the start", {170, 60, 130}, 2, Stroke::dashed));
  items.insert(items.end(), drawn.ground.begin(), drawn.ground.end());
  return items;
}

int legend_height(const std::vector<LegendItem>& items) {
  Canvas measure(1, 1, kPaper);
  return draw_legend(measure, {0, 0}, kWidth - 2 * kMargin, items);
}

}  // namespace

std::string world_label(const std::string& world) {
  const bool is_file = world.find('/') != std::string::npos || world.ends_with(".yaml") || world.ends_with(".yml");
  std::string label = is_file ? std::filesystem::path(world).stem().string() : world;
  for (char& c : label) {
    const bool plain =
        (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '.' || c == '-';
    if (!plain) c = '_';
  }
  return label.empty() || label.starts_with('.') ? "world" + label : label;
}

std::string ending_text(const RunResult& r) {
  std::string text(sim::kEndingNames[static_cast<std::size_t>(r.ending)]);
  if (r.ending == sim::Ending::dropoff) text = "went over a drop-off";
  if (r.ending == sim::Ending::timeout) text = "time was over";
  if (!r.hit.empty()) text += " with " + r.hit;
  if (!r.excuse.empty()) text += " (" + r.excuse + ")";
  return text;
}

Image<Rgb8> course_picture(const sim::World& world, const RunResult& result, double vehicle_radius_m) {
  const CourseView view = course_view(world, result, kWidth - 2 * kMargin, kMostMapHeight);
  const Box box{kMargin, kCourseTop, view.width(), view.height()};
  Canvas map(box.width, box.height, kPaper);
  const DrawnWorld drawn = draw_world(map, view, world, result.walks);
  Labels labels({0, 0, box.width, box.height});
  draw_north(map, view, labels);
  const std::vector<Named> names = things_to_name(view, world, result, labels);
  const CourseLegend drive = draw_drive(map, view, world, result, vehicle_radius_m, labels);
  for (const Named& n : names)
    labels.put(map, n.box, 3, *n.name, kSmallText, kInk, true);

  const std::vector<LegendItem> items = legend_items(drawn, drive);
  Canvas sheet(kWidth, box.bottom() + kScaleRow + legend_height(items) + kMargin, kPaper);
  draw_title(sheet, result);
  sheet.paste(map.image().view(), box);
  sheet.frame(box, kFaintInk);
  draw_scale(sheet, box.bottom(), view.scale);
  if (result.trace.size() > 1) draw_speeds(sheet, box.bottom(), drive.fastest_mps);
  draw_legend(sheet, {kMargin, static_cast<double>(box.bottom() + kScaleRow)}, kWidth - 2 * kMargin, items);
  return sheet.image();
}

}  // namespace lakshya
