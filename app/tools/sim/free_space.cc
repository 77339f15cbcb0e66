#include "app/tools/sim/free_space.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <queue>

#include "app/tools/sim/shapes.h"
#include "app/tools/sim/truth.h"

namespace lakshya::sim {
namespace {

constexpr double kNone = std::numeric_limits<double>::infinity();

}  // namespace

FreeSpace::FreeSpace(const Ground& ground, const Rect& area, double cell_m, double reach_m)
    : area_(area),
      cell_m_(cell_m),
      reach_m_(reach_m),
      columns_(std::max(1, static_cast<int>(std::ceil((area.x1 - area.x0) / cell_m)))),
      rows_(std::max(1, static_cast<int>(std::ceil((area.y1 - area.y0) / cell_m)))) {
  const auto cells = static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_);
  ground_m_.resize(cells);
  distance_m_.assign(cells, static_cast<float>(reach_m));
  for (std::size_t i = 0; i < cells; ++i) {
    const Eigen::Vector2d p = middle(static_cast<int>(i));
    ground_m_[i] = static_cast<float>(ground_height(ground, p.x(), p.y()));
  }
  for (const GroundPatch& p : ground.patches) {
    if (!p.dropoff && !p.obstacle) continue;
    lower(rect_of(p), [&](double x, double y, double /*ground*/) { return distance_to_rect(rect_of(p), x, y); });
  }
  for (const GroundStep& s : ground_steps(ground)) {
    const Eigen::Vector2d low = s.from.cwiseMin(s.to);
    const Eigen::Vector2d high = s.from.cwiseMax(s.to);
    lower({low.x(), low.y(), high.x(), high.y()}, [&](double x, double y, double /*ground*/) {
      return distance_to_segment(s.from, s.to, {x, y});
    });
  }
}

// Every cell that is within reach of `bounds` gets the distance where that is less.
template <class F>
void FreeSpace::lower(const Rect& bounds, F distance_at) {
  const auto column = [&](double x) { return static_cast<int>(std::floor((x - area_.x0) / cell_m_)); };
  const auto row = [&](double y) { return static_cast<int>(std::floor((y - area_.y0) / cell_m_)); };
  const int c0 = std::max(column(bounds.x0 - reach_m_), 0);
  const int c1 = std::min(column(bounds.x1 + reach_m_), columns_ - 1);
  const int r1 = std::min(row(bounds.y1 + reach_m_), rows_ - 1);
  for (int r = std::max(row(bounds.y0 - reach_m_), 0); r <= r1; ++r) {
    const double y = area_.y0 + (r + 0.5) * cell_m_;
    const double dy = std::max({bounds.y0 - y, 0.0, y - bounds.y1});
    for (int c = c0; c <= c1; ++c) {
      const int cell = r * columns_ + c;
      const double x = area_.x0 + (c + 0.5) * cell_m_;
      const double dx = std::max({bounds.x0 - x, 0.0, x - bounds.x1});
      float& known = distance_m_[static_cast<std::size_t>(cell)];
      const auto known_m = static_cast<double>(known);
      if (dx * dx + dy * dy >= known_m * known_m) continue;  // the usual case, so no square root
      const double d = distance_at(x, y, static_cast<double>(ground_m_[static_cast<std::size_t>(cell)]));
      known = std::min(known, static_cast<float>(d));
    }
  }
}

void FreeSpace::add(const Thing& thing) {
  if (thing.expect == Expect::free || thing.walk) return;
  for (const auto& triangle : thing.mesh.triangles) {
    const Eigen::Vector3d a = thing.mesh.vertices[triangle[0]].cast<double>();
    const Eigen::Vector3d b = thing.mesh.vertices[triangle[1]].cast<double>();
    const Eigen::Vector3d c = thing.mesh.vertices[triangle[2]].cast<double>();
    const Eigen::Vector3d low = a.cwiseMin(b).cwiseMin(c);
    const Eigen::Vector3d high = a.cwiseMax(b).cwiseMax(c);
    lower({low.x(), low.y(), high.x(), high.y()}, [&](double x, double y, double ground) {
      return distance_to_triangle(a, b, c, x, y, ground + kLowestM, ground + kClearanceM);
    });
  }
}

