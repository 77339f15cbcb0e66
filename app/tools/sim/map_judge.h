// How right a frame's map is: its obstacle cells against the true geometry, while a drive goes on.
//
// A cell counts as right when something that must not be touched, or a drop-off, is within the tolerance of its centre:
// tolerance = one cell + sigmas * sigma_z, sigma_z = z^2 sigma_d / (f B) (docs/contract.md section 4). A thing counts as
// seen when at least min_pixels of its pixels between floor and clearance are in the picture; it is found when an obstacle cell is
// within the tolerance of it. Cells and things farther than range_m are left out.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "app/core/image.h"
#include "app/tools/sim/run_world.h"
#include "app/tools/sim/truth.h"

namespace lakshya::sim {

struct JudgeRules {
  double range_m = 6;
  double sigmas = 3;
  double min_pixels = 0.0008;  // share of the picture: 61 of 320x240
  double lowest_m = 0.05;      // of what counts as an obstacle, above the ground
};

class MapJudge final : public Onlooker {
 public:
  MapJudge(const World& world, const VehicleConfig& config, const JudgeRules& rules)
      : world_(&world), config_(&config), rules_(rules), truth_(world) {}

  void on_start(Simulation& simulation, const Machinery& machinery) override;
  void on_frame(const FrameResult& frame, const PlanNote& plan, const Shot& shot) override;

  // {"frames":..,"cells":..,"precision":..,"false_cells_per_frame":..,"false_on":{kind: cells},"recall":{kind: {"0-2 m":..}}}
  nlohmann::ordered_json json() const;

 private:
  static constexpr std::size_t kBins = 3;
  static constexpr double kBinWidth = 2;  // m
  struct Count {
    std::uint64_t seen = 0;
    std::uint64_t found = 0;
  };
  struct Cell {
    double x = 0, y = 0, z = 0;  // world, of its centre on the ground
    double tolerance_m = 0;
  };

  void collect_cells(const NavGrid& grid, const Shot& shot);
  void judge_cells(const WalkTimes& when);
  void look(const Shot& shot);
  void judge_things(const WalkTimes& when);
  bool is_true(const Cell& cell, const WalkTimes& when) const;
  std::string what_is_at(const Cell& cell) const;
  double distance(const Thing& thing, const Cell& cell, double walked_s) const;

  const World* world_;
  const VehicleConfig* config_;
  const JudgeRules rules_;
  TrueGeometry truth_;
  Simulation* simulation_ = nullptr;
  std::unique_ptr<RayTable> rays_;
  Image<float> depth_;
  Image<std::int16_t> label_;
  std::vector<Cell> cells_;      // obstacle cells of this frame
  std::vector<int> pixels_;      // of each thing
  std::vector<double> nearest_;  // depth of each thing, m
  std::uint64_t frames_ = 0;
  std::uint64_t all_ = 0;
  std::uint64_t false_ = 0;
  std::map<std::string, std::uint64_t> false_on_;
  std::map<std::string, std::array<Count, kBins>> recall_;
};

}  // namespace lakshya::sim
