#include "app/tools/accuracy_report.h"

#include <iomanip>
#include <sstream>

namespace lakshya {
namespace {

using Json = nlohmann::ordered_json;

std::string percent(double share) {
  std::ostringstream out;
  out << std::fixed << std::setprecision(2) << 100 * share;
  return out.str();
}

void add(MatcherMeans& mean, const Evaluation& e, double weight) {
  mean.density += weight * e.errors.density;
  mean.bad1 += weight * e.errors.bad1;
  mean.bad2 += weight * e.errors.bad2;
  mean.bad4 += weight * e.errors.bad4;
  mean.d1 += weight * e.errors.d1;
  mean.wrong_or_missing2 += weight * e.errors.wrong_or_missing2;
  mean.ms += weight * e.estimate.ms;
}

void add_means_table(std::ostream& out, const std::vector<MatcherMeans>& means) {
  out << "| matcher | density % | bad1 % | bad2 % | bad4 % | d1 % | wrong or missing (2 px) % | ms |\n"
      << "|---|---|---|---|---|---|---|---|\n";
  for (const MatcherMeans& m : means) {
    out << "| " << m.matcher << " | ";
    for (const double share : {m.density, m.bad1, m.bad2, m.bad4, m.d1, m.wrong_or_missing2})
      out << percent(share) << " | ";
    out << std::fixed << std::setprecision(0) << m.ms << " |\n";
  }
}

void add_pairs_table(std::ostream& out, const std::vector<PairResults>& results) {
  out << "| pair |";
  for (const Evaluation& e : results.front().evaluations)
    out << " " << e.matcher << " |";
  out << "\n|---|";
  for (std::size_t i = 0; i < results.front().evaluations.size(); ++i)
    out << "---|";
  out << "\n";
  for (const PairResults& pair : results) {
    out << "| " << pair.pair << " |";
    for (const Evaluation& e : pair.evaluations)
      out << " " << percent(e.errors.density) << " / " << percent(e.errors.bad2) << " |";
    out << "\n";
  }
}

}  // namespace

std::vector<MatcherMeans> matcher_means(const std::vector<PairResults>& results) {
  std::vector<MatcherMeans> means;
  for (std::size_t i = 0; i < results.front().evaluations.size(); ++i) {
    const Evaluation& first = results.front().evaluations[i];
    MatcherMeans mean{.matcher = first.matcher, .parameters = first.parameters};
    for (const PairResults& pair : results)
      add(mean, pair.evaluations[i], 1.0 / static_cast<double>(results.size()));
    means.push_back(mean);
  }
  return means;
}

std::string accuracy_json(const std::vector<PairResults>& results) {
  Json all;
  Json means = Json::array();
  for (const MatcherMeans& m : matcher_means(results)) {
    means.push_back({{"matcher", m.matcher},
                     {"density", m.density},
                     {"bad1", m.bad1},
                     {"bad2", m.bad2},
                     {"bad4", m.bad4},
                     {"d1", m.d1},
                     {"wrong_or_missing2", m.wrong_or_missing2},
                     {"ms", m.ms},
                     {"parameters", m.parameters}});
  }
  all["mean"] = means;
  all["pairs"] = Json::array();
  for (const PairResults& pair : results) {
    Json rows = Json::array();
    for (const Evaluation& e : pair.evaluations)
      rows.push_back(evaluation_json(e));
    all["pairs"].push_back({{"pair", pair.pair}, {"disparities", pair.disparities}, {"results", rows}});
  }
  return all.dump(1) + "\n";
}

std::string accuracy_markdown(const std::vector<PairResults>& results) {
  const std::vector<MatcherMeans> means = matcher_means(results);
  std::ostringstream out;
  out << "# Accuracy over " << results.size() << " pairs\n\n"
      << "Columns from min-disparity + disparities on, where ground truth is known. Means weigh every pair the "
         "same.\n\n";
  add_means_table(out, means);
  out << "\n## Density % / bad2 % per pair\n\n";
  add_pairs_table(out, results);
  out << "\n## Parameters\n\n";
  for (const MatcherMeans& m : means)
    out << "- " << m.matcher << ": " << m.parameters << "\n";
  return out.str();
}

std::string accuracy_text(const std::vector<PairResults>& results) {
  std::ostringstream out;
  out << "mean of " << results.size()
      << " pairs    density    bad1    bad2    bad4      d1  wrong or missing        ms\n";
  out << std::fixed;
  for (const MatcherMeans& m : matcher_means(results)) {
    out << std::left << std::setw(18) << m.matcher << std::right;
    const double shares[] = {m.density, m.bad1, m.bad2, m.bad4, m.d1, m.wrong_or_missing2};
    const int widths[] = {8, 7, 7, 7, 7, 17};
    for (int i = 0; i < 6; ++i)
      out << std::setw(widths[i]) << percent(shares[i]) << "%";
    out << std::setw(10) << std::setprecision(0) << m.ms << "\n";
  }
  return out.str();
}

}  // namespace lakshya