int FreeSpace::cell_at(double x, double y) const {
  const double c = std::floor((x - area_.x0) / cell_m_);
  const double r = std::floor((y - area_.y0) / cell_m_);
  if (!(c >= 0 && r >= 0 && c < columns_ && r < rows_)) return -1;
  return static_cast<int>(r) * columns_ + static_cast<int>(c);
}

Eigen::Vector2d FreeSpace::middle(int cell) const {
  const int row = cell / columns_;
  return {area_.x0 + (cell % columns_ + 0.5) * cell_m_, area_.y0 + (row + 0.5) * cell_m_};
}

double FreeSpace::distance(double x, double y) const {
  const int cell = cell_at(x, y);
  return cell < 0 ? 0 : static_cast<double>(distance_m_[static_cast<std::size_t>(cell)]);
}

namespace {

struct Step {
  int dx;
  int dy;
};
constexpr std::array<Step, 16> kSteps{{{1, 0},
                                       {0, 1},
                                       {-1, 0},
                                       {0, -1},
                                       {1, 1},
                                       {-1, 1},
                                       {-1, -1},
                                       {1, -1},
                                       {2, 1},
                                       {1, 2},
                                       {-1, 2},
                                       {-2, 1},
                                       {-2, -1},
                                       {-1, -2},
                                       {1, -2},
                                       {2, -1}}};

}  // namespace

// By single steps from `from`, until `to` is reached (-1: everything).
std::vector<std::uint8_t> FreeSpace::reached(int from, int to, double radius_m) const {
  std::vector<std::uint8_t> seen(distance_m_.size(), 0);
  const auto radius = static_cast<float>(radius_m);
  if (from < 0 || distance_m_[static_cast<std::size_t>(from)] < radius) return seen;
  std::vector<int> open{from};
  seen[static_cast<std::size_t>(from)] = 1;
  while (!open.empty() && (to < 0 || seen[static_cast<std::size_t>(to)] == 0)) {
    const int cell = open.back();
    open.pop_back();
    for (std::size_t i = 0; i < 4; ++i) {
      const int c = cell % columns_ + kSteps[i].dx;
      const int r = cell / columns_ + kSteps[i].dy;
      if (c < 0 || r < 0 || c >= columns_ || r >= rows_) continue;
      const std::size_t next = index(c, r);
      if (seen[next] != 0 || distance_m_[next] < radius) continue;
      seen[next] = 1;
      open.push_back(static_cast<int>(next));
    }
  }
  return seen;
}

bool FreeSpace::connected(const Eigen::Vector2d& from, const Eigen::Vector2d& to, double radius_m) const {
  const int goal = cell_at(to.x(), to.y());
  return goal >= 0 && reached(cell_at(from.x(), from.y()), goal, radius_m)[static_cast<std::size_t>(goal)] != 0;
}

double FreeSpace::area_m2(const Eigen::Vector2d& from, double radius_m) const {
  const auto seen = reached(cell_at(from.x(), from.y()), -1, radius_m);
  return static_cast<double>(std::count(seen.begin(), seen.end(), 1)) * cell_m_ * cell_m_;
}

