#include "app/tools/evaluation.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <sstream>

#include "app/core/image_file.h"
#include "app/core/input_error.h"

namespace lakshya {
namespace {

using Json = nlohmann::ordered_json;

bool is_opencv(const std::string& matcher) {
  const auto names = opencv_matcher_names();
  return std::any_of(names.begin(), names.end(), [&](const char* name) { return matcher == name; });
}

template <class T>
void require_size(const std::string& path, const Image<T>& image, const Image<std::uint8_t>& left) {
  if (image.width() == left.width() && image.height() == left.height()) return;
  const auto size = [](const auto& i) { return std::to_string(i.width()) + "x" + std::to_string(i.height()); };
  throw InputError(path, "image size: " + size(image) + " differs from the left image's " + size(left) +
                             " (give the files of one pair)");
}

Json number(double value) {
  if (!std::isfinite(value)) return nullptr;
  return std::round(value * 1e6) / 1e6;
}

void add_errors(Json& json, const std::string& prefix, const DisparityErrors& e) {
  json[prefix + "gt_pixels"] = e.truth_pixels;
  json[prefix + "density"] = number(e.density);
  json[prefix + "bad1"] = number(e.bad1);
  json[prefix + "bad2"] = number(e.bad2);
  json[prefix + "bad4"] = number(e.bad4);
  json[prefix + "d1"] = number(e.d1);
  json[prefix + "avg_err"] = number(e.average);
  json[prefix + "wrong_or_missing2"] = number(e.wrong_or_missing2);
}

}  // namespace

GroundTruthPair read_ground_truth_pair(const PairFiles& files) {
  GroundTruthPair pair{read_gray(files.left), read_gray(files.right), read_ground_truth(files.truth, files.format)};
  require_size(files.right, pair.right, pair.left);
  require_size(files.truth, pair.truth, pair.left);
  if (!files.mask.empty()) apply_mask(files.mask, pair.truth);
  return pair;
}

Evaluation evaluate(const std::string& matcher, MatcherConfig config, const KernelTable& kernels,
                    const GroundTruthPair& pair) {
  const int blank = config.min_disparity + config.disparities;
  if (blank >= pair.left.width()) {
    throw InputError("search range", std::to_string(blank) + " px are not less than the image's width of " +
                                         std::to_string(pair.left.width()) + " px (search fewer disparities)");
  }
  Evaluation result;
  result.matcher = matcher;
  if (is_opencv(matcher)) {
    result.parameters = opencv_parameters_text(matcher);
    result.estimate = match_pair_opencv(matcher, config.disparities, config.min_disparity, pair.left, pair.right);
  } else {
    config.name = matcher;
    result.parameters = parameters_text(config);
    result.estimate = match_pair(config, kernels, pair.left, pair.right);
  }
  const ImageView<const std::int16_t> disparity = std::as_const(result.estimate.disparity).view();
  result.errors = compare_disparity(disparity, pair.truth.view(), blank);
  result.full = compare_disparity(disparity, pair.truth.view(), 0);
  return result;
}

nlohmann::ordered_json evaluation_json(const Evaluation& evaluation) {
  Json json;
  json["matcher"] = evaluation.matcher;
  add_errors(json, "", evaluation.errors);
  json["ms"] = number(evaluation.estimate.ms);
  add_errors(json, "full_", evaluation.full);
  json["parameters"] = evaluation.parameters;
  return json;
}

std::string evaluation_table(const std::vector<Evaluation>& evaluations) {
  std::ostringstream out;
  out << "matcher              gt pixels  density   bad1   bad2   bad4     d1  avg px  wrong or missing        "
         "ms\n";
  out << std::fixed;
  for (const Evaluation& e : evaluations) {
    const auto percent = [&](double share, int width) {
      out << std::setw(width - 1) << std::setprecision(2) << 100 * share << "%";
    };
    out << std::left << std::setw(18) << e.matcher << std::right << std::setw(12) << e.errors.truth_pixels;
    percent(e.errors.density, 9);
    for (const double share : {e.errors.bad1, e.errors.bad2, e.errors.bad4, e.errors.d1})
      percent(share, 7);
    out << std::setw(8) << std::setprecision(3) << e.errors.average;
    percent(e.errors.wrong_or_missing2, 18);
    out << std::setw(10) << std::setprecision(0) << e.estimate.ms << "\n";
  }
  return out.str();
}

}  // namespace lakshya
