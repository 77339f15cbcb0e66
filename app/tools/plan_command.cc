#include "app/tools/plan_command.h"

#include <CLI/CLI.hpp>
#include <iomanip>
#include <iostream>
#include <memory>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "app/core/input_error.h"
#include "app/core/vehicle_config_file.h"
#include "app/core/vehicle_config_keys.h"
#include "app/lakshyad/options.h"
#include "app/nav/planner.h"
#include "app/nav/sectors.h"
#include "app/tools/map_file.h"
#include "app/tools/plan_report.h"

namespace lakshya {
namespace {

constexpr int kSectorsToTheSide = kPolarSectors / 4;

struct PlanOptions {
  std::string grid;
  ConfigOptions config;
  std::string planner;
  double target_deg = 0;
  double heading_deg = 0;
  std::optional<double> previous_deg;
  bool json = false;
};

struct Planned {
  PlannerParams params;
  Plan plan;
};

Planned plan_once(const PlanOptions& options) {
  VehicleConfig config = load_vehicle_config(options.config.config, options.config.profile, options.config.sets);
  if (!options.planner.empty()) config.planner.name = options.planner;
  const MapFile map = read_map(options.grid, config.grid.cell_m);

  std::vector<PolarEntry> table(polar_table_entries(map.geometry));
  Planner planner;
  Status status = planner.configure(config.planner, config.vehicle, map.geometry, table);
  PlanInput input{.target = radians(options.target_deg), .heading = radians(options.heading_deg)};
  if (options.previous_deg) input.previous = radians(*options.previous_deg);
  PlanState state;
  Planned result{.params = config.planner, .plan = {}};
  if (status == Status::ok) status = planner.plan(map.type.view(), input, state, result.plan);
  if (status != Status::ok) {
    throw InputError(options.grid, std::string("plan: ") + to_string(status) +
                                       " (check the planner's radii and the size of the map)");
  }
  return result;
}

std::string plain_text(const Planned& planned) {
  const Plan& plan = planned.plan;
  std::ostringstream out;
  out << std::fixed << std::setprecision(2) << plan_command_text(plan);
  out << "  opening        left deg  right deg\n";
  for (const Opening& opening : plan.openings.view())
    out << std::setw(25) << degrees(opening.left_edge()) << std::setw(11) << degrees(opening.right_edge()) << "\n";
  const Thresholds thresholds = histogram_thresholds(planned.params);
  out << "  sector deg    histogram (free below " << thresholds.low << ", blocked above " << thresholds.high
      << ")\n";
  for (int k = -kSectorsToTheSide; k <= kSectorsToTheSide; ++k) {
    const char* state = !plan.seen[sector_index(k)] ? "unseen" : plan.selectable[sector_index(k)] ? "" : "blocked";
    out << std::setw(12) << k * kPolarSectorDegrees << std::setw(13) << plan.histogram[sector_index(k)];
    if (*state != '\0') out << "  " << state;
    out << "\n";
  }
  return out.str();
}

}  // namespace

void add_plan_command(CLI::App& app) {
  auto options = std::make_shared<PlanOptions>();
  CLI::App* command = app.add_subcommand("plan", "Choose direction and speed on a navigation map");
  command->add_option("--grid", options->grid, "Map: map.json, or PGM with 0 obstacle, 254 free, 205 unknown")
      ->required()
      ->type_name("FILE");
  command->add_option("--target", options->target_deg, "Direction of the way point, to the left of straight ahead")
      ->required()
      ->check(angle_in_degrees());
  command->add_option("--heading", options->heading_deg, "Direction of motion now (without: straight ahead)")
      ->check(angle_in_degrees());
  command->add_option("--previous", options->previous_deg, "Direction chosen last (without: none)")
      ->check(angle_in_degrees());
  add_config_options(*command, options->config);
  command->add_option("--planner", options->planner, "Planning method (without: the configuration's)")
      ->check(CLI::IsMember(std::vector<std::string>(kPlannerNames.begin(), kPlannerNames.end())));
  command->add_flag("--json", options->json, "Print JSON instead of a table");
  command->footer(
      "Angles: degrees counter-clockwise from straight ahead, negative to the right.\n"
      "JSON: direction_deg is null when blocked, recovery_turn says then where to turn. openings are\n"
      "[left, right] edges, histogram has the 37 sectors from -90 to 90; both run from right to left.\n"
      "A PGM's top row is the farthest, its cells are grid.cell_m wide.\n"
      "Example: lakshya plan --grid map.json --target 20 --profile indoor --json");
  command->callback([options] {
    const Planned planned = plan_once(*options);
    std::cout << (options->json ? plan_json(planned.plan, planned.params).dump() + "\n" : plain_text(planned));
  });
}

}  // namespace lakshya
