// Window matching: the costs of a rectangular window around the pixel are added up, the least sum wins.
//
//   S(u,v,i) = sum of C(x,y,i) over |x - u| <= radius_u, |y - v| <= radius_v, valid_begin <= x < valid_end, y in
//              descriptor_rows
//
// with C the Hamming distance of census codes or the absolute difference of edges. The window is clipped to the
// pixels that have descriptors, for all candidates alike: they add up the same pixels, so their sums compare. Each
// row then goes through select.h. Source: the paper's SAD matcher; running sums over columns and rows: K. Konolige,
// "Small Vision Systems: Hardware and Implementation", ISRR 1997.
//
// S is uint16 and cannot overflow: parameters are refused whose largest cost times the pixels of the whole window
// exceeds 65535. Census stays below with every window (16 bits x 31 x 31 pixels = 15376). Differences of edges are
// at most 2 edge_cap: up to a cap of 34 every window is accepted, with 63 up to 21 x 21 pixels, with 127 up to
// 15 x 17.
//
// The cost rows in the window are kept in a ring: every cost is computed once, and the row that leaves the column
// sums is subtracted from where it lies. Computing it again instead would save 2 radius_v cost rows of memory and
// take 2.3 ns more per pixel and disparity, where the whole reference takes 8 to 10.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "kernels/base/image_view.h"
#include "kernels/base/search_range.h"
#include "kernels/base/status.h"
#include "kernels/census/census.h"
#include "kernels/select/select.h"

namespace lakshya {

inline constexpr int kMaxBlockRadius = 15;

struct BlockParams {
  SearchRange range;
  SelectParams select;
  int radius_u = 4;   // px, 0..kMaxBlockRadius; the window is 2 radius_u + 1 wide
  int radius_v = 4;   // px, 0..kMaxBlockRadius
  int edge_cap = 31;  // sad only: the cap of the edges, 1..kMaxEdgeCap
};

// Bytes of scratch for one band; independent of the height. radius_v 0..kMaxBlockRadius.
std::size_t block_scratch_bytes(int width, int disparities, int radius_v);

// left, right: census codes (kernels/census) or edges (kernels/edge, 0..2 edge_cap) of the whole images; textured:
// flags of the left image; disparity: int16, 1/16 px or a NoDisparity code, written on `rows` only. All the same
// size. `descriptor_rows` of the images have descriptors; the others become kNotSearched and are in no window.
// `scratch` aligned to 64 bytes. The result of a row does not depend on `rows`: bands give what the whole image
// gives. size_mismatch, bad_argument, scratch_too_small.
Status census_block_ref(ImageView<const CensusCode> left, ImageView<const CensusCode> right,
                        ImageView<const std::uint8_t> textured, Rows descriptor_rows, const BlockParams& params,
                        Rows rows, std::span<std::byte> scratch, ImageView<std::int16_t> disparity);

// Edges above 2 edge_cap are the caller's error: their sums may wrap, the disparities are wrong, nothing else.
Status sad_block_ref(ImageView<const std::uint8_t> left, ImageView<const std::uint8_t> right,
                     ImageView<const std::uint8_t> textured, Rows descriptor_rows, const BlockParams& params,
                     Rows rows, std::span<std::byte> scratch, ImageView<std::int16_t> disparity);

Status census_block_simd(ImageView<const CensusCode> left, ImageView<const CensusCode> right,
                         ImageView<const std::uint8_t> textured, Rows descriptor_rows, const BlockParams& params,
                         Rows rows, std::span<std::byte> scratch, ImageView<std::int16_t> disparity);
Status sad_block_simd(ImageView<const std::uint8_t> left, ImageView<const std::uint8_t> right,
                      ImageView<const std::uint8_t> textured, Rows descriptor_rows, const BlockParams& params,
                      Rows rows, std::span<std::byte> scratch, ImageView<std::int16_t> disparity);
// Its part of block_scratch_bytes.
std::size_t block_simd_scratch_bytes(int width, int disparities, int radius_v);

}  // namespace lakshya
