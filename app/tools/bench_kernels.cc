#include "app/tools/bench_kernels.h"

#include <omp.h>

#include <algorithm>
#include <array>

#include "app/tools/bench_subjects.h"
#include "kernels/base/isa.h"
#include "kernels/base/peak.h"

namespace lakshya {
namespace {

// Selecting from sums of bytes: left winner's minimum and place 2, uniqueness 2, right winner's minimum and place 4.
constexpr double kSelectBytes = 8;
// From sums of 16 bits with the place among eight neighbours in their lowest bits: left winner's minimum 1, what is near to
// it 1, right winner's minimum 1 and an eighth of what its place takes, 1.
constexpr double kSelectWords = 8;
// Distance of 16-bit codes: exclusive or 2, population count of bytes 2, their sum 1.
constexpr double kHamming = 5;
// Sum over a window that slides down and right, 16 bits: a row of costs enters the columns and one leaves (2 + 2), a column
// enters the window and one leaves (2 + 2).
constexpr double kWindow = 8;

constexpr KernelWork kWork[] = {
    // Position to address and fractions 6 operations on 32 bits, four products and three sums on 16 bits with the
    // rounding 12: 24 + 24. The map 6, raw and rectified pixel 1 each.
    {"rectify", "sgm", false, 48, 8},
    // 16 comparisons, each maximum, equality, mask and collect: 64. Grey value 1, code 2; both images, so twice.
    {"census", "sgm", false, 2 * 64, 2 * 3},
    // Absolute difference 3, sum over the window in two directions on 16 bits 8, compare 2. Grey value and flag.
    {"texture", "sgm", false, 13, 2},
    // On 16 bits: five kinds of columns, which share four sums of symmetric pixels, 18 products and 19 sums: 41; four
    // sums of symmetric columns and eight of their parts, scale and clamp 3: 15. Grey value and edge; both images.
    {"edge_log", "sad", false, 2 * 112, 2 * 2},
    // Distance; mean over 3x3: sums of three rows 2, of three columns with rounding 2; three paths, each two neighbours'
    // minimum and P1 2, stay 1, jump 1, cost 1, minus the least 1, the new least 1; their sum 2; selection. The rows of
    // distances, path costs and sums do not fit in the first-level cache: distances out 1 and in 2, sum of three rows
    // and cost out 1 and in 1, path from the right out 1 and in 1, path from above in 1 and out 1, sums out 1.
    {"sgm", "sgm", true, kHamming + 4 + 21 + 2 + kSelectBytes, 10},
    // The ring of rows out 1 and in 1, columns in and out 2 + 2; sums stay in the first-level cache.
    {"census_block", "census", true, kHamming + kWindow + kSelectWords, 6},
    // Edges are small enough for a signed difference and its absolute value; that of the row that leaves is found again.
    {"sad_block", "sad", true, 2 * 2 + kWindow + kSelectWords, 4},
    // 81 neighbours on 16 bits: offset, compare, count. Disparity in and out.
    {"support", "sgm", false, 81 * 6, 4},
    // On 16 bits: comparisons 7, masks and class 13: 40. A floor pixel's two ends: four products of 6, four cells of 2,
    // look-up, steps and indices 16: 96; an obstacle's: 24, and its height on 32 bits 9: 84. Of the scene's pixels 42 % are
    // floor and 18 % obstacles: 40 + 40 + 15. Disparity 2, class 1; the rest stays in the first-level cache.
    {"project_rows", "sgm", false, 95, 3},
};

// Stands in a kernel's place in the table and adds up the time it takes. One at a time: see GivenMatch.
template <auto kMember>
class Stopwatch {
 public:
  static void put_into(KernelTable& table) {
    original() = table.*kMember;
    table.*kMember = call;
  }
  static double take_ms() { return static_cast<double>(std::exchange(total(), 0)) * 1e-6; }

