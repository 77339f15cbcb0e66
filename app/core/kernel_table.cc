#include "app/core/kernel_table.h"

#include <string>

#include "app/core/input_error.h"

namespace lakshya {
namespace {

struct KernelName {
  std::string_view name;
  void (*copy)(const KernelTable& from, KernelTable& to);
};

#define LAKSHYA_KERNEL(member)                                                         \
  KernelName {                                                                         \
#member, [](const KernelTable& from, KernelTable& to) { to.member = from.member; } \
  }
constexpr KernelName kKernels[] = {
    LAKSHYA_KERNEL(rectify),          LAKSHYA_KERNEL(census),       LAKSHYA_KERNEL(texture),
    LAKSHYA_KERNEL(edge_sobel),       LAKSHYA_KERNEL(edge_log),     LAKSHYA_KERNEL(sgm),
    LAKSHYA_KERNEL(census_block),     LAKSHYA_KERNEL(sad_block),    LAKSHYA_KERNEL(support),
    LAKSHYA_KERNEL(ground_residuals), LAKSHYA_KERNEL(project_rows), LAKSHYA_KERNEL(score),
    LAKSHYA_KERNEL(polar_histogram),
};
#undef LAKSHYA_KERNEL

constexpr const char* kWhere = "backend";

template <class Entries>
std::string names_of(const Entries& entries) {
  std::string names;
  for (const auto& entry : entries)
    names += (names.empty() ? "" : ", ") + std::string(entry.name);
  return names;
}

// The entry of that name, or a refusal that lists them.
template <class Entries>
const auto& find(const Entries& entries, std::string_view name, const char* kind) {
  for (const auto& entry : entries) {
    if (name == entry.name) return entry;
  }
  throw InputError(kWhere, "there is no " + std::string(kind) + " '" + std::string(name) +
                               "' (there are: " + names_of(entries) + ")");
}

}  // namespace

KernelTable kernels_by_name(std::string_view choice) {
  std::string_view rest = choice;
  const auto next = [&rest] {
    const std::size_t comma = rest.find(',');
    const std::string_view part = rest.substr(0, comma);
    rest = comma == std::string_view::npos ? std::string_view() : rest.substr(comma + 1);
    return part;
  };
  const Backend& main = find(kBackends, next(), "backend");
  KernelTable table = *main.kernels;
  while (!rest.empty()) {
    const std::string_view part = next();
    const std::size_t equals = part.find('=');
    if (equals == std::string_view::npos) {
      throw InputError(kWhere, "'" + std::string(part) + "' is no exception (write kernel=backend: sgm=ref)");
    }
    const KernelName& kernel = find(kKernels, part.substr(0, equals), "kernel");
    const Backend& backend = find(kBackends, part.substr(equals + 1), "backend");
    if (backend.kernels->memory != table.memory) {
      throw InputError(kWhere, std::string(backend.name) + " keeps its buffers elsewhere than " + main.name +
                                   " (choose one of them for all kernels)");
    }
    kernel.copy(*backend.kernels, table);
  }
  return table;
}

}  // namespace lakshya
