#include "hal/camera/eye_order.h"

#include <algorithm>
#include <cstdlib>
#include <limits>

namespace lakshya {
namespace {

constexpr int kFlat = 31;  // what a gradient of 0 is stored as
constexpr int kWindowWidth = 16;
constexpr int kWindowHeight = 6;
constexpr int kLeastSide = 32;
constexpr int kMostShift = kEyeSide / 4;  // of u; the reach is a quarter of the image
constexpr int kMostRows = 10;             // of v
constexpr int kRowsAround = 2;            // of v, once it is known how many rows the images are apart
constexpr int kFirstStep = 24;            // from window to window while that is not known
constexpr int kLeastTexture = 4;          // mean absolute gradient of a window
constexpr int kNone = std::numeric_limits<int>::max() / 8;

// When the votes decide, in quarters: the greater count is at least that many times a quarter of the smaller one. Found with
// the real pairs of the data sets (tests/app/core/eye_order_pairs_test.cc prints the votes).
constexpr int kLeastVotes = 20;
constexpr int kLeastPairs = 500;
constexpr int kSidesAlone = 32;      // whatever the rows say
constexpr int kSidesUnopposed = 12;  // unless the rows decide otherwise
constexpr int kRowsAlone = 12;       // where the sides disagree
constexpr int kSidesOfBoth = 6;      // sides and rows for the same order
constexpr int kRowsOfBoth = 5;

int sum_of_differences(const std::uint8_t* a, int a_stride, const std::uint8_t* b, int b_stride) {
  int sum = 0;
  for (int v = 0; v < kWindowHeight; ++v, a += a_stride, b += b_stride) {
    for (int u = 0; u < kWindowWidth; ++u)
      sum += std::abs(a[u] - b[u]);
  }
  return sum;
}

void average_row(ImageView<const std::uint8_t> image, int block, int row, std::span<std::uint8_t> line) {
  const int area = block * block;
  for (std::size_t u = 0; u < line.size(); ++u) {
    int sum = 0;
    for (int y = 0; y < block; ++y) {
      const std::uint8_t* const source = image.row(row * block + y) + u * static_cast<std::size_t>(block);
      for (int x = 0; x < block; ++x)
        sum += source[x];
    }
    line[u] = static_cast<std::uint8_t>(sum / area);
  }
}

}  // namespace

void EyeOrderFinder::reduce(ImageView<const std::uint8_t> image, Reduced& reduced) {
  const int block = (std::max(image.width, image.height) + kEyeSide - 1) / kEyeSide;
  reduced.width = image.width / block;
  reduced.height = image.height / block;
  const auto width = static_cast<std::size_t>(reduced.width);
  reduced.gradient.fill(kFlat);
  const auto line = [&](int v) {
    return std::span(lines_).subspan(static_cast<std::size_t>(v % 3) * kEyeSide, width);
  };
  for (int v = 0; v < reduced.height; ++v) {
    average_row(image, block, v, line(v));
    if (v < 2) continue;
    const auto above = line(v - 2);
    const auto here = line(v - 1);
    const auto below = line(v);
    std::uint8_t* const out = reduced.gradient.data() + static_cast<std::size_t>(v - 1) * width;
    for (std::size_t u = 1; u + 1 < width; ++u) {
      const int sobel = above[u + 1] - above[u - 1] + 2 * (here[u + 1] - here[u - 1]) + below[u + 1] - below[u - 1];
      out[u] = static_cast<std::uint8_t>(kFlat + std::clamp(sobel / 2, -kFlat, kFlat));
    }
  }
}

int EyeOrderFinder::texture(const Reduced& image, Window window) {
  int sum = 0;
  for (int v = 0; v < kWindowHeight; ++v) {
    const std::uint8_t* const row = image.at(window.u, window.v + v);
    for (int u = 0; u < kWindowWidth; ++u)
      sum += std::abs(row[u] - kFlat);
  }
  return sum;
}

EyeOrderFinder::Match EyeOrderFinder::find(const Reduced& from, const Reduced& to, Window window, Rows rows) {
  // Of the best row for each du from -kMostShift to kMostShift.
  std::array<int, 2 * kMostShift + 1> cost_table{};
  std::array<int, 2 * kMostShift + 1> row_table{};
  int* const costs = cost_table.data() + kMostShift;
  int* const best_dv = row_table.data() + kMostShift;
  const int reach = std::min(kMostShift, from.width / 4);
  const int least_du = std::max(-reach, window.u + kWindowWidth - to.width);
  const int most_du = std::min(reach, window.u);
  const int least_dv = std::max(rows.least, -window.v);
  const int most_dv = std::min(rows.most, to.height - kWindowHeight - window.v);
  const std::uint8_t* const here = from.at(window.u, window.v);
  Match best{.cost = kNone, .next_cost = kNone};
  for (int du = least_du; du <= most_du; ++du) {
    costs[du] = kNone;
    for (int dv = least_dv; dv <= most_dv; ++dv) {
      const int cost = sum_of_differences(here, from.width, to.at(window.u - du, window.v + dv), to.width);
      if (cost >= costs[du]) continue;
      costs[du] = cost;
      best_dv[du] = dv;
    }
    if (costs[du] < best.cost) best = {.du = du, .dv = best_dv[du], .cost = costs[du], .next_cost = kNone};
  }
  for (int du = least_du; du <= most_du; ++du) {
    if (std::abs(du - best.du) > 2) {
      best.next_cost = std::min(best.next_cost, costs[du]);
    }
  }
  return best;
}

// Fills moved_ with the windows that were found and came back; their number.
int EyeOrderFinder::collect(int step, Rows rows) {
  const Rows back_rows{-rows.most, -rows.least};
  int count = 0;
  for (int v = 0; v + kWindowHeight <= first_.height; v += step) {
    for (int u = 0; u + kWindowWidth <= first_.width; u += step) {
      const int contrast = texture(first_, {u, v});
      if (contrast < kLeastTexture * kWindowWidth * kWindowHeight) continue;
      const Match there = find(first_, second_, {u, v}, rows);
      if (there.cost * 2 >= contrast || there.cost * 5 >= there.next_cost * 4) continue;
      const Match back = find(second_, first_, {u - there.du, v + there.dv}, back_rows);
      if (std::abs(there.du + back.du) > 1 || std::abs(there.dv + back.dv) > 1) continue;
      moved_[static_cast<std::size_t>(count++)] = {
          static_cast<std::int16_t>(v), static_cast<std::int16_t>(there.du), static_cast<std::int16_t>(there.dv)};
    }
  }
  return count;
}

// The median.
int EyeOrderFinder::rows_apart(int count) {
  if (count == 0) return 0;
  const auto middle = moved_.begin() + count / 2;
  std::nth_element(moved_.begin(), middle, moved_.begin() + count,
                   [](const Moved& a, const Moved& b) { return a.dv < b.dv; });
  return middle->dv;
}

void EyeOrderFinder::vote(int count, EyeVotes& votes) const {
  const std::span<const Moved> all(moved_.data(), static_cast<std::size_t>(count));
  for (const Moved& a : all) {
    ++(a.du > 0 ? votes.left_first : a.du < 0 ? votes.right_first : votes.still);
    for (const Moved& b : all) {  // b is the lower one
      if (b.v - a.v < first_.height / 4 || std::abs(b.du - a.du) < 2) continue;
      ++(b.du > a.du ? votes.lower_left : votes.lower_right);
    }
  }
}

namespace {

struct Majority {
  EyeOrder order = EyeOrder::unsure;
  int quarters = 0;  // how many quarters of the minority it is; large when there is no minority
};

Majority majority(int left, int right, int least) {
  if (left + right < least || left == right) return {};
  const int most = std::max(left, right);
  return {left > right ? EyeOrder::left_first : EyeOrder::right_first,
          4 * most / std::max(std::min(left, right), 1)};
}

EyeOrder decide(const EyeVotes& votes) {
  const Majority sides = majority(votes.left_first, votes.right_first, kLeastVotes);
  const Majority rows = majority(votes.lower_left, votes.lower_right, kLeastPairs);
  if (votes.left_first + votes.right_first < kLeastVotes) return EyeOrder::unsure;
  if (sides.quarters >= kSidesAlone) return sides.order;
  const bool agree = sides.order == rows.order;
  if (agree && sides.quarters >= kSidesOfBoth && rows.quarters >= kRowsOfBoth) return sides.order;
  if (sides.quarters >= kSidesUnopposed) {
    return agree || rows.quarters < kRowsAlone ? sides.order : EyeOrder::unsure;
  }
  return rows.quarters >= kRowsAlone ? rows.order : EyeOrder::unsure;
}

}  // namespace

EyeVotes EyeOrderFinder::look(ImageView<const std::uint8_t> first, ImageView<const std::uint8_t> second) {
  EyeVotes votes;
  if (!same_size(first, second) || first.width < kLeastSide || first.height < kLeastSide) return votes;
  reduce(first, first_);
  reduce(second, second_);
  if (first_.width < kLeastSide || first_.height < kLeastSide) return votes;
  votes.rows_apart = rows_apart(collect(kFirstStep, {-kMostRows, kMostRows}));
  vote(collect(kStep, {votes.rows_apart - kRowsAround, votes.rows_apart + kRowsAround}), votes);
  votes.order = decide(votes);
  return votes;
}

}  // namespace lakshya
