#include "app/tools/sim/map_judge.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "app/tools/sim/walk.h"
#include "kernels/base/units.h"

namespace lakshya::sim {
namespace {

double rounded(double value) {
  return std::round(value * 10000) / 10000;
}

}  // namespace

void MapJudge::on_start(Simulation& simulation, const Machinery& /*machinery*/) {
  simulation_ = &simulation;
  const RectifiedGeometry& camera = simulation.camera();
  rays_ = std::make_unique<RayTable>(rectified_rays(camera));
  depth_ = Image<float>(camera.width, camera.height);
  label_ = Image<std::int16_t>(camera.width, camera.height);
  pixels_.assign(world_->things.size(), 0);
  nearest_.assign(world_->things.size(), 0);
}

void MapJudge::on_frame(const FrameResult& frame, const PlanNote& /*plan*/, const Shot& shot) {
  ++frames_;
  collect_cells(frame.grid, shot);
  judge_cells(shot.walks);
  look(shot);
  judge_things(shot.walks);
}

void MapJudge::collect_cells(const NavGrid& grid, const Shot& shot) {
  const RectifiedGeometry& camera = simulation_->camera();
  const double cell_m = grid.geometry.cell_mm / 1000.0;
  const double c = std::cos(shot.vehicle.yaw);
  const double s = std::sin(shot.vehicle.yaw);
  cells_.clear();
  for (int row = 0; row < grid.geometry.rows; ++row) {
    const double forward = (row + 0.5) * cell_m;
    for (int col = 0; col < grid.geometry.cols; ++col) {
      if (grid.type.at(col, row) != kCellObstacle) continue;
      const double left = (grid.geometry.cols / 2.0 - col - 0.5) * cell_m;
      if (std::hypot(forward, left) > rules_.range_m) continue;
      const double z = std::max(0.0, forward - config_->camera.forward_m);
      const double sigma_z = z * z * config_->prune.disparity_sigma_px / (camera.focal_px * camera.baseline_m);
      Cell cell{.x = shot.vehicle.x + c * forward - s * left, .y = shot.vehicle.y + s * forward + c * left};
      cell.z = ground_height(world_->ground, cell.x, cell.y);
      cell.tolerance_m = cell_m + rules_.sigmas * sigma_z;
      cells_.push_back(cell);
    }
  }
}

void MapJudge::judge_cells(const WalkTimes& when) {
  all_ += cells_.size();
  for (const Cell& cell : cells_) {
    if (is_true(cell, when)) continue;
    ++false_;
    ++false_on_[what_is_at(cell)];
  }
}

bool MapJudge::is_true(const Cell& cell, const WalkTimes& when) const {
  const double floor = std::min(cell.z, 0.0);  // beside a ramp or a platform the lower ground counts, too
  const Nearest nearest =
      truth_.nearest(cell.x, cell.y, floor + rules_.lowest_m, cell.z + config_->prune.clearance_m, when, true);
  if (nearest.distance_m <= cell.tolerance_m) return true;
  if (truth_.dropoff_at(cell.x, cell.y)) return true;
  constexpr int kDirections = 16;
  for (int i = 0; i < kDirections; ++i) {
    const double angle = 2 * std::numbers::pi * i / kDirections;
    if (truth_.dropoff_at(cell.x + cell.tolerance_m * std::cos(angle), cell.y + cell.tolerance_m * std::sin(angle)))
      return true;
  }
  return false;
}

std::string MapJudge::what_is_at(const Cell& cell) const {
  for (const Thing& thing : world_->things) {
    if (thing.expect != Expect::free || thing.walk) continue;
    if (distance(thing, cell, 0) <= cell.tolerance_m) return thing.kind;
  }
  const GroundPatch* patch = patch_at(world_->ground, cell.x, cell.y);
  return patch == nullptr ? "floor" : patch->kind;
}

double MapJudge::distance(const Thing& thing, const Cell& cell, double walked_s) const {
  double x = cell.x;
  double y = cell.y;
  if (thing.walk) {
    const Place at = place_on_walk(*thing.walk, walked_s);
    const double c = std::cos(at.yaw);
    const double s = std::sin(at.yaw);
    x = c * (cell.x - at.x) + s * (cell.y - at.y);
    y = -s * (cell.x - at.x) + c * (cell.y - at.y);
  }
  constexpr double kAnyHeight = 100;
  const double top = thing.expect == Expect::free ? kAnyHeight : cell.z + config_->prune.clearance_m;
  double best = std::numeric_limits<double>::infinity();
  for (const auto& corners : thing.mesh.triangles) {
    const auto corner = [&](std::size_t i) -> Eigen::Vector3d {
      return thing.mesh.vertices[corners[i]].cast<double>();
    };
    best = std::min(best, distance_to_triangle(corner(0), corner(1), corner(2), x, y, -kAnyHeight, top));
  }
  return best;
}

// How much of each thing the camera sees between floor and clearance.
void MapJudge::look(const Shot& shot) {
  const RectifiedGeometry& camera = simulation_->camera();
  simulation_->renderer().set_time(shot.walks);
  simulation_->renderer().depth(*rays_, shot.rectified, false, depth_.view(), label_.view());
  std::ranges::fill(pixels_, 0);
  std::ranges::fill(nearest_, std::numeric_limits<double>::infinity());
  const Eigen::RowVector3d up = shot.rectified.world_from_camera.row(2);
  for (int v = 0; v < camera.height; ++v) {
    for (int u = 0; u < camera.width; ++u) {
      const int thing = label_.view().at(u, v);
      if (thing < 0) continue;
      const double z = static_cast<double>(depth_.view().at(u, v));
      const Eigen::Vector3d ray((u - camera.cx_left) / camera.focal_px, (v - camera.cy) / camera.focal_px, 1);
      const double height = shot.rectified.position.z() + z * up.dot(ray) - shot.vehicle.z;
      if (height < rules_.lowest_m || height > config_->prune.clearance_m) continue;
      ++pixels_[static_cast<std::size_t>(thing)];
      nearest_[static_cast<std::size_t>(thing)] = std::min(nearest_[static_cast<std::size_t>(thing)], z);
    }
  }
}

void MapJudge::judge_things(const WalkTimes& when) {
  const auto least = static_cast<int>(rules_.min_pixels * label_.width() * label_.height());
  for (std::size_t i = 0; i < world_->things.size(); ++i) {
    const Thing& thing = world_->things[i];
    const double distance_m = nearest_[i];
    if (thing.expect != Expect::obstacle || pixels_[i] < least || distance_m >= rules_.range_m) continue;
    const auto bin = std::min(static_cast<std::size_t>(distance_m / kBinWidth), kBins - 1);
    Count& count = recall_[thing.kind][bin];
    ++count.seen;
    const bool found = std::ranges::any_of(
        cells_, [&](const Cell& cell) { return distance(thing, cell, when.of(i)) <= cell.tolerance_m; });
    if (found) ++count.found;
  }
}

nlohmann::ordered_json MapJudge::json() const {
  const auto share = [](std::uint64_t part, std::uint64_t whole) {
    return whole == 0 ? nlohmann::ordered_json(nullptr)
                      : nlohmann::ordered_json(rounded(static_cast<double>(part) / static_cast<double>(whole)));
  };
  nlohmann::ordered_json recall = nlohmann::ordered_json::object();
  for (const auto& [kind, bins] : recall_) {
    nlohmann::ordered_json by_distance;
    for (std::size_t i = 0; i < kBins; ++i) {
      const int from = static_cast<int>(static_cast<double>(i) * kBinWidth);
      const std::string name =
          std::to_string(from) + "-" + std::to_string(from + static_cast<int>(kBinWidth)) + " m";
      by_distance[name] = {{"seen", bins[i].seen}, {"recall", share(bins[i].found, bins[i].seen)}};
    }
    recall[kind] = by_distance;
  }
  return {{"frames", frames_},     {"range_m", rules_.range_m},
          {"cells", all_},         {"precision", share(all_ - false_, all_)},
          {"false_cells", false_}, {"false_cells_per_frame", share(false_, frames_)},
          {"false_on", false_on_}, {"recall", recall}};
}

}  // namespace lakshya::sim
