// Which part of the world a course's picture shows, and where its labels go.
#include <algorithm>
#include <array>
#include <cmath>

#include "app/tools/picture_colors.h"
#include "app/tools/sim_course.h"

namespace lakshya {
namespace {

constexpr double kAround = 4;          // m beside the way that are always shown, if there is anything
constexpr double kAroundShare = 0.15;  // of the way's extent, likewise
constexpr double kRim = 0.4;           // m beyond the last thing
constexpr double kFlattest = 0.36;     // height of the map over its width

Extent way_extent(const sim::World& world, const sim::RunResult& result) {
  Extent e{world.start.x, world.start.y, world.start.x, world.start.y};
  for (const Eigen::Vector2d& goal : world.goals)
    e.take(goal.x(), goal.y());
  for (const sim::TracePoint& p : result.trace)
    e.take(p.x, p.y);
  return e;
}

// All that stands or lies somewhere, or walks.
Extent world_extent(const sim::World& world, Extent e) {
  for (const sim::Thing& thing : world.things) {
    if (thing.walk) {
      for (const Eigen::Vector2d& p : thing.walk->points)
        e.take(p.x(), p.y());
      continue;
    }
    for (const Eigen::Vector3f& v : thing.mesh.vertices)
      e.take(v.x(), v.y());
  }
  for (const sim::GroundPatch& p : world.ground.patches) {
    e.take(p.x0, p.y0);
    e.take(p.x1, p.y1);
  }
  e.grow(kRim);
  return e;
}

Extent common(const Extent& a, const Extent& b) {
  return {std::max(a.x0, b.x0), std::max(a.y0, b.y0), std::min(a.x1, b.x1), std::min(a.y1, b.y1)};
}

// To at least this length, the same on both sides.
void stretch(double& low, double& high, double length) {
  const double missing = std::max(0.0, length - (high - low));
  low -= missing / 2;
  high += missing / 2;
}

}  // namespace

void Extent::take(double x, double y) {
  x0 = std::min(x0, x);
  y0 = std::min(y0, y);
  x1 = std::max(x1, x);
  y1 = std::max(y1, y);
}

void Extent::grow(double by) {
  x0 -= by;
  y0 -= by;
  x1 += by;
  y1 += by;
}

Box CourseView::box(double x0, double y0, double x1, double y1) const {
  const Point a = at(x0, y0);
  const Point b = at(x1, y1);
  const auto left = static_cast<int>(std::lround(std::min(a.x, b.x)));
  const auto top = static_cast<int>(std::lround(std::min(a.y, b.y)));
  return {left, top, static_cast<int>(std::lround(std::max(a.x, b.x))) - left,
          static_cast<int>(std::lround(std::max(a.y, b.y))) - top};
}

int CourseView::width() const {
  return static_cast<int>(std::lround((turned ? extent.height() : extent.width()) * scale));
}

int CourseView::height() const {
  return static_cast<int>(std::lround((turned ? extent.width() : extent.height()) * scale));
}

CourseView course_view(const sim::World& world, const sim::RunResult& result, int width, int most_height) {
  CourseView view;
  const Extent way = way_extent(world, result);
  Extent shown = way;
  shown.grow(std::max(kAround, kAroundShare * std::max(way.width(), way.height())));
  shown = common(shown, world_extent(world, way));
  view.turned = shown.height() > 1.15 * shown.width();
  double& across_low = view.turned ? shown.y0 : shown.x0;
  double& across_high = view.turned ? shown.y1 : shown.x1;
  double& up_low = view.turned ? shown.x0 : shown.y0;
  double& up_high = view.turned ? shown.x1 : shown.y1;
  stretch(across_low, across_high, (up_high - up_low) * width / most_height);
  stretch(up_low, up_high, (across_high - across_low) * kFlattest);
  view.extent = shown;
  view.scale = width / (across_high - across_low);
  return view;
}

bool Labels::is_free(const Box& box, bool strictly) const {
  if (box.x < area_.x || box.y < area_.y || box.right() > area_.right() || box.bottom() > area_.bottom())
    return false;
  const auto is_hit = [&](const Box& other) { return overlap(box, other); };
  return std::ranges::none_of(taken_, is_hit) && !(strictly && std::ranges::any_of(avoided_, is_hit));
}

bool Labels::put(Canvas& canvas, const Box& about, double away, const std::string& text, double cap_height,
                 Rgb8 color, bool inside) {
  constexpr int kAir = 3;  // px around a text
  const int width = text_width(text, cap_height) + 2 * kAir;
  const int height = static_cast<int>(cap_height * 1.35) + 2 * kAir;
  const Point middle{about.x + about.width / 2.0, about.y + about.height / 2.0};
  const auto put_at = [&](Point at, bool strictly) {
    const Box box{static_cast<int>(std::lround(at.x - width / 2.0)),
                  static_cast<int>(std::lround(at.y - height / 2.0)), width, height};
    if (!is_free(box, strictly)) return false;
    const Point baseline{box.x + kAir + 0.0, box.y + kAir + cap_height};
    canvas.text(baseline, text, cap_height, kPaper, Align::left, 4);
    canvas.text(baseline, text, cap_height, color);
    keep_free(box);
    return true;
  };
  if (inside && about.width > width && about.height > height && put_at(middle, false)) return true;
  // Right, left, above, below, then the corners.
  constexpr std::array<Point, 8> kSides{{{1, 0}, {-1, 0}, {0, -1}, {0, 1}, {1, -1}, {-1, -1}, {1, 1}, {-1, 1}}};
  for (const bool strictly : {true, false}) {
    for (const double farther : {1.0, 1.8}) {
      for (const Point& side : kSides) {
        const bool is_corner = side.x != 0 && side.y != 0;
        const double out = away * farther * (is_corner ? 0.5 : 1);
        if (put_at({middle.x + side.x * (about.width / 2.0 + out + width / 2.0),
                    middle.y + side.y * (about.height / 2.0 + out + height / 2.0)},
                   strictly))
          return true;
      }
    }
  }
  return false;
}

}  // namespace lakshya
