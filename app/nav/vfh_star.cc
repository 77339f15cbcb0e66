#include "app/nav/vfh_star.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "kernels/base/units.h"

namespace lakshya {
namespace {

constexpr double kDiscount = 0.8;  // lambda
// Weights of projected candidates: mu1', mu2', mu3' as shares of the primary ones (2000: 5, 1, 1 for 5, 2, 2).
constexpr double kProjectedTurn = 0.5;
constexpr double kTolerance = 1e-9;
// A way that has to turn back by more than this has come to a dead end. (Discounted, turning back there would be cheap.)
constexpr double kMostTurn = radians(100);

struct Place {
  double x = 0;  // m ahead
  double y = 0;  // m to the left
};

struct Node {
  Place at;
  double heading = 0;
  double cost = 0;      // g
  double estimate = 0;  // g + h
  double first = 0;     // direction of the first step
  double discount = 1;  // lambda^depth
  int depth = 0;
  bool open = true;
};

class Search {
 public:
  Search(const StarMap& map, const StarCells& cells, const Wishes& wishes, double target_m,
         const DirectionCosts& costs, const StarParams& params)
      : map_(map),
        cells_(cells),
        wishes_(wishes),
        costs_(costs),
        params_(params),
        cell_m_(map.geometry.cell_mm / 1000.0),
        near_(std::isfinite(target_m)),
        target_{near_ ? target_m * std::cos(wishes.target) : 0, near_ ? target_m * std::sin(wishes.target) : 0} {}

  std::optional<double> run(const Openings& openings, const SectorMask& selectable) {
    for (const Opening& opening : openings.view()) {
      const Candidates candidates = candidates_of(opening, selectable, wishes_.target, costs_);
      for (const double c : candidates.view())
        step({}, c, direction_cost(c, wishes_, costs_), c);
    }
    while (const Node* next = cheapest_open()) {
      if (next->depth >= params_.depth || is_there(next->at)) return next->first;
      expand(*next);
    }
    return longest();
  }

 private:
  Node* cheapest_open() {
    Node* best = nullptr;
    for (int i = 0; i < count_; ++i) {
      Node& node = nodes_[static_cast<std::size_t>(i)];
      if (node.open && (best == nullptr || better(node, *best))) best = &node;
    }
    if (best != nullptr) best->open = false;
    return best;
  }

  // Equal costs: nearer the target at once, then to the left.
  bool better(const Node& a, const Node& b) const {
    if (std::abs(a.estimate - b.estimate) > kTolerance) return a.estimate < b.estimate;
    const double gain = angle_between(b.first, wishes_.target) - angle_between(a.first, wishes_.target);
    if (std::abs(gain) > kTolerance) return gain > 0;
    return a.first > b.first + kTolerance;
  }

  std::optional<double> longest() const {
    const Node* best = nullptr;
    for (int i = 0; i < count_; ++i) {
      const Node& node = nodes_[static_cast<std::size_t>(i)];
      if (best == nullptr || node.depth > best->depth || (node.depth == best->depth && better(node, *best)))
        best = &node;
    }
    if (best == nullptr) return std::nullopt;
    return best->first;
  }

  bool is_there(const Place& at) const {
    return near_ && std::hypot(target_.x - at.x, target_.y - at.y) <= params_.step_m + kTolerance;
  }
  double target_from(const Place& at) const {
    return near_ ? std::atan2(target_.y - at.y, target_.x - at.x) : wishes_.target;
  }

  void expand(const Node& from) {
    const int rows = static_cast<int>(std::lround(from.at.x / cell_m_));
    const int left = static_cast<int>(std::lround(from.at.y / cell_m_));
    const PolarHistogram histogram = star_histogram(cells_, map_.geometry, map_.table, rows, left);
    SectorMask blocked{};
    SectorMask free{};
    for (std::size_t k = 0; k < kPolarSectors; ++k) {
      blocked[k] = std::cmp_greater(histogram[k], params_.threshold);
      free[k] = !blocked[k];
    }
    const Wishes wishes{.target = target_from(from.at), .heading = from.heading, .previous = from.heading};
    const DirectionCosts costs{.target = costs_.target,
                               .heading = costs_.heading * kProjectedTurn,
                               .previous = costs_.previous * kProjectedTurn,
                               .wide_opening_sectors = costs_.wide_opening_sectors};
    const Openings openings = find_openings(free, blocked);
    for (const Opening& opening : openings.view()) {
      if (opening.count == kPolarSectors && angle_between(wishes.target, from.heading) <= kMostTurn) {
        step(from, wishes.target, direction_cost(wishes.target, wishes, costs), from.first);
        continue;
      }
      const Candidates candidates = candidates_of(opening, free, wishes.target, costs);
      for (const double c : candidates.view())
        if (angle_between(c, from.heading) <= kMostTurn)
          step(from, c, direction_cost(c, wishes, costs), from.first);
    }
  }

  void step(const Node& from, double direction, double cost, double first) {
    if (count_ == kStarNodes || passes_obstacle(from.at, direction)) return;
    Node next;
    next.at = {from.at.x + params_.step_m * std::cos(direction), from.at.y + params_.step_m * std::sin(direction)};
    next.heading = direction;
    next.depth = from.depth + 1;
    next.discount = from.discount * kDiscount;
    next.cost = from.cost + from.discount * cost;
    const double turn = angle_between(target_from(next.at), direction);
    const bool ends = next.depth >= params_.depth || is_there(next.at);
    next.estimate =
        next.cost + (ends ? 0 : next.discount * kProjectedTurn * (costs_.heading + costs_.previous) * turn);
    next.first = first;
    for (int i = 0; i < count_; ++i) {
      Node& other = nodes_[static_cast<std::size_t>(i)];
      if (other.depth != next.depth) continue;
      if (std::hypot(other.at.x - next.at.x, other.at.y - next.at.y) > params_.step_m / 3) continue;
      if (other.open && better(next, other)) other = next;
      return;
    }
    nodes_[static_cast<std::size_t>(count_++)] = next;
  }

