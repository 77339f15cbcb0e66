#include "app/tools/compare_tables.h"

#include <algorithm>

#include "app/core/input_error.h"
#include "app/tools/compare_stages.h"
#include "kernels/base/isa.h"

namespace lakshya {
namespace {

template <class Names>
std::string joined(const Names& names) {
  std::string text;
  for (const auto& name : names)
    text += (text.empty() ? "" : ", ") + std::string(name);
  return text;
}

// Leaves the best instruction set in use, however the comparison ends.
struct RestoreIsa {
  ~RestoreIsa() { (void)use_isa("best"); }
};

Planes planes_with_status(const CompareStage& stage, const StageOutputs& out) {
  Planes planes{{"status", 1, 1, [&out](int, int) { return static_cast<double>(out.status); }}};
  if (out.status != Status::ok) return planes;
  for (Plane& plane : stage.planes(out))
    planes.push_back(std::move(plane));
  return planes;
}

Comparison run_and_compare(const CompareSetup& setup, const CompareStage& stage, const StageOutputs& expected,
                           const KernelTable& other, const std::string& isa) {
  (void)use_isa(isa);  // one of chosen_isas()
  StageOutputs found;
  stage.run(setup, expected, other, found);
  return compare_planes(planes_with_status(stage, expected), planes_with_status(stage, found));
}

}  // namespace

std::vector<std::string> chosen_isas(const CompareChoice& choice) {
  const std::span<const char* const> all = available_isas();
  if (choice.isa == "all") return {all.begin(), all.end()};
  const RestoreIsa restore;
  if (use_isa(choice.isa) != Status::ok) {
    throw InputError("instruction set",
                     "'" + choice.isa + "' is not to be had here (there are: all, " + joined(all) + ")");
  }
  return {active_isa()};
}

std::vector<std::string> chosen_stages(const CompareChoice& choice) {
  std::vector<std::string> all;
  for (const CompareStage& stage : compare_stages())
    all.emplace_back(stage.name);
  if (choice.stage == "all") return all;
  if (std::find(all.begin(), all.end(), choice.stage) != all.end()) return {choice.stage};
  throw InputError("stage", "there is no '" + choice.stage + "' (there are: all, " + joined(all) + ")");
}

std::vector<StageComparison> compare_tables(const CompareSetup& setup, const KernelTable& reference,
                                            const KernelTable& other, const CompareChoice& choice) {
  const std::vector<std::string> isas = chosen_isas(choice);
  const std::vector<std::string> stages = chosen_stages(choice);
  const RestoreIsa restore;
  std::vector<StageComparison> results;
  StageOutputs expected;
  const auto is_chosen = [&](const CompareStage& stage) {
    return std::find(stages.begin(), stages.end(), stage.name) != stages.end();
  };
  const auto all = compare_stages();
  const auto is_needed = [&](const CompareStage& stage) {
    return is_chosen(stage) || std::any_of(&stage + 1, all.data() + all.size(), [&](const CompareStage& later) {
             return is_chosen(later) && later.reads_earlier;
           });
  };
  for (const CompareStage& stage : all) {
    if (!is_needed(stage)) continue;
    expected.status = Status::ok;
    stage.run(setup, expected, reference, expected);
    if (!is_chosen(stage)) continue;
    for (const std::string& isa : isas) {
      StageComparison result{isa, stage.name, stage.same(reference, other), expected.status, {}};
      if (!result.same_kernels) result.numbers = run_and_compare(setup, stage, expected, other, isa);
      results.push_back(std::move(result));
    }
  }
  return results;
}

bool all_equal(const std::vector<StageComparison>& results) {
  return std::all_of(results.begin(), results.end(),
                     [](const StageComparison& r) { return r.numbers.different == 0; });
}

}  // namespace lakshya
