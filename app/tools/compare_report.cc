#include "app/tools/compare_report.h"

#include <algorithm>
#include <iomanip>
#include <set>
#include <sstream>

#include "app/core/vehicle_config_text.h"

namespace lakshya {
namespace {

using Results = std::vector<StageComparison>;
using Json = nlohmann::ordered_json;

constexpr int kStageWidth = 17;
constexpr int kIsaWidth = 10;

// 3, not 3.0: nearly all numbers of the frame are integers.
Json number(double value) {
  const auto whole = static_cast<std::int64_t>(value);
  return static_cast<double>(whole) == value ? Json(whole) : Json(value);
}

std::string verdict(const StageComparison& r) {
  if (r.same_kernels) return "ref";
  if (r.numbers.different > 0) return "DIFFERS";
  return r.status == Status::ok ? "equal" : "refused";
}

std::string difference_text(const StageComparison& r) {
  const Difference& d = *r.numbers.first;
  std::ostringstream text;
  text << r.stage << " on " << r.isa << ": " << d.what << " at (" << d.u << ", " << d.v << ") is "
       << number_text(d.value) << ", reference " << number_text(d.reference) << "; " << r.numbers.different
       << " of " << r.numbers.compared << " differ";
  return text.str();
}

std::vector<std::string> isas_of(const Results& results) {
  std::vector<std::string> isas;
  for (const StageComparison& r : results) {
    if (std::find(isas.begin(), isas.end(), r.isa) == isas.end()) isas.push_back(r.isa);
  }
  return isas;
}

std::string verdict_text(const Results& results) {
  std::set<std::string> stages;
  std::set<std::string> own;
  std::size_t numbers = 0;
  for (const StageComparison& r : results) {
    stages.insert(r.stage);
    if (!r.same_kernels) own.insert(r.stage);
    numbers += r.numbers.compared;
  }
  std::ostringstream text;
  text << own.size() << " of " << stages.size() << " stages compared, " << numbers << " numbers on";
  for (const std::string& isa : isas_of(results))
    text << ' ' << isa;
  return text.str();
}

}  // namespace

nlohmann::ordered_json compare_json(const Results& results) {
  Json list = Json::array();
  for (const StageComparison& r : results) {
    Json json{{"isa", r.isa}, {"stage", r.stage}, {"equal", r.numbers.different == 0}};
    if (const auto& d = r.numbers.first) {
      json["what"] = d->what;
      json["at"] = {d->u, d->v};
      json["reference"] = number(d->reference);
      json["value"] = number(d->value);
      json["different"] = r.numbers.different;
    }
    json["compared"] = r.numbers.compared;
    if (r.same_kernels) json["same_kernels"] = true;
    if (r.status != Status::ok) json["refused"] = to_string(r.status);
    list.push_back(std::move(json));
  }
  return list;
}

std::string compare_table(const Results& results) {
  std::ostringstream out;
  out << std::left << std::setw(kStageWidth) << "stage";
  for (const std::string& isa : isas_of(results))
    out << std::setw(kIsaWidth) << isa;
  std::string stage;
  for (const StageComparison& r : results) {
    if (r.stage != stage) out << '\n' << std::setw(kStageWidth) << (stage = r.stage);
    out << std::setw(kIsaWidth) << verdict(r);
  }
  out << '\n';
  const auto any = [&](const char* word) {
    return std::any_of(results.begin(), results.end(),
                       [&](const StageComparison& r) { return verdict(r) == word; });
  };
  if (any("ref")) out << "(ref: no kernel of its own, the reference runs)\n";
  if (any("refused")) out << "(refused: the reference refuses these parameters)\n";
  for (const StageComparison& r : results) {
    if (r.numbers.first) out << difference_text(r) << '\n';
  }
  out << (all_equal(results) ? "equal: " : "DIFFERS: ") << verdict_text(results) << '\n';
  return out.str();
}

std::string compare_line(const Results& results) {
  const auto differs = std::find_if(results.begin(), results.end(),
                                    [](const StageComparison& r) { return r.numbers.first.has_value(); });
  if (differs == results.end()) return "equal: " + verdict_text(results);
  return "DIFFERS: " + difference_text(*differs);
}

}  // namespace lakshya
