#include "app/tools/sim/footprint.h"

#include <algorithm>
#include <limits>

#include "app/tools/sim/free_space.h"
#include "app/tools/sim/shapes.h"

namespace lakshya::sim {
namespace {

constexpr float kHighestM = 1.5F;  // a lamp's shade must not stand in a wall; a tree's crown may reach over it
constexpr double kNone = std::numeric_limits<double>::infinity();

double turn(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c) {
  return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
}

bool contains(const Footprint& f, const Eigen::Vector2d& p) {
  for (std::size_t i = 0; i < f.size(); ++i) {
    if (turn(f[i], f[(i + 1) % f.size()], p) < 0) return false;
  }
  return f.size() > 2;
}

// A side of one footprint with the other one wholly outside of it shows that they do not overlap.
bool separated_by(const Footprint& a, const Footprint& b) {
  for (std::size_t i = 0; i < a.size(); ++i) {
    const Eigen::Vector2d& from = a[i];
    const Eigen::Vector2d& to = a[(i + 1) % a.size()];
    if (std::all_of(b.begin(), b.end(), [&](const auto& p) { return turn(from, to, p) < 0; })) return true;
  }
  return false;
}

}  // namespace

// Andrew's monotone chain (1979).
Footprint hull_of(std::vector<Eigen::Vector2d> points) {
  std::sort(points.begin(), points.end(),
            [](const auto& a, const auto& b) { return a.x() < b.x() || (a.x() == b.x() && a.y() < b.y()); });
  points.erase(std::unique(points.begin(), points.end()), points.end());
  if (points.size() < 3) return points;
  Footprint hull;
  const auto chain = [&](auto begin, auto end) {
    const std::size_t base = hull.size();
    for (auto it = begin; it != end; ++it) {
      while (hull.size() >= base + 2 && turn(hull[hull.size() - 2], hull.back(), *it) <= 0)
        hull.pop_back();
      hull.push_back(*it);
    }
    hull.pop_back();
  };
  chain(points.begin(), points.end());
  chain(points.rbegin(), points.rend());
  return hull;
}

Footprint footprint_of(const Rect& r) {
  return {{r.x0, r.y0}, {r.x1, r.y0}, {r.x1, r.y1}, {r.x0, r.y1}};
}

Footprint footprint_of(const Thing& thing) {
  std::vector<Eigen::Vector2d> points;
  for (const auto& triangle : thing.mesh.triangles) {
    float low = std::numeric_limits<float>::infinity();
    float high = -low;
    for (const std::uint32_t v : triangle) {
      low = std::min(low, thing.mesh.vertices[v].z());
      high = std::max(high, thing.mesh.vertices[v].z());
    }
    if (high < static_cast<float>(kLowestM) || low > kHighestM) continue;
    for (const std::uint32_t v : triangle)
      points.emplace_back(thing.mesh.vertices[v].head<2>().cast<double>());
  }
  return hull_of(std::move(points));
}

double distance_to(const Footprint& f, const Eigen::Vector2d& p) {
  if (contains(f, p)) return 0;
  double best = kNone;
  for (std::size_t i = 0; i < f.size(); ++i)
    best = std::min(best, distance_to_segment(f[i], f[(i + 1) % f.size()], p));
  return best;
}

double gap_between(const Footprint& a, const Footprint& b) {
  if (a.empty() || b.empty()) return kNone;
  if (!separated_by(a, b) && !separated_by(b, a)) return 0;
  double best = kNone;  // of convex bodies apart, a corner is nearest
  for (const Eigen::Vector2d& p : a)
    best = std::min(best, distance_to(b, p));
  for (const Eigen::Vector2d& p : b)
    best = std::min(best, distance_to(a, p));
  return best;
}

bool inside(const Footprint& footprint, const Rect& r) {
  return std::all_of(footprint.begin(), footprint.end(), [&](const auto& p) {
    return p.x() >= r.x0 && p.x() <= r.x1 && p.y() >= r.y0 && p.y() <= r.y1;
  });
}

}  // namespace lakshya::sim
