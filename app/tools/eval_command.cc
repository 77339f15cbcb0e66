#include "app/tools/eval_command.h"

#include <spdlog/spdlog.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <iostream>
#include <memory>

#include "app/core/vehicle_config_file.h"
#include "app/core/vehicle_config_keys.h"
#include "app/lakshyad/options.h"
#include "app/tools/evaluation.h"
#include "app/tools/sim/map_judge.h"
#include "app/tools/sim_setup.h"

namespace lakshya {
namespace {

struct EvalOptions {
  PairFiles files;
  std::string format = "pfm";
  int disparities = 0;
  int min_disparity = 0;
  std::vector<std::string> matchers{kMatcherNames.begin(), kMatcherNames.end()};
  std::vector<std::string> against;
  SimOptions sim;  // with configuration and kernels
  bool json = false;
};

// The map of a drive through a simulated world, instead of a pair with ground truth.
void run_world_eval(const EvalOptions& o) {
  const KernelTable kernels = choose_kernels(o.sim.kernels);
  const sim::World world = choose_world(o.sim.world, o.sim.seed);
  std::vector<std::string> names = o.matchers;
  names.insert(names.end(), o.against.begin(), o.against.end());
  for (const std::string& name : names) {
    spdlog::info("{} drives through {}", name, o.sim.world);
    SimOptions options = o.sim;
    const bool is_ours = std::ranges::find(kMatcherNames, name) != kMatcherNames.end();
    (is_ours ? options.matcher : options.sensor) = name;
    const VehicleConfig config = choose_vehicle(options, world.indoor);
    sim::MapJudge judge(world, config, {});
    const sim::RunResult result = run_world(world, config, run_settings(options, o.sim.seed), kernels, &judge);
    nlohmann::ordered_json line{{"world", o.sim.world}, {"seed", o.sim.seed}, {"matcher", name}};
    line.update(judge.json());
    line["drive"] = run_json(result);
    std::cout << line.dump(o.json ? -1 : 2) << '\n';
  }
}

void run_eval(EvalOptions& o) {
  VehicleConfig config = load_vehicle_config(o.sim.config.config, o.sim.config.profile, o.sim.config.sets);
  config.matcher.disparities = round_up_to_16(o.disparities);
  config.matcher.min_disparity = o.min_disparity;
  const KernelTable kernels = choose_kernels(o.sim.kernels);
  o.files.format = parse_ground_truth_format(o.format);
  const GroundTruthPair pair = read_ground_truth_pair(o.files);

  std::vector<std::string> names = o.matchers;
  names.insert(names.end(), o.against.begin(), o.against.end());
  std::vector<Evaluation> results;
  for (const std::string& name : names) {
    spdlog::info("{} of {}: {}", results.size() + 1, names.size(), name);
    results.push_back(evaluate(name, config.matcher, kernels, pair));
  }

  if (!o.json) {
    std::cout << evaluation_table(results);
    return;
  }
  nlohmann::ordered_json rows = nlohmann::ordered_json::array();
  for (const Evaluation& result : results)
    rows.push_back(evaluation_json(result));
  const nlohmann::ordered_json all{{"left", o.files.left},
                                   {"right", o.files.right},
                                   {"gt", o.files.truth},
                                   {"disparities", config.matcher.disparities},
                                   {"min_disparity", config.matcher.min_disparity},
                                   {"results", rows}};
  std::cout << all.dump() << '\n';
}

CLI::Validator ground_truth_format() {
  const auto check = [](const std::string& text) {
    try {
      (void)parse_ground_truth_format(text);
      return std::string();
    } catch (const std::invalid_argument& e) {
      return std::string(e.what());
    }
  };
  return {check, "pfm|kitti|scaled:S"};
}

void add_options(CLI::App& command, EvalOptions& o) {
  CLI::Option* left =
      command.add_option("--left", o.files.left, "Left image of a rectified pair: PNG, PGM, PPM or JPEG, 8 bits")
          ->type_name("FILE");
  add_world_options(command, o.sim)->excludes(left);
  command.add_option("--right", o.files.right, "Right image of the same size")->type_name("FILE");
  command.add_option("--gt", o.files.truth, "Ground truth: disparity of the left image")->type_name("FILE");
  command
      .add_option(
          "--gt-format", o.format,
          "pfm: px, infinite = unknown; kitti: 16-bit PNG of 1/256 px, 0 = unknown; scaled:S: grey PNG of S "
          "levels per px, 0 = unknown")
      ->check(ground_truth_format())
      ->type_name("");
  command.add_option("--mask", o.files.mask, "Image of the same size: only pixels of value 255 count")
      ->type_name("FILE");
  command
      .add_option("--disparities", o.disparities, "Number of disparities searched, rounded up to a multiple of 16")
      ->check(CLI::Range(1, 512));
  command.add_option("--min-disparity", o.min_disparity, "Smallest disparity searched")->check(CLI::Range(0, 1024));
  command.add_option("--matcher", o.matchers, "Our matchers (without: all)")
      ->delimiter(',')
      ->check(CLI::IsMember(std::vector<std::string>{kMatcherNames.begin(), kMatcherNames.end()}));
  const auto peers = opencv_matcher_names();
  command.add_option("--against", o.against, "OpenCV's matchers, for comparison")
      ->delimiter(',')
      ->check(CLI::IsMember(std::vector<std::string>{peers.begin(), peers.end()}));
  add_config_options(command, o.sim.config);
  add_kernel_options(command, o.sim.kernels);
  command.add_flag("--json", o.json, "Print JSON instead of a table");
  command.footer(
      "Rates are over the ground-truth pixels that have an estimate; density is the share that has one; d1 is an "
      "error\n"
      "above 3 px and above 5 %; wrong or missing: no estimate, or an error above 2 px. Counted are the columns "
      "from\n"
      "min-disparity + disparities on (OpenCV leaves the others blank); JSON has the whole image as full_*. Holes "
      "are\n"
      "not filled.\n"
      "Example: lakshya eval --left left.png --right right.png --gt disp.pfm --gt-format pfm --disparities 64\n"
      "           --against opencv-bm,opencv-sgbm,opencv-sgbm-3way");
}

}  // namespace

void add_eval_command(CLI::App& app) {
  auto options = std::make_shared<EvalOptions>();
  CLI::App* command = app.add_subcommand("eval", "Accuracy of the matchers on a pair with ground truth");
  add_options(*command, *options);
  command->callback([options, command] {
    if (!options->sim.world.empty()) return run_world_eval(*options);
    for (const char* name : {"--left", "--right", "--gt", "--gt-format", "--disparities"}) {
      if (command->count(name) == 0) throw CLI::RequiredError(std::string(name) + " (or --world)");
    }
    run_eval(*options);
  });
}

}  // namespace lakshya