  bool passes_obstacle(const Place& from, double direction) const {
    const double forward = std::cos(direction);
    const double left = std::sin(direction);
    const double half_cols = map_.geometry.cols / 2.0;
    for (int i = 0; i < cells_.count; ++i) {
      const StarCells::Cell& cell = cells_.items[static_cast<std::size_t>(i)];
      const double x = (cell.row + 0.5) * cell_m_ - from.x;
      const double y = (half_cols - cell.col - 0.5) * cell_m_ - from.y;
      const double along = std::clamp(x * forward + y * left, 0.0, params_.step_m);
      const double dx = x - along * forward;
      const double dy = y - along * left;
      if (dx * dx + dy * dy < params_.clearance_m * params_.clearance_m) {
        // Away from what is too near already is always a way.
        if (along > 0) return true;
      }
    }
    return false;
  }

  const StarMap& map_;
  const StarCells& cells_;
  const Wishes& wishes_;
  const DirectionCosts& costs_;
  const StarParams& params_;
  double cell_m_;
  bool near_;
  Place target_;
  std::array<Node, kStarNodes> nodes_;
  int count_ = 0;
};

}  // namespace

void find_star_cells(ImageView<const std::uint8_t> type, const GridGeometry& geometry, double radius_m,
                     StarCells& cells) {
  cells.count = 0;
  const double reach = radius_m * 1000 / geometry.cell_mm;
  const auto is_obstacle = [&](int r, int c) {
    return r >= 0 && r < geometry.rows && c >= 0 && c < geometry.cols && type.at(c, r) == kCellObstacle;
  };
  for (int r = 0; r < geometry.rows && r < reach; ++r) {
    for (int c = 0; c < geometry.cols; ++c) {
      if (type.at(c, r) != kCellObstacle) continue;
      if (is_obstacle(r - 1, c) && is_obstacle(r + 1, c) && is_obstacle(r, c - 1) && is_obstacle(r, c + 1))
        continue;
      const double aside = geometry.cols / 2.0 - c - 0.5;
      if ((r + 0.5) * (r + 0.5) + aside * aside > reach * reach) continue;
      if (cells.count == kStarCells) return;
      cells.items[static_cast<std::size_t>(cells.count++)] = {static_cast<std::int16_t>(r),
                                                              static_cast<std::int16_t>(c)};
    }
  }
}

PolarHistogram star_histogram(const StarCells& cells, const GridGeometry& geometry,
                              std::span<const PolarEntry> table, int rows, int left) {
  // Each cell adds its weight at its first sector and takes it back behind its last one.
  std::array<std::uint32_t, 2 * kPolarSectors> change{};
  for (int i = 0; i < cells.count; ++i) {
    const StarCells::Cell& cell = cells.items[static_cast<std::size_t>(i)];
    const int ahead = cell.row - rows;
    const int row = ahead < 0 ? -ahead - 1 : ahead;
    const int col = cell.col + left;
    if (row >= geometry.rows || col < 0 || col >= geometry.cols) continue;
    const PolarEntry& entry = table[static_cast<std::size_t>(row * geometry.cols + col)];
    if (entry.count == 0) continue;
    // What lies behind the place is the mirror image of what lies ahead.
    const int first = ahead < 0 ? wrap_sector(kSectorBehind - entry.first - entry.count + 1) : entry.first;
    change[static_cast<std::size_t>(first)] += entry.weight;
    change[static_cast<std::size_t>(first + entry.count)] -= entry.weight;
  }
  PolarHistogram histogram{};
  std::uint32_t sum = 0;
  for (std::size_t k = 0; k < change.size(); ++k) {
    sum += change[k];
    histogram[k % kPolarSectors] += sum;
  }
  return histogram;
}

PolarHistogram star_histogram(const StarCells& cells, const GridGeometry& geometry, double active_radius_m,
                              double enlargement_m) {
  const double cell_m = geometry.cell_mm / 1000.0;
  PolarHistogram histogram{};
  for (int i = 0; i < cells.count; ++i) {
    const StarCells::Cell& cell = cells.items[static_cast<std::size_t>(i)];
    const double x = (cell.row + 0.5) * cell_m;
    const double y = (geometry.cols - 1 - 2 * cell.col) * cell_m / 2;
    const double share = (x * x + y * y) / (active_radius_m * active_radius_m);
    if (share > 1) continue;
    const auto weight = static_cast<std::uint32_t>(std::lround(kPolarMaxWeight * (1 - share)));
    for (int k = 0; k < kPolarSectors; ++k) {
      const double c = std::cos(sector_centre(k));
      const double s = std::sin(sector_centre(k));
      if (x * c + y * s >= -kTolerance && std::abs(x * s - y * c) <= enlargement_m)
        histogram[sector_index(k)] += weight;
    }
  }
  return histogram;
}

std::optional<double> choose_by_look_ahead(const StarMap& map, const Openings& openings,
                                           const SectorMask& selectable, const Wishes& wishes, double target_m,
                                           const DirectionCosts& costs, const StarParams& params) {
  StarCells cells;
  find_star_cells(map.type, map.geometry, params.active_radius_m + params.step_m * params.depth, cells);
  if (const auto found = Search(map, cells, wishes, target_m, costs, params).run(openings, selectable))
    return found;
  return choose_direction(openings, selectable, wishes, costs);
}

}  // namespace lakshya
