#include "app/tools/accuracy_command.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <iostream>
#include <memory>

#include "app/core/file_bytes.h"
#include "app/core/image_file.h"
#include "app/core/input_error.h"
#include "app/core/vehicle_config_file.h"
#include "app/core/vehicle_config_keys.h"
#include "app/lakshyad/options.h"
#include "app/tools/accuracy_report.h"
#include "app/tools/output_folder.h"
#include "app/tools/progress.h"

namespace lakshya {
namespace {

using Json = nlohmann::json;

constexpr std::size_t kMaxListBytes = 1 << 20;

struct AccuracyOptions {
  std::string pairs;
  std::string data;
  std::string out;
  std::vector<std::string> matchers{kMatcherNames.begin(), kMatcherNames.end()};
  std::vector<std::string> against{"opencv-bm", "opencv-sgbm", "opencv-sgbm-3way"};
  ConfigOptions config;
  KernelOptions kernels;
};

struct ListedPair {
  std::string name;
  PairFiles files;
  int disparities = 0;
  int min_disparity = 0;
};

// File names become pictures' names: nothing that leaves the folder.
bool is_plain_name(const std::string& name) {
  return !name.empty() &&
         name.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-_") ==
             std::string::npos;
}

ListedPair listed_pair(const Json& entry, const std::string& data) {
  const auto file = [&](const char* key) { return data + "/" + entry.at(key).get<std::string>(); };
  ListedPair pair;
  pair.name = entry.at("name").get<std::string>();
  if (!is_plain_name(pair.name))
    throw std::invalid_argument("name '" + pair.name + "': letters, digits, - and _ only");
  pair.files = {file("left"), file("right"), file("gt"),
                parse_ground_truth_format(entry.at("gt_format").get<std::string>()),
                entry.contains("mask") ? file("mask") : ""};
  pair.disparities = round_up_to_16(entry.at("disparities").get<int>());
  pair.min_disparity = entry.value("min_disparity", 0);
  if (pair.disparities < 16 || pair.disparities > 512 || pair.min_disparity < 0 || pair.min_disparity > 1024) {
    throw std::invalid_argument(pair.name + ": disparities are 1..512, min_disparity is 0..1024");
  }
  return pair;
}

std::vector<ListedPair> read_list(const AccuracyOptions& o) {
  try {
    const Json list = Json::parse(read_text(o.pairs, kMaxListBytes));
    std::vector<ListedPair> pairs;
    for (const Json& entry : list)
      pairs.push_back(listed_pair(entry, o.data));
    if (pairs.empty()) throw std::invalid_argument("is empty");
    return pairs;
  } catch (const Json::exception& e) {
    throw InputError(o.pairs, std::string("list of pairs: ") + e.what() + " (see perf/accuracy_pairs.json)");
  } catch (const std::invalid_argument& e) {
    throw InputError(o.pairs, std::string("list of pairs: ") + e.what() + " (see perf/accuracy_pairs.json)");
  }
}

void run_accuracy(const AccuracyOptions& o) {
  const VehicleConfig config = load_vehicle_config(o.config.config, o.config.profile, o.config.sets);
  const std::vector<ListedPair> pairs = read_list(o);
  const KernelTable kernels = choose_kernels(o.kernels);
  std::vector<std::string> names = o.matchers;
  names.insert(names.end(), o.against.begin(), o.against.end());
  OutputFolder folder(o.out);
  std::vector<PairResults> results;
  {
    Progress progress(pairs.size() * names.size());
    for (const ListedPair& listed : pairs) {
      const GroundTruthPair pair = read_ground_truth_pair(listed.files);
      MatcherConfig matcher = config.matcher;
      matcher.disparities = listed.disparities;
      matcher.min_disparity = listed.min_disparity;
      PairResults result{listed.name, listed.disparities, {}};
      for (const std::string& name : names) {
        progress.next(listed.name + " " + name);
        result.evaluations.push_back(evaluate(name, matcher, kernels, pair));
      }
      write_png(folder.file("error_" + listed.name + ".png"),
                error_picture(listed.name, pair, result.evaluations).view());
      for (Evaluation& e : result.evaluations)
        e.estimate.disparity = {};
      results.push_back(std::move(result));
    }
  }
  write_png(folder.file("density_bad2.png"), accuracy_plot(results).view());
  write_file_atomically(folder.file("accuracy.md"), accuracy_markdown(results));
  write_file_atomically(folder.file("accuracy.json"), accuracy_json(results));
  folder.commit("");
  std::cout << accuracy_text(results) << "results: " << o.out
            << "/accuracy.md, accuracy.json, density_bad2.png, error_*.png\n";
}

void add_options(CLI::App& command, AccuracyOptions& o) {
  command.add_option("--pairs", o.pairs, "List of pairs (perf/accuracy_pairs.json)")->required()->type_name("FILE");
  command.add_option("--data", o.data, "Folder that the list's file names are relative to")
      ->required()
      ->type_name("FOLDER");
  command.add_option("--out", o.out, "Folder for the results; made when missing")->required();
  command.add_option("--matcher", o.matchers, "Our matchers (without: all)")
      ->delimiter(',')
      ->check(CLI::IsMember(std::vector<std::string>{kMatcherNames.begin(), kMatcherNames.end()}));
  const auto peers = opencv_matcher_names();
  command.add_option("--against", o.against, "OpenCV's matchers (without: all)")
      ->delimiter(',')
      ->check(CLI::IsMember(std::vector<std::string>{peers.begin(), peers.end()}));
  add_config_options(command, o.config);
  add_kernel_options(command, o.kernels);
  command.footer(
      "Writes accuracy.md, accuracy.json, density_bad2.png and a picture of the errors for every pair.\n"
      "Example: lakshya accuracy --pairs perf/accuracy_pairs.json --data DATA --out out/accuracy --set "
      "matcher.paths=5");
}

}  // namespace

void add_accuracy_command(CLI::App& app) {
  auto options = std::make_shared<AccuracyOptions>();
  CLI::App* command = app.add_subcommand("accuracy", "Accuracy of all matchers over many pairs with ground truth");
  add_options(*command, *options);
  command->callback([options] { run_accuracy(*options); });
}

}  // namespace lakshya