// A* over steps in 16 directions.
std::vector<int> FreeSpace::cells_on_the_way(int from, int to, double radius_m) const {
  const auto radius = static_cast<float>(radius_m);
  if (from < 0 || to < 0 || distance_m_[static_cast<std::size_t>(from)] < radius) return {};
  if (distance_m_[static_cast<std::size_t>(to)] < radius) return {};
  std::vector<float> cost(distance_m_.size(), std::numeric_limits<float>::infinity());
  std::vector<int> before(distance_m_.size(), -1);
  const auto rest = [&](int cell) {
    return static_cast<float>(std::hypot(cell % columns_ - to % columns_, cell / columns_ - to / columns_));
  };
  using Entry = std::pair<float, int>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
  cost[static_cast<std::size_t>(from)] = 0;
  open.push({rest(from), from});
  while (!open.empty()) {
    const auto [estimate, cell] = open.top();
    open.pop();
    if (cell == to) break;
    const float so_far = cost[static_cast<std::size_t>(cell)];
    if (estimate > so_far + rest(cell) + 1e-3F) continue;  // a better way was found since
    const auto free_at = [&](int c, int r) {
      return c >= 0 && r >= 0 && c < columns_ && r < rows_ && distance_m_[index(c, r)] >= radius;
    };
    for (const Step& s : kSteps) {
      const int c = cell % columns_ + s.dx;
      const int r = cell / columns_ + s.dy;
      if (!free_at(c, r)) continue;
      // A long step passes between two cells; both count.
      if (std::abs(s.dx) == 2 && !(free_at(c - s.dx / 2, r) && free_at(c - s.dx / 2, r - s.dy))) continue;
      if (std::abs(s.dy) == 2 && !(free_at(c, r - s.dy / 2) && free_at(c - s.dx, r - s.dy / 2))) continue;
      const std::size_t next = index(c, r);
      const float total = so_far + std::hypot(static_cast<float>(s.dx), static_cast<float>(s.dy));
      if (total >= cost[next]) continue;
      cost[next] = total;
      before[next] = cell;
      open.push({total + rest(static_cast<int>(next)), static_cast<int>(next)});
    }
  }
  if (from != to && before[static_cast<std::size_t>(to)] < 0) return {};
  std::vector<int> cells{to};
  while (cells.back() != from)
    cells.push_back(before[static_cast<std::size_t>(cells.back())]);
  std::reverse(cells.begin(), cells.end());
  return cells;
}

bool FreeSpace::sees(const Eigen::Vector2d& from, const Eigen::Vector2d& to, double radius_m) const {
  const int pieces = static_cast<int>(std::ceil((to - from).norm() / (0.5 * cell_m_)));
  for (int i = 1; i < pieces; ++i) {
    const Eigen::Vector2d p = from + (to - from) * (static_cast<double>(i) / pieces);
    if (!fits(p.x(), p.y(), radius_m)) return false;
  }
  return true;
}

std::vector<Eigen::Vector2d> FreeSpace::path(const Eigen::Vector2d& from, const Eigen::Vector2d& to,
                                             double radius_m) const {
  const auto cells = cells_on_the_way(cell_at(from.x(), from.y()), cell_at(to.x(), to.y()), radius_m);
  if (cells.empty()) return {};
  std::vector<Eigen::Vector2d> points{from};
  for (std::size_t i = 1; i + 1 < cells.size(); ++i)
    points.push_back(middle(cells[i]));
  points.push_back(to);
  // The least polygon through these points: from each the straight line to every later one that it sees.
  std::vector<Eigen::Vector2d> straight{from};
  std::size_t at = 0;
  while (at + 1 < points.size()) {
    std::size_t next = at + 1;
    for (std::size_t i = points.size() - 1; i > at + 1; --i) {
      if (sees(points[at], points[i], radius_m)) {
        next = i;
        break;
      }
    }
    straight.push_back(points[next]);
    at = next;
  }
  return straight;
}

double FreeSpace::path_m(const Eigen::Vector2d& from, const Eigen::Vector2d& to, double radius_m) const {
  const auto points = path(from, to, radius_m);
  if (points.empty()) return kNone;
  double length = 0;
  for (std::size_t i = 1; i < points.size(); ++i)
    length += (points[i] - points[i - 1]).norm();
  return length;
}

}  // namespace lakshya::sim
