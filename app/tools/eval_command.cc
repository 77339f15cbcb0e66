#include "app/tools/eval_command.h"

#include <spdlog/spdlog.h>

#include <iostream>
#include <memory>

#include "app/core/vehicle_config_file.h"
#include "app/core/vehicle_config_keys.h"
#include "app/lakshyad/options.h"
#include "app/tools/evaluation.h"

namespace lakshya {
namespace {

struct EvalOptions {
  PairFiles files;
  std::string format = "pfm";
  int disparities = 0;
  int min_disparity = 0;
  std::vector<std::string> matchers{kMatcherNames.begin(), kMatcherNames.end()};
  std::vector<std::string> against;
  ConfigOptions config;
  KernelOptions kernels;
  bool json = false;
};

void run_eval(EvalOptions& o) {
  VehicleConfig config = load_vehicle_config(o.config.config, o.config.profile, o.config.sets);
  config.matcher.disparities = round_up_to_16(o.disparities);
  config.matcher.min_disparity = o.min_disparity;
  const KernelTable kernels = choose_kernels(o.kernels);
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
  command.add_option("--left", o.files.left, "Left image of a rectified pair: PNG, PGM, PPM or JPEG, 8 bits")
      ->required()
      ->type_name("FILE");
  command.add_option("--right", o.files.right, "Right image of the same size")->required()->type_name("FILE");
  command.add_option("--gt", o.files.truth, "Ground truth: disparity of the left image")
      ->required()
      ->type_name("FILE");
  command
      .add_option(
          "--gt-format", o.format,
          "pfm: px, infinite = unknown; kitti: 16-bit PNG of 1/256 px, 0 = unknown; scaled:S: grey PNG of S "
          "levels per px, 0 = unknown")
      ->required()
      ->check(ground_truth_format())
      ->type_name("");
  command.add_option("--mask", o.files.mask, "Image of the same size: only pixels of value 255 count")
      ->type_name("FILE");
  command
      .add_option("--disparities", o.disparities, "Number of disparities searched, rounded up to a multiple of 16")
      ->required()
      ->check(CLI::Range(1, 512));
  command.add_option("--min-disparity", o.min_disparity, "Smallest disparity searched")->check(CLI::Range(0, 1024));
  command.add_option("--matcher", o.matchers, "Our matchers (without: all)")
      ->delimiter(',')
      ->check(CLI::IsMember(std::vector<std::string>{kMatcherNames.begin(), kMatcherNames.end()}));
  const auto peers = opencv_matcher_names();
  command.add_option("--against", o.against, "OpenCV's matchers, for comparison")
      ->delimiter(',')
      ->check(CLI::IsMember(std::vector<std::string>{peers.begin(), peers.end()}));
  add_config_options(command, o.config);
  add_kernel_options(command, o.kernels);
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
  command->callback([options] { run_eval(*options); });
}

}  // namespace lakshya
