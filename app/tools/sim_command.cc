#include "app/tools/sim_command.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <memory>
#include <numeric>

#include "app/core/input_error.h"
#include "app/core/vehicle_config_keys.h"
#include "app/loop/real_time.h"
#include "app/tools/progress.h"
#include "app/tools/sim_campaign.h"
#include "app/tools/sim_drive.h"
#include "app/tools/sim_setup.h"

namespace lakshya {
namespace {

using sim::Ending;
using sim::RunResult;

struct CommandOptions {
  SimOptions sim;
  int count = 1;
  int jobs = 1;
  std::string record;
  std::string out;
  std::string results;
  bool json = false;
};

std::string run_text(const RunResult& r) {
  char text[400];
  std::snprintf(text, sizeof text,
                "%s %llu, %s: %s%s%s%s in %.1f s, %.1f m (shortest %.1f m), nearest obstacle %.2f m, %.2f m/s, "
                "%llu false stops, frame %.1f ms (p99 %.1f)",
                r.world.c_str(), static_cast<unsigned long long>(r.seed), r.sensor.c_str(),
                std::string(sim::kEndingNames[static_cast<std::size_t>(r.ending)]).c_str(),
                r.hit.empty() ? "" : " with ", r.hit.c_str(),
                r.excuse.empty() ? "" : (" (" + r.excuse + ")").c_str(), r.time_s, r.path_m, r.shortest_m,
                r.min_clearance_m, r.mean_speed_mps, static_cast<unsigned long long>(r.false_stops), r.frame_ms_p50,
                r.frame_ms_p99);
  return text;
}

void print(const CommandOptions& o, const RunResult& result) {
  std::cout << (o.json ? run_json(result).dump() : run_text(result)) << std::endl;
}

RunResult drive(const CommandOptions& o, std::uint64_t seed, const KernelTable& kernels) {
  const sim::World world = choose_world(o.sim.world, seed);
  VehicleConfig config = choose_vehicle(o.sim, world.indoor);
  if (o.jobs > 1) config.loop.threads = 1;
  RunResult result = run_world(world, config, run_settings(o.sim, seed), kernels);
  result.world = o.sim.world;
  if (!o.record.empty()) record_course(o.record, world, result, config.vehicle.radius_m);
  return result;
}

// With pictures, a film and a status line, in this process.
RunResult watch(const CommandOptions& o, const KernelTable& kernels) {
  const sim::World world = choose_world(o.sim.world, o.sim.seed);
  const VehicleConfig config = choose_vehicle(o.sim, world.indoor);
  RunResult result = watched_drive(o.sim.world, world, config, run_settings(o.sim, o.sim.seed), kernels, o.out);
  if (!o.record.empty()) record_course(o.record, world, result, config.vehicle.radius_m);
  return result;
}

std::vector<RunResult> drive_all(const CommandOptions& o, const KernelTable& kernels) {
  CampaignSettings settings;
  settings.jobs = o.jobs;
  settings.results = o.results;
  settings.seeds.resize(static_cast<std::size_t>(o.count));
  std::iota(settings.seeds.begin(), settings.seeds.end(), o.sim.seed);
  Progress progress(settings.seeds.size());
  return run_campaign(
      settings, o.sim.world, o.sim.sensor, [&](std::uint64_t seed) { return drive(o, seed, kernels); },
      [&](std::size_t done, const RunResult& newest) {
        progress.done(done, "seed " + std::to_string(newest.seed) + " " +
                                std::string(sim::kEndingNames[static_cast<std::size_t>(newest.ending)]));
      });
}

void simulate(const CommandOptions& o) {
  if (!o.out.empty() && o.count > 1)
    throw InputError("--out", "is for one drive, not for --count " + std::to_string(o.count) +
                                  " (--record draws every drive of many)");
  const KernelTable kernels = choose_kernels(o.sim.kernels);
  // Refuses before the long work, not within it.
  (void)choose_vehicle(o.sim, choose_world(o.sim.world, o.sim.seed).indoor);
  if (!o.record.empty()) std::filesystem::create_directories(o.record);
  const std::vector<RunResult> results =
      o.out.empty() ? drive_all(o, kernels) : std::vector<RunResult>{watch(o, kernels)};
  for (const RunResult& result : results)
    print(o, result);
  std::cout << summary_json(results).dump(o.json ? -1 : 2) << '\n';
  if (!o.out.empty() && !o.json) std::cout << "results: " << o.out << "/sheet.png shows everything on one sheet\n";
  if (o.count == 1 && results.front().ending != Ending::reached) throw CLI::RuntimeError(1);
}

}  // namespace

void add_sim_command(CLI::App& app, char** argv) {
  auto o = std::make_shared<CommandOptions>();
  CLI::App* command =
      app.add_subcommand("sim", "The main loop drives a simulated vehicle with rendered stereo cameras");
  add_world_options(*command, o->sim)->required();
  command->add_option("--matcher", o->sim.matcher, "Matching method (matcher.name)")
      ->check(CLI::IsMember(std::vector<std::string>(kMatcherNames.begin(), kMatcherNames.end())));
  command
      ->add_option("--sensor", o->sim.sensor,
                   "What sees: our matcher, OpenCV's, a perfect laser scanner at 0.3 m, or the true depth")
      ->check(CLI::IsMember(std::vector<std::string>(sim::kSensorNames.begin(), sim::kSensorNames.end())))
      ->capture_default_str();
  command->add_option("--planner", o->sim.planner, "Planning method (planner.name)")
      ->check(CLI::IsMember(std::vector<std::string>(kPlannerNames.begin(), kPlannerNames.end())));
  command->add_option("--count", o->count, "So many drives, of seeds one after the other")
      ->check(CLI::Range(1, 100000))
      ->capture_default_str();
  command->add_option("--jobs", o->jobs, "So many drives at a time")
      ->check(CLI::Range(1, 256))
      ->capture_default_str();
  command->add_option("--record", o->record, "A picture of every drive from above, into this folder")
      ->type_name("DIR");
  CLI::Option* out =
      command
          ->add_option(
              "--out", o->out,
              "One drive with everything to look at, into this folder: course.png, sheet.png, drive.webp (a film), "
              "result.json")
          ->type_name("DIR");
  command
      ->add_option("--results", o->results,
                   "A file that keeps every drive's line: drives that are in it are not driven again")
      ->type_name("FILE")
      ->excludes(out);
  command->add_flag("--json", o->json, "Print every drive as a line of JSON, then one with the sums");
  command->footer(
      "Exit code 1: one drive (--count 1) that did not reach its goal, or refused input.\n"
      "Examples: lakshya sim --world random-indoor --seed 1 --out out/drive\n"
      "          lakshya sim --world random-indoor --seed 1 --count 20 --jobs 2 --record out/drives");
  add_config_options(*command, o->sim.config);
  add_kernel_options(*command, o->sim.kernels);
  command->callback([o, argv] {
    require_openmp_settings(argv);
    simulate(*o);
  });
}

}  // namespace lakshya
