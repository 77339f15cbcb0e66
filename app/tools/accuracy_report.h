// What `lakshya accuracy` writes: table, JSON, plot and error pictures.
#pragma once

#include <string>
#include <vector>

#include "app/tools/evaluation.h"

namespace lakshya {

struct PairResults {
  std::string pair;
  int disparities = 0;
  std::vector<Evaluation> evaluations;  // one per matcher, the same order for every pair; estimates may be empty
};

// Mean over pairs, each pair weighing the same.
struct MatcherMeans {
  std::string matcher;
  std::string parameters;
  double density = 0;
  double bad1 = 0;
  double bad2 = 0;
  double bad4 = 0;
  double d1 = 0;
  double wrong_or_missing2 = 0;
  double ms = 0;
};
std::vector<MatcherMeans> matcher_means(const std::vector<PairResults>& results);

std::string accuracy_json(const std::vector<PairResults>& results);
std::string accuracy_markdown(const std::vector<PairResults>& results);
// Means only, for a terminal.
std::string accuracy_text(const std::vector<PairResults>& results);

// Density against bad2: a small mark per pair, a large one for the mean; better is up and left.
Image<Rgb8> accuracy_plot(const std::vector<PairResults>& results);

// Left image, ground truth, and per matcher the error in colour: green up to 1 px, yellow up to 2, orange up to 4, red
// beyond; black: no estimate; grey: no ground truth.
Image<Rgb8> error_picture(const std::string& title, const GroundTruthPair& pair,
                          const std::vector<Evaluation>& evaluations);

}  // namespace lakshya
