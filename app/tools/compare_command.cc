#include "app/tools/compare_command.h"

#include <spdlog/spdlog.h>

#include <CLI/CLI.hpp>
#include <iomanip>
#include <iostream>
#include <memory>

#include "app/core/vehicle_config_file.h"
#include "app/lakshyad/options.h"
#include "app/tools/compare_pairs.h"
#include "app/tools/compare_report.h"
#include "app/tools/compare_tables.h"
#include "app/tools/stereo_input.h"

namespace lakshya {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kDiffers = 1;

struct CompareOptions {
  StereoInputOptions input;
  std::vector<std::string> lists;
  std::string data;
  ConfigOptions config;
  CompareChoice choice;
  bool json = false;
};

// The scalar reference against the simd kernels.
std::vector<StageComparison> compare(const StereoInput& input, const VehicleConfig& config,
                                     const CompareChoice& choice) {
  const CompareSetup setup(config, input.calibration, input.left.view(), input.right.view());
  return compare_tables(setup, kReferenceKernels, kSimdKernels, choice);
}

Json pair_json(const std::string& name, const StereoInput& input, const std::vector<StageComparison>& results) {
  Json json;
  if (!name.empty()) json["name"] = name;
  json["left"] = input.left_path;
  json["right"] = input.right_path;
  json["width"] = input.left.width();
  json["height"] = input.left.height();
  json["equal"] = all_equal(results);
  json["results"] = compare_json(results);
  return json;
}

bool compare_one(const CompareOptions& o) {
  const VehicleConfig config = load_vehicle_config(o.config.config, o.config.profile, o.config.sets);
  const StereoInput input = read_stereo_input(o.input, config.camera.calibration_unit_m);
  const std::vector<StageComparison> results = compare(input, config, o.choice);
  if (o.json) {
    std::cout << pair_json("", input, results).dump() << '\n';
  } else {
    std::cout << compare_table(results);
  }
  return all_equal(results);
}

// One line per pair, as each is done.
bool compare_lists(const CompareOptions& o) {
  spdlog::set_level(spdlog::level::warn);  // the lines say which pair it is
  bool equal = true;
  Json all = Json::array();
  for (const std::string& list : o.lists) {
    for (const ComparedPair& pair : read_compared_pairs(list, o.data)) {
      std::vector<std::string> sets = pair.sets;
      sets.insert(sets.end(), o.config.sets.begin(), o.config.sets.end());
      const VehicleConfig config = load_vehicle_config(o.config.config, o.config.profile, sets);
      const StereoInput input = read_compared_pair(pair, config.camera.calibration_unit_m);
      const std::vector<StageComparison> results = compare(input, config, o.choice);
      equal = equal && all_equal(results);
      if (o.json) {
        all.push_back(pair_json(pair.name, input, results));
        continue;
      }
      const std::string size = std::to_string(input.left.width()) + "x" + std::to_string(input.left.height());
      std::cout << std::left << std::setw(20) << pair.name << std::setw(10) << size << std::right << std::setw(4)
                << config.matcher.disparities << "  " << compare_line(results) << std::endl;
    }
  }
  if (o.json) std::cout << Json{{"pairs", all}}.dump() << '\n';
  return equal;
}

void add_options(CLI::App& command, CompareOptions& o) {
  add_stereo_input_options(command, o.input);
  add_config_options(command, o.config);
  command
      .add_option("--isa", o.choice.isa, "Instruction set: all (default) that this machine has, or one: avx2, ...")
      ->type_name("NAME");
  command.add_option("--stage", o.choice.stage, "Stage: all (default), or one: rectify, census, sgm, ..., frame")
      ->type_name("NAME");
  CLI::Option* data = command.add_option("--data", o.data, "Folder that the lists' file names are relative to")
                          ->type_name("FOLDER");
  command
      .add_option("--pairs", o.lists,
                  "List of pairs instead of one pair (perf/compare_pairs.json), one line each; may be repeated")
      ->type_name("FILE")
      ->allow_extra_args(false)
      ->needs(data);
  command.add_flag("--json", o.json, "Print JSON instead of a table");
  command.footer(
      "Runs the scalar reference and the simd kernels on one pair, stage by stage: each stage of the simd kernels "
      "is\n"
      "given what the reference left, so that a difference shows where it arises. All three matchers are run, "
      "whatever\n"
      "matcher.name is; `frame` is the whole pipeline. Exit code 1 when a single number differs.\n"
      "Example: lakshya compare --left left.png --right right.png --calib calib.txt --isa avx2\n"
      "Lists:   lakshya compare --pairs perf/accuracy_pairs.json --pairs perf/compare_pairs.json --data DATA");
}

}  // namespace

void add_compare_command(CLI::App& app) {
  auto options = std::make_shared<CompareOptions>();
  CLI::App* command = app.add_subcommand("compare", "Is the fast path right? Reference and simd, stage by stage");
  add_options(*command, *options);
  command->callback([options] {
    const bool equal = options->lists.empty() ? compare_one(*options) : compare_lists(*options);
    if (!equal) throw CLI::RuntimeError(kDiffers);
  });
}

}  // namespace lakshya
