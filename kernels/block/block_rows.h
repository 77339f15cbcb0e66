// Where the vectors of block_simd.cc find what they load: rows of the right image reversed, so that the candidates of a
// pixel lie side by side.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>

#include "kernels/base/scratch.h"
#include "kernels/base/search_range.h"

namespace lakshya {

// Element j of a reversed row is right column column_of(j); candidate i of left column x is element of_column(x) + i.
struct ReversedRow {
  explicit ReversedRow(const SearchRange& r)
      : valid_end(r.valid_end),
        disparities(r.disparities),
        first(r.first),
        size(size_of(r.valid_end - r.valid_begin, r.disparities)),
        inside_begin(std::clamp(-r.first, 0, size)),
        inside_end(std::clamp(r.valid_end - r.valid_begin - r.first, inside_begin, size)) {}

  static int size_of(int width, int candidates) { return width + candidates; }
  int of_column(int x) const { return valid_end - 1 - x; }
  int column_of(int j) const { return valid_end - 1 - first - j; }
  // For every element: all bits in `is_inside` and 0 in `outside` where it has a valid right column, else none and `cost`.
  void mark(std::uint8_t cost, std::span<std::uint8_t> is_inside, std::span<std::uint8_t> outside) const {
    for (std::size_t j = 0; j < is_inside.size(); ++j) {
      const bool inside = static_cast<int>(j) >= inside_begin && static_cast<int>(j) < inside_end;
      is_inside[j] = static_cast<std::uint8_t>(inside ? 255 : 0);
      outside[j] = inside ? std::uint8_t{0} : cost;
    }
  }
  // Columns whose candidates are all in the right image, if there are any: they lie together.
  int whole_begin() const { return valid_end - 1 - inside_end + disparities; }
  int whole_end() const { return valid_end - inside_begin; }

  int valid_end;
  int disparities;
  int first;
  int size;
  int inside_begin;  // elements with a valid right column
  int inside_end;
};

struct SadRows {
  struct Prepared {
    std::span<std::uint32_t> left;  // four times the same edge
    std::span<std::uint8_t> right;
  };
  Prepared enters;
  Prepared leaves;
  std::span<std::uint8_t> zero;
  std::span<std::uint8_t> inside;   // all bits, or none
  std::span<std::uint8_t> outside;  // the outside cost, or 0
  const std::uint32_t* zero32() const { return reinterpret_cast<const std::uint32_t*>(zero.data()); }

  static SadRows lay_out(int width, int disparities, ScratchLayout& scratch) {
    const auto columns = static_cast<std::size_t>(width);
    const auto elements = static_cast<std::size_t>(ReversedRow::size_of(width, disparities));
    SadRows r;
    for (Prepared* p : {&r.enters, &r.leaves}) {
      p->left = scratch.take<std::uint32_t>(columns);
      p->right = scratch.take<std::uint8_t>(elements);
    }
    r.zero = scratch.take<std::uint8_t>(4 * elements);  // also `columns` zeros of 32 bits
    r.inside = scratch.take<std::uint8_t>(elements);
    r.outside = scratch.take<std::uint8_t>(elements);
    return r;
  }
};

struct CensusRows {
  std::span<std::uint8_t> planes;   // four bits of every code of the row that enters
  std::span<std::uint8_t> zero;     // also `width` codes of 0
  std::span<std::uint8_t> inside;   // all bits, or none
  std::span<std::uint8_t> outside;  // the outside cost, or 0
  std::span<std::uint8_t> ring;     // the costs of the window's rows

  static CensusRows lay_out(int width, int disparities, int radius_v, ScratchLayout& scratch) {
    const auto elements = static_cast<std::size_t>(ReversedRow::size_of(width, disparities));
    CensusRows r;
    r.planes = scratch.take<std::uint8_t>(4 * elements);
    r.zero = scratch.take<std::uint8_t>(4 * elements);
    r.inside = scratch.take<std::uint8_t>(elements);
    r.outside = scratch.take<std::uint8_t>(elements);
    r.ring = scratch.take<std::uint8_t>(static_cast<std::size_t>(width) * static_cast<std::size_t>(disparities) *
                                        static_cast<std::size_t>(2 * radius_v + 1));
    return r;
  }
};

}  // namespace lakshya
