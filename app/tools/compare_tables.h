// Two tables of kernels on the same input, stage by stage: where they first differ.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "app/core/kernel_table.h"
#include "app/tools/compare_planes.h"
#include "app/tools/compare_setup.h"

namespace lakshya {

struct StageComparison {
  std::string isa;
  std::string stage;
  bool same_kernels = false;   // both tables call the same functions: nothing was run
  Status status = Status::ok;  // what the reference returned; unless it is ok, only that was compared
  Comparison numbers;
};

struct CompareChoice {
  std::string isa = "all";
  std::string stage = "all";
};

// The instruction sets and stages chosen, in their order. Throws InputError that names those that exist.
std::vector<std::string> chosen_isas(const CompareChoice& choice);
std::vector<std::string> chosen_stages(const CompareChoice& choice);

// Every chosen stage of `other` on every chosen instruction set, on the inputs that `reference` gives, which runs once.
// By stage, then by instruction set. The instruction set in use afterwards is the best.
std::vector<StageComparison> compare_tables(const CompareSetup& setup, const KernelTable& reference,
                                            const KernelTable& other, const CompareChoice& choice);

bool all_equal(const std::vector<StageComparison>& results);

}  // namespace lakshya
