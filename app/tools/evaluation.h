// How well matchers do on pairs with ground truth: one result per pair and matcher, ours and OpenCV's alike.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "app/core/image.h"
#include "app/core/vehicle_config.h"
#include "app/tools/disparity_estimate.h"
#include "app/tools/ground_truth.h"

namespace lakshya {

// What a pair's files hold. `truth` has the images' size.
struct GroundTruthPair {
  Image<std::uint8_t> left;
  Image<std::uint8_t> right;
  Image<float> truth;
};

struct PairFiles {
  std::string left;
  std::string right;
  std::string truth;
  GroundTruthFormat format;
  std::string mask;  // empty: none
};

// Throws InputError: what the readers refuse, and sizes that differ.
GroundTruthPair read_ground_truth_pair(const PairFiles& files);

struct Evaluation {
  std::string matcher;
  std::string parameters;
  // On the columns u >= min_disparity + disparities, the left ones being those that OpenCV leaves blank: filling them
  // must not buy density.
  DisparityErrors errors;
  DisparityErrors full;  // the whole image
  DisparityEstimate estimate;
};

// "sgm", "sad", "census" with `config`, or one of opencv_matcher_names(). The search range is the configuration's for
// all. Throws InputError when the range is not inside the image.
Evaluation evaluate(const std::string& matcher, MatcherConfig config, const KernelTable& kernels,
                    const GroundTruthPair& pair);

// {"matcher":..,"gt_pixels":..,"density":..,...,"full_density":..,...,"ms":..,"parameters":..}; null where no pixel
// has an estimate.
nlohmann::ordered_json evaluation_json(const Evaluation& evaluation);

// "matcher  density  bad1 ...", one line each, rates in percent.
std::string evaluation_table(const std::vector<Evaluation>& evaluations);

}  // namespace lakshya