 private:
  using Kernel = std::remove_reference_t<decltype(std::declval<KernelTable&>().*kMember)>;
  static Kernel& original() {
    static Kernel kernel = nullptr;
    return kernel;
  }
  static Nanoseconds& total() {
    static Nanoseconds total = 0;
    return total;
  }
  // Deduced from the table's entry, whatever its parameters are.
  template <class... Arguments>
  static Status call(Arguments... arguments) {
    const Clock& clock = bench_clock();
    const Nanoseconds start = clock.now();
    const Status status = original()(arguments...);
    total() += clock.now() - start;
    return status;
  }
};

struct WatchedKernel {
  std::string_view name;
  void (*put_into)(KernelTable& table);
  double (*take_ms)();
};

#define LAKSHYA_WATCHED(member)                                                                        \
  WatchedKernel {                                                                                      \
#member, Stopwatch < &KernelTable::member> ::put_into, Stopwatch < &KernelTable::member> ::take_ms \
  }
const WatchedKernel kWatched[] = {
    LAKSHYA_WATCHED(rectify),   LAKSHYA_WATCHED(census),  LAKSHYA_WATCHED(texture),
    LAKSHYA_WATCHED(edge_log),  LAKSHYA_WATCHED(sgm),     LAKSHYA_WATCHED(census_block),
    LAKSHYA_WATCHED(sad_block), LAKSHYA_WATCHED(support), LAKSHYA_WATCHED(project_rows),
};
#undef LAKSHYA_WATCHED

const WatchedKernel& watched(std::string_view name) {
  return *std::find_if(std::begin(kWatched), std::end(kWatched),
                       [&](const WatchedKernel& k) { return k.name == name; });
}

}  // namespace

std::vector<KernelTime> time_kernels(const BenchSetting& setting, int runs) {
  omp_set_num_threads(1);
  const MatcherConfig& m = setting.config.matcher;
  const BenchInput input = make_bench_input(setting.width, setting.height, m.disparities, setting.pair);
  const double pixels = static_cast<double>(setting.width) * setting.height;
  std::vector<KernelTime> result;
  for (const char* matcher : {"sgm", "census", "sad"}) {
    KernelTable table = setting.kernels;
    for (const WatchedKernel& kernel : kWatched)
      kernel.put_into(table);
    VehicleConfig config = setting.config;
    config.matcher.name = matcher;
    PipelineSubject frame(config, table, input);
    std::array<std::vector<double>, std::size(kWork)> times;
    for (int run = -1; run < runs; ++run) {  // the first one warms up
      (void)frame.run();
      for (std::size_t i = 0; i < std::size(kWork); ++i) {
        if (std::string_view(kWork[i].matcher) != matcher) continue;
        const double ms = watched(kWork[i].name).take_ms();
        if (run >= 0) times[i].push_back(ms);
      }
    }
    for (std::size_t i = 0; i < std::size(kWork); ++i) {
      if (times[i].empty()) continue;
      // Both images are rectified; census and edge_log count them in their operations.
      const double images = std::string_view(kWork[i].name) == "rectify" ? 2 : 1;
      const double items = images * pixels * (kWork[i].per_disparity ? m.disparities : 1);
      result.push_back({active_isa(), kWork[i], median(times[i]), items});
    }
  }
  return result;
}

MachinePeak measure_peak() {
  // Best of many short pieces: a peak is what nothing disturbed.
  const auto best_rate = [](int pieces, const auto& work) {
    const Clock& clock = bench_clock();
    double best = 0;
    for (int i = 0; i < pieces; ++i) {
      const Nanoseconds start = clock.now();
      const PeakWork done = work(i);
      const double seconds = static_cast<double>(std::max<Nanoseconds>(clock.now() - start, 1)) * 1e-9;
      best = std::max(best, static_cast<double>(done.count) / seconds);
    }
    return best;
  };
  constexpr std::int64_t kRounds = 100'000;
  constexpr std::size_t kL2Bytes = 512 << 10;  // more than a first-level, less than a second-level cache
  constexpr std::size_t kMemoryBytes = std::size_t{512} << 20;  // more than any cache, read round and round
  constexpr std::size_t kPiece = std::size_t{8} << 20;
  const std::vector<std::uint8_t> memory(kMemoryBytes, 1);
  const std::span<const std::uint8_t> bytes(memory);
  MachinePeak peak{active_isa()};
  peak.operations_per_s = best_rate(500, [](int /*piece*/) { return peak_operations_simd(kRounds); });
  peak.l2_bytes_per_s = best_rate(5000, [&](int /*piece*/) { return peak_read_simd(bytes.first(kL2Bytes)); });
  peak.memory_bytes_per_s = best_rate(3 * kMemoryBytes / kPiece, [&](int piece) {
    return peak_read_simd(bytes.subspan(static_cast<std::size_t>(piece) * kPiece % kMemoryBytes, kPiece));
  });
  return peak;
}

}  // namespace lakshya
