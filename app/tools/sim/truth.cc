#include "app/tools/sim/truth.h"

#include <algorithm>
#include <cmath>

#include "app/tools/sim/walk.h"

namespace lakshya::sim {
namespace {

constexpr double kNone = std::numeric_limits<double>::infinity();

// A triangle between two planes has at most five corners.
struct Polygon {
  std::array<Eigen::Vector3d, 6> corners;
  std::size_t size = 0;
  void add(const Eigen::Vector3d& p) { corners[size++] = p; }
};

// What lies at sign * (z - limit) >= 0.
Polygon clipped(const Polygon& polygon, double limit, double sign) {
  Polygon result;
  for (std::size_t i = 0; i < polygon.size; ++i) {
    const Eigen::Vector3d& p = polygon.corners[i];
    const Eigen::Vector3d& q = polygon.corners[(i + 1) % polygon.size];
    const double hp = sign * (p.z() - limit);
    const double hq = sign * (q.z() - limit);
    if (hp >= 0) result.add(p);
    if ((hp > 0 && hq < 0) || (hp < 0 && hq > 0)) result.add(p + (q - p) * (hp / (hp - hq)));
  }
  return result;
}

double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

// Convex; seen from above it may be a line or a point, which has no inside.
double distance_to_polygon(const Polygon& polygon, const Eigen::Vector2d& p) {
  double best = kNone;
  bool left = false;
  bool right = false;
  for (std::size_t i = 0; i < polygon.size; ++i) {
    const Eigen::Vector2d a = polygon.corners[i].head<2>();
    const Eigen::Vector2d b = polygon.corners[(i + 1) % polygon.size].head<2>();
    best = std::min(best, distance_to_segment(a, b, p));
    const double side = cross(b - a, p - a);
    left = left || side > 0;
    right = right || side < 0;
  }
  const bool inside = left != right && polygon.size > 2;
  if (!inside) return best;
  double area = 0;  // twice
  const Eigen::Vector2d origin = polygon.corners[0].head<2>();
  for (std::size_t i = 1; i + 1 < polygon.size; ++i)
    area += cross(polygon.corners[i].head<2>() - origin, polygon.corners[i + 1].head<2>() - origin);
  return std::abs(area) > 1e-12 ? 0 : best;
}

}  // namespace

double distance_to_triangle(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c, double x,
                            double y, double z_low, double z_high) {
  Polygon polygon;
  polygon.add(a);
  polygon.add(b);
  polygon.add(c);
  const auto [low, high] = std::minmax({a.z(), b.z(), c.z()});
  if (high < z_low || low > z_high) return kNone;
  if (low < z_low) polygon = clipped(polygon, z_low, 1);
  if (high > z_high) polygon = clipped(polygon, z_high, -1);
  return polygon.size == 0 ? kNone : distance_to_polygon(polygon, {x, y});
}

TrueGeometry::Triangle TrueGeometry::triangle(const Mesh& mesh, std::size_t index, int thing, bool glass) {
  Triangle t{};
  for (std::size_t i = 0; i < 3; ++i)
    t.corners[i] = mesh.vertices[mesh.triangles[index][i]].cast<double>();
  const auto& [a, b, c] = mesh.triangles[index];
  const Eigen::Vector3f low = mesh.vertices[a].cwiseMin(mesh.vertices[b]).cwiseMin(mesh.vertices[c]);
  const Eigen::Vector3f high = mesh.vertices[a].cwiseMax(mesh.vertices[b]).cwiseMax(mesh.vertices[c]);
  t.bounds = {low.x(), low.y(), high.x(), high.y(), low.z(), high.z(), 0, glass};
  t.thing = thing;
  return t;
}

TrueGeometry::TrueGeometry(const World& world) : ground_(world.ground), steps_(ground_steps(world.ground)) {
  for (std::size_t i = 0; i < world.things.size(); ++i) {
    const Thing& thing = world.things[i];
    if (thing.expect == Expect::free) continue;
    const int index = static_cast<int>(i);
    const bool glass = thing.expect == Expect::glass;
    std::vector<Triangle> triangles;
    for (std::size_t t = 0; t < thing.mesh.triangles.size(); ++t)
      triangles.push_back(triangle(thing.mesh, t, index, glass));
    for (std::size_t t = 0; t < triangles.size(); ++t)
      triangles[t].bounds.triangle = static_cast<std::uint32_t>(t);
    if (!thing.walk) {
      triangles_.insert(triangles_.end(), triangles.begin(), triangles.end());
      continue;
    }
    Walker walker{*thing.walk, std::move(triangles), 0, index, glass};
    for (const Eigen::Vector3f& v : thing.mesh.vertices)
      walker.reach_m = std::max(walker.reach_m, v.head<2>().cast<double>().norm());
    walkers_.push_back(std::move(walker));
  }
  make_grid();
}

void TrueGeometry::make_grid() {
  if (triangles_.empty()) return;
  double x1 = -kNone;
  double y1 = -kNone;
  x0_ = y0_ = kNone;
  for (const Triangle& t : triangles_) {
    x0_ = std::min(x0_, static_cast<double>(t.bounds.x0));
    y0_ = std::min(y0_, static_cast<double>(t.bounds.y0));
    x1 = std::max(x1, static_cast<double>(t.bounds.x1));
    y1 = std::max(y1, static_cast<double>(t.bounds.y1));
  }
  bucket_m_ = std::max({0.25, (x1 - x0_) / 64, (y1 - y0_) / 64});
  columns_ = static_cast<int>((x1 - x0_) / bucket_m_) + 1;
  rows_ = static_cast<int>((y1 - y0_) / bucket_m_) + 1;
  const auto column = [&](double x) {
    return std::clamp(static_cast<int>((x - x0_) / bucket_m_), 0, columns_ - 1);
  };
  const auto row = [&](double y) { return std::clamp(static_cast<int>((y - y0_) / bucket_m_), 0, rows_ - 1); };
  std::vector<std::vector<std::uint32_t>> buckets(static_cast<std::size_t>(columns_) *
                                                  static_cast<std::size_t>(rows_));
  for (std::size_t i = 0; i < triangles_.size(); ++i) {
    const Triangle& t = triangles_[i];
    for (int r = row(static_cast<double>(t.bounds.y0)); r <= row(static_cast<double>(t.bounds.y1)); ++r) {
      for (int c = column(static_cast<double>(t.bounds.x0)); c <= column(static_cast<double>(t.bounds.x1)); ++c)
        buckets[bucket(c, r)].push_back(static_cast<std::uint32_t>(i));
    }
  }
  for (const auto& held : buckets) {
    first_.push_back(static_cast<std::uint32_t>(entries_.size()));
    for (const std::uint32_t i : held) {
      entries_.push_back(triangles_[i].bounds);
      entries_.back().triangle = i;
    }
  }
  first_.push_back(static_cast<std::uint32_t>(entries_.size()));
}

void TrueGeometry::visit(const Bounds& bounds, const std::vector<Triangle>& triangles, const Query& query,
                         Nearest& best) {
  const double dx =
      std::max({static_cast<double>(bounds.x0) - query.x, 0.0, query.x - static_cast<double>(bounds.x1)});
  const double dy =
      std::max({static_cast<double>(bounds.y0) - query.y, 0.0, query.y - static_cast<double>(bounds.y1)});
  if (dx * dx + dy * dy >= best.distance_m * best.distance_m) return;
  if ((bounds.glass && !query.glass) || static_cast<double>(bounds.z1) < query.z_low ||
      static_cast<double>(bounds.z0) > query.z_high)
    return;
  const Triangle& t = triangles[bounds.triangle];
  const double distance =
      distance_to_triangle(t.corners[0], t.corners[1], t.corners[2], query.x, query.y, query.z_low, query.z_high);
  if (distance < best.distance_m) best = {distance, t.thing, -1};
}

void TrueGeometry::visit_bucket(int column, int row, const Query& query, Nearest& best) const {
  const double x0 = x0_ + column * bucket_m_;
  const double y0 = y0_ + row * bucket_m_;
  // What reaches beyond a bucket is in the next one, too. The last ones hold what rounding puts past their edge.
  constexpr double kRounding = 1e-9;
  if (distance_to_rect({x0, y0, x0 + bucket_m_, y0 + bucket_m_}, query.x, query.y) > best.distance_m + kRounding)
    return;
  const std::size_t b = bucket(column, row);
  for (std::uint32_t i = first_[b]; i < first_[b + 1]; ++i)
    visit(entries_[i], triangles_, query, best);
}

// Rings of buckets about the one that is nearest to the point, until what they hold cannot be nearer.
void TrueGeometry::search_grid(const Query& query, Nearest& best) const {
  if (triangles_.empty()) return;
  const int column = static_cast<int>(std::clamp((query.x - x0_) / bucket_m_, 0.0, columns_ - 1.0));
  const int row = static_cast<int>(std::clamp((query.y - y0_) / bucket_m_, 0.0, rows_ - 1.0));
  const int last = std::max({column, columns_ - 1 - column, row, rows_ - 1 - row});
  for (int ring = 0; ring <= last; ++ring) {
    if (ring > 1 && (ring - 1) * bucket_m_ >= best.distance_m) return;
    const int r0 = std::max(row - ring, 0);
    const int r1 = std::min(row + ring, rows_ - 1);
    for (int r = r0; r <= r1; ++r) {
      const bool whole = r == row - ring || r == row + ring;
      const int step = whole || ring == 0 ? 1 : 2 * ring;
      for (int c = column - ring; c <= column + ring; c += step) {
        if (c >= 0 && c < columns_) visit_bucket(c, r, query, best);
      }
    }
  }
}

void TrueGeometry::search_ground(const Query& query, Nearest& best) const {
  for (std::size_t i = 0; i < ground_.patches.size(); ++i) {
    const GroundPatch& p = ground_.patches[i];
    if (!p.obstacle) continue;
    const double distance = distance_to_rect(rect_of(p), query.x, query.y);
    if (distance < best.distance_m) best = {distance, -1, static_cast<int>(i)};
  }
  for (const GroundStep& s : steps_) {
    const double distance = distance_to_segment(s.from, s.to, {query.x, query.y});
    if (distance < best.distance_m) best = {distance, -1, s.patch};
  }
}

Nearest TrueGeometry::nearest(double x, double y, double z_low, double z_high, const WalkTimes& when,
                              bool glass) const {
  Nearest best;
  const Query query{x, y, z_low, z_high, glass};
  search_ground(query, best);
  search_grid(query, best);
  for (const Walker& walker : walkers_) {
    if (walker.glass && !glass) continue;
    const Place place = place_on_walk(walker.walk, when.of(static_cast<std::size_t>(walker.thing)));
    const double dx = x - place.x;
    const double dy = y - place.y;
    if (std::hypot(dx, dy) - walker.reach_m >= best.distance_m) continue;
    const double c = std::cos(place.yaw);
    const double s = std::sin(place.yaw);
    const double ground = ground_height(ground_, place.x, place.y);
    const Query own{c * dx + s * dy, c * dy - s * dx, z_low - ground, z_high - ground, glass};
    for (const Triangle& t : walker.triangles)
      visit(t.bounds, walker.triangles, own, best);
  }
  return best;
}

bool TrueGeometry::dropoff_at(double x, double y) const {
  const GroundPatch* p = patch_at(ground_, x, y);
  return p != nullptr && p->dropoff;
}

}  // namespace lakshya::sim
