#include "app/tools/sim_sheet.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "app/tools/picture_colors.h"
#include "app/tools/picture_panels.h"
#include "app/tools/picture_plot.h"
#include "app/tools/sim_pictures.h"

namespace lakshya {
namespace {

using sim::RunResult;

constexpr int kWidth = 2000;
constexpr int kMargin = 30;
constexpr int kGap = 20;
constexpr int kFactsLeft = 1230;
constexpr int kPlotLeft = 90;
constexpr int kPlotHeight = 170;
constexpr int kPlotPitch = 250;  // from one plot to the next
constexpr int kStripHeight = 22;

std::string metres(double value) {
  return std::isfinite(value) ? decimal(value, 2) + " m" : "-";
}

std::vector<Fact> figures(const sim::World& world, const RunResult& r) {
  std::string hard;
  for (const std::string& trait : world.traits)
    hard += (hard.empty() ? "" : ", ") + trait;
  const double detour = r.shortest_m > 0 && std::isfinite(r.shortest_m) ? r.path_m / r.shortest_m : 0;
  std::vector<Fact> facts{
      {"world", world_label(r.world) + (world.indoor ? ", indoors" : ", outdoors")},
      {"hard about it", hard.empty() ? "nothing" : hard},
      {"seed", std::to_string(r.seed)},
      {"sensor", r.sensor},
      {"result", ending_text(r)},
      {"time", decimal(r.time_s, 1) + " s (limit " + decimal(world.time_limit_s, 0) + " s)"},
      {"path", metres(r.path_m)},
      {"shortest", metres(r.shortest_m) + (detour > 0 ? ", driven: " + decimal(detour, 2) + " times that" : "")},
      {"least clearance", metres(r.min_clearance_m)},
      {"mean speed", decimal(r.mean_speed_mps, 2) + " m/s"},
      {"false stops", std::to_string(r.false_stops)},
      {"bumps", std::to_string(r.bumps)},
      {"to the goal", metres(r.goal_distance_m)},
      {"frames", std::to_string(r.frames)},
      {"frame, median", decimal(r.frame_ms_p50, 1) + " ms"},
      {"frame, 99 %", decimal(r.frame_ms_p99, 1) + " ms"}};
  return facts;
}

// ---- camera pictures

int strip_height(const DriveRecord& record) {
  if (record.moments.empty()) return 0;
  const Image<Rgb8>& first = record.moments.front().picture;
  const auto count = static_cast<int>(SimMoments::kMoments);
  const int width = (kWidth - 2 * kMargin - (count - 1) * kGap) / count;
  return 30 + width * first.height() / std::max(first.width(), 1) + 40;
}

void draw_moments(Canvas& sheet, int top, const DriveRecord& record) {
  const auto count = static_cast<int>(SimMoments::kMoments);
  const int width = (kWidth - 2 * kMargin - (count - 1) * kGap) / count;
  int x = kMargin;
  for (const DriveMoment& moment : record.moments) {
    const int height = width * moment.picture.height() / std::max(moment.picture.width(), 1);
    sheet.paste(moment.picture.view(), {x, top + 26, width, height}, Enlarge::smooth);
    const std::string text = decimal(moment.time_s, 1) + " s: " + moment.text;
    sheet.text({x + 0.0, top + 16.0}, text_that_fits(text, kBodyText, width), kBodyText, kInk);
    x += width + kGap;
  }
  const auto tint = [](const char* text, PixelClass pixel_class) {
    return filled_item(text, class_color(pixel_class, 0, 150));
  };
  draw_legend(sheet, {kMargin, top + strip_height(record) - 40.0}, kWidth - 2 * kMargin,
              {tint("obstacle", PixelClass::obstacle), tint("floor", PixelClass::floor),
               tint("drop-off", PixelClass::drop_off), tint("overhead", PixelClass::ceiling)});
}

// ---- over time

double end_of(const RunResult& r, const DriveRecord& record) {
  double end = std::max(r.time_s, 1.0);
  if (!r.trace.empty()) end = std::max(end, r.trace.back().time_s);
  if (!record.samples.empty()) end = std::max(end, record.samples.back().time_s);
  return end;
}

Plot plot_at(int top, double end_s, double high) {
  return {{kPlotLeft, top, kWidth - kPlotLeft - kMargin - 10, kPlotHeight},
          {.low = 0, .high = end_s, .most_ticks = 20},
          {.low = 0, .high = high, .most_ticks = 5}};
}

void draw_axes(Canvas& sheet, const Plot& plot, const std::string& title) {
  draw_y_axis(sheet, plot, title);
  draw_x_axis(sheet, plot, "s");
  sheet.frame(plot.box, kFaintInk);
}

void draw_speed(Canvas& sheet, int top, double end_s, const RunResult& r) {
  double fastest = 0.1;
  std::vector<Point> points;
  for (const sim::TracePoint& p : r.trace)
    fastest = std::max(fastest, std::abs(p.speed_mps));
  const Plot plot = plot_at(top, end_s, 1.15 * fastest);
  for (const sim::TracePoint& p : r.trace)
    points.push_back(plot.at(p.time_s, std::abs(p.speed_mps)));
  draw_axes(sheet, plot, "true speed, m/s");
  if (points.size() > 1) sheet.line(points, series_color(0), 2);
}

// Farther than this the plot does not go: near things matter.
constexpr double kFarthest = 8;

void draw_distances(Canvas& sheet, int top, double end_s, const DriveRecord& record) {
  double farthest = 1;
  for (const DriveSample& s : record.samples)
    farthest = std::max({farthest, s.clear_m, s.nearest_m});
  const Plot plot = plot_at(top, end_s, std::min(1.1 * farthest, kFarthest));
  std::vector<Point> clear;
  std::vector<std::vector<Point>> nearest(1);  // interrupted where there is none
  for (const DriveSample& s : record.samples) {
    clear.push_back(plot.at(s.time_s, std::min(s.clear_m, plot.y.high)));
    if (s.nearest_m >= 0) {
      nearest.back().push_back(plot.at(s.time_s, std::min(s.nearest_m, plot.y.high)));
    } else if (!nearest.back().empty()) {
      nearest.emplace_back();
    }
  }
  draw_axes(sheet, plot, "as the vehicle sees it, m (farther than " + decimal(kFarthest, 0) + " m is not shown)");
  if (clear.size() > 1) sheet.line(clear, series_color(0), 2);
  for (const auto& line : nearest) {
    if (line.size() > 1) sheet.line(line, series_color(4), 2);
  }
  draw_legend(sheet, {plot.box.right() - 470.0, plot.box.y - 32.0}, 480,
              {line_item("clear way in the chosen direction", series_color(0), 2, Stroke::solid),
               line_item("nearest obstacle", series_color(4), 2, Stroke::solid)});
}

Rgb8 state_color(State state) {
  switch (state) {
    case State::run:
      return {120, 190, 150};
    case State::degraded:
      return {240, 200, 90};
    case State::stop:
      return {228, 120, 90};
    case State::fault:
      return {190, 40, 40};
    default:
      return {196, 204, 214};
  }
}

// One colour after the other along the time.
template <class Color>
void draw_strip(Canvas& sheet, int top, double end_s, const DriveRecord& record, Color color) {
  const Plot plot = plot_at(top, end_s, 1);
  for (std::size_t i = 0; i < record.samples.size(); ++i) {
    const double from = record.samples[i].time_s;
    const double to = i + 1 < record.samples.size() ? record.samples[i + 1].time_s : from + 0.1;
    const auto x0 = static_cast<int>(std::lround(plot.at(from, 0).x));
    const auto x1 = std::min(static_cast<int>(std::lround(plot.at(to, 0).x)), plot.box.right());
    sheet.fill({x0, top, std::max(x1 - x0, 1), kStripHeight}, color(record.samples[i]));
  }
  sheet.frame({plot.box.x, top, plot.box.width, kStripHeight}, kFaintInk);
}

void draw_states(Canvas& sheet, int top, double end_s, const DriveRecord& record) {
  sheet.text({kPlotLeft - 10.0, top + 15.0}, "state", kSmallText, kInk, Align::right);
  draw_strip(sheet, top, end_s, record, [](const DriveSample& s) { return state_color(s.state); });
  const int second = top + kStripHeight + 8;
  sheet.text({kPlotLeft - 10.0, second + 15.0}, "plan", kSmallText, kInk, Align::right);
  draw_strip(sheet, second, end_s, record, [](const DriveSample& s) {
    return s.blocked ? kBlockedColor : Rgb8{232, 240, 248};
  });
  std::vector<LegendItem> items;
  std::array<bool, kStates> seen{};
  for (const DriveSample& s : record.samples) {
    bool& before = seen[static_cast<std::size_t>(s.state)];
    if (!before) items.push_back(filled_item(to_string(s.state), state_color(s.state)));
    before = true;
  }
  items.push_back(filled_item("a way is open", {232, 240, 248}));
  items.push_back(filled_item("no way open", kBlockedColor));
  draw_legend(sheet, {kPlotLeft, second + kStripHeight + 4.0}, kWidth - kPlotLeft - kMargin, items);
}

}  // namespace

Image<Rgb8> drive_sheet(const sim::World& world, const RunResult& result, const DriveRecord& record,
                        double vehicle_radius_m) {
  const Image<Rgb8> course = course_picture(world, result, vehicle_radius_m);
  const std::vector<Fact> facts = figures(world, result);
  const int strip_top = std::max(course.height(), 80 + static_cast<int>(facts.size()) * 22 + 40) + 10;
  const int plots_top = strip_top + strip_height(record) + 50;
  const int states_top = plots_top + 2 * kPlotPitch - 14;
  Canvas sheet(kWidth, states_top + 2 * kStripHeight + 60, kPaper);

  sheet.paste(course.view(), {kMargin - 24, 0, course.width(), course.height()});
  sheet.text({kFactsLeft, 68}, "The drive in figures", kHeadText, kInk);
  sheet.fill({kFactsLeft, 80, kWidth - kFactsLeft - kMargin, 1}, kRule);
  draw_facts(sheet, {kFactsLeft, 90, kWidth - kFactsLeft - kMargin, 0}, facts);
  if (!record.moments.empty()) draw_moments(sheet, strip_top, record);

  const double end_s = end_of(result, record);
  draw_speed(sheet, plots_top, end_s, result);
  draw_distances(sheet, plots_top + kPlotPitch, end_s, record);
  draw_states(sheet, states_top, end_s, record);
  return sheet.image();
}

}  // namespace lakshya
