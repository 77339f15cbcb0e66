// What every matcher searches: shared by the costs, the aggregations and the selection.
#pragma once

namespace lakshya {

// Which raw disparities u_left - u_right a matcher searches, and which columns hold valid descriptors in both
// images.
struct SearchRange {
  int first = 0;         // smallest u_left - u_right; may be negative when doffs > 0
  int disparities = 64;  // number of candidates, a multiple of 16, at most 512
  int valid_begin = 0;   // columns [valid_begin, valid_end) have descriptors
  int valid_end = 0;
};

inline constexpr int kMaxDisparities = 512;

constexpr bool search_range_ok(const SearchRange& r, int width) {
  return r.disparities > 0 && r.disparities <= kMaxDisparities && r.disparities % 16 == 0 && 0 <= r.valid_begin &&
         r.valid_begin <= r.valid_end && r.valid_end <= width && r.first > -32768 && r.first < 32768;
}

}  // namespace lakshya
