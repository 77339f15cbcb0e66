// What `lakshya compare` prints.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "app/tools/compare_tables.h"

namespace lakshya {

// [{"isa":..,"stage":..,"equal":true,"compared":N}, ..]; where they differ "equal":false,"what":..,"at":[u,v],
// "reference":..,"value":..,"different":N; "same_kernels":true where both sides are one function, "refused":.. where
// the reference refuses the stage's parameters.
nlohmann::ordered_json compare_json(const std::vector<StageComparison>& results);

// One row per stage, one column per instruction set, then every difference, then the verdict.
std::string compare_table(const std::vector<StageComparison>& results);

// "equal: 9 of 15 stages compared, 123 numbers on avx2 sse4", or "DIFFERS: " and the first difference.
std::string compare_line(const std::vector<StageComparison>& results);

}  // namespace lakshya
