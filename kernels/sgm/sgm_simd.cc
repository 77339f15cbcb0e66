// The reference's arithmetic on vectors of candidates, row by row: what lies where is in sgm_simd_rows.h.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/sgm/sgm_simd.cc"
#include "hwy/foreach_target.h"
// foreach_target.h comes first, whatever the alphabet says.
#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "hwy/highway.h"
#include "kernels/base/units.h"
#include "kernels/sgm/sgm.h"
#include "kernels/sgm/sgm_cost_simd-inl.h"
#include "kernels/sgm/sgm_input.h"
#include "kernels/sgm/sgm_paths_simd-inl.h"
#include "kernels/sgm/sgm_select_simd-inl.h"
#include "kernels/sgm/sgm_simd_rows.h"
#include "kernels/sgm/sgm_sums_simd-inl.h"

HWY_BEFORE_NAMESPACE();
namespace lakshya {
namespace HWY_NAMESPACE {

// kVectors: vectors per pixel where that is known and no candidate is beyond the disparities, 0: any number.
template <std::size_t kVectors>
class SgmBand {
 public:
  SgmBand(const SgmInput& input, const SgmParams& params, const SgmSimdRows& rows, std::size_t pitch)
      : in_(input),
        p_(params),
        rows_(rows),
        shape_{params.range.valid_begin, params.range.valid_end, pitch, pitch + hn::Lanes(Bytes()),
               pitch / hn::Lanes(Bytes())},
        width_(input.left.width),
        valid_(reversed_range(params.range, input.left.width, static_cast<int>(pitch))),
        hamming_(rows_, width_, params.range.disparities, valid_) {
    clear_rows();
    std::fill(rows_.right_valid.begin() + valid_.begin, rows_.right_valid.begin() + valid_.end, 255);
    std::fill(rows_.right_winner.begin(), rows_.right_winner.end(), kNoRightWinner);
    const auto disparities = static_cast<std::size_t>(params.range.disparities);
    std::fill(rows_.beyond.begin(), rows_.beyond.end(), 255);
    std::fill_n(rows_.beyond.begin(), disparities, 0);
    unique_limits(params.select.uniqueness_percent, limits_);
  }

  void run(Rows span, ImageView<std::int16_t> disparity) {
    const Rows described = in_.descriptor_rows;
    load_distances(std::max(span.begin - 1, described.begin), rows_.hamming[0]);
    load_distances(span.begin, rows_.hamming[1]);
    for (int v = span.begin; v < span.end; ++v) {
      penalties(v, span.begin);
      costs(v);
      sums(v >= in_.rows.begin);
      if (v >= in_.rows.begin) select(v, disparity.row(v));
      std::rotate(rows_.hamming, rows_.hamming + 1, rows_.hamming + 3);
    }
  }

 private:
  // A pixel of zeros is where a path starts: L = C. So are the margins, and the row above the first. The right image's
  // margins count as codes of 0 until their cost is replaced.
  void clear_rows() {
    const auto clear = [](const auto& span) { std::fill(span.begin(), span.end(), 0); };
    clear(rows_.right_codes);
    clear(rows_.right_valid);
    for (const auto& plane : rows_.right_planes)
      clear(plane);
    for (int path = 0; path < (p_.paths == 5 ? kMaxTopPaths : 1); ++path) {
      start_paths(rows_.above[path]);
      start_paths(rows_.current[path]);
      clear(rows_.top_penalty[path]);
    }
    clear(rows_.side_penalty);
    clear(rows_.winner);
    clear(rows_.winner_sums);
    clear(rows_.rivals);
    std::fill(rows_.sums.begin(), rows_.sums.end(), 255);
  }

  void start_paths(std::span<std::uint8_t> row) const {
    std::fill(row.begin(), row.end(), 255);
    for (int u = -1; u <= width_; ++u)
      std::fill_n(row.begin() + static_cast<std::ptrdiff_t>(shape_.spaced_at(u)), p_.range.disparities, 0);
  }

  void load_codes(int v) const {
    left_planes(in_.left.row(v), width_, rows_.left_planes.data());
    right_planes(in_.right.row(v), width_, p_.range.first, valid_, rows_);
  }
  void load_distances(int v, std::span<std::uint8_t> out) const {
    load_codes(v);
    hamming_distances<kVectors>(hamming_, shape_, out.data());
  }

  // P2 of row v's steps.
  void penalties(int v, int first_row) const {
    const int begin = p_.range.valid_begin;
    const int end = p_.range.valid_end;
    const std::uint8_t* here = in_.image.row(v);
    std::uint8_t* side = rows_.side_penalty.data();
    jump_penalties(here + begin + 1, here + begin, end - begin - 1, p_, side + begin + 1);
    if (v == first_row) return;
    const std::uint8_t* above = in_.image.row(v - 1);
    jump_penalties(here + begin, above + begin, end - begin, p_, rows_.top_penalty[0].data() + begin);
    if (p_.paths != 5) return;
    jump_penalties(here + begin + 1, above + begin, end - begin - 1, p_, rows_.top_penalty[1].data() + begin + 1);
    jump_penalties(here + begin, above + begin + 1, end - begin - 1, p_, rows_.top_penalty[2].data() + begin);
  }

  void costs(int v) {
    const bool last = v + 1 == in_.descriptor_rows.end;  // stands in for the one below
    if (!last) load_codes(v + 1);
    const ThreeRows three{rows_.hamming[0].data(), rows_.hamming[1].data(), rows_.hamming[last ? 1 : 2].data()};
    costs_and_leftward_path<kVectors>(hamming_, shape_, rows_, three, last, p_.p1);
  }

  // While a vector of right pixels finds its winners, the sums of the left pixels that can match them are still near.
  void sums(bool wanted) {
    SidePath<kVectors> path(shape_.vectors);
    const int lanes = static_cast<int>(hn::Lanes(Bytes()));
    int done = shape_.begin;
    if (wanted && p_.select.left_right_max >= 0) {
      const int vectors = (valid_.end - valid_.begin + lanes - 1) / lanes;
      for (int i = vectors; i-- > 0;) {
        const RightWinners right(p_.range, width_, shape_, valid_.begin + i * lanes, rows_);
        sums(wanted, done, right.end(), path);
        done = std::max(done, right.end());
        right.find();
      }
      std::fill_n(rows_.right_winner.begin() + valid_.end, kMaxVectorBytes, kNoRightWinner);
    }
    sums(wanted, done, shape_.end, path);
    std::swap_ranges(rows_.above, rows_.above + kMaxTopPaths, rows_.current);
  }
  void sums(bool wanted, int begin, int end, SidePath<kVectors>& path) {
    if (p_.paths == 5) {
      sums_and_winners<kVectors, true>(shape_, rows_, p_.p1, limits_, wanted, begin, end, path);
    } else {
      sums_and_winners<kVectors, false>(shape_, rows_, p_.p1, limits_, wanted, begin, end, path);
    }
  }

  void select(int v, std::int16_t* disparity) const {
    std::fill(disparity, disparity + p_.range.valid_begin, std::int16_t{kNotSearched});
    std::fill(disparity + p_.range.valid_end, disparity + width_, std::int16_t{kNotSearched});
    Decide(p_, width_, rows_).row(in_.textured.row(v), disparity);
  }

  const SgmInput& in_;
  const SgmParams& p_;
  SgmSimdRows rows_;
  RowShape shape_;
  int width_;
  ReversedRange valid_;
  HammingRow hamming_;
  std::uint32_t limits_[256];
};

void sgm_band(const SgmInput& input, const SgmParams& params, const SgmSimdRows& rows, Rows span,
              ImageView<std::int16_t> disparity) {
  const std::size_t lanes = hn::Lanes(Bytes());
  const auto disparities = static_cast<std::size_t>(params.range.disparities);
  const std::size_t pitch = (disparities + lanes - 1) / lanes * lanes;
#if !(HWY_ARCH_ARM && HWY_TARGET != HWY_NEON)
  // Usual numbers, if a pixel's vectors fit the registers.
  constexpr std::size_t kLanes = hn::MaxLanes(Bytes());
  if (disparities == 64) return SgmBand<64 / kLanes>(input, params, rows, pitch).run(span, disparity);
  if constexpr (kLanes >= 32) {
    if (disparities == 128) return SgmBand<128 / kLanes>(input, params, rows, pitch).run(span, disparity);
  }
#endif
  SgmBand<0>(input, params, rows, pitch).run(span, disparity);
}

}  // namespace HWY_NAMESPACE
}  // namespace lakshya
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace lakshya {

HWY_EXPORT(sgm_band);

std::size_t sgm_simd_scratch_bytes(int width, int disparities) {
  ScratchLayout layout;
  lay_out_sgm_simd(width, disparities, layout);
  return layout.used();
}

Status sgm_simd(ImageView<const std::uint8_t> image, ImageView<const CensusCode> left,
                ImageView<const CensusCode> right, ImageView<const std::uint8_t> textured, Rows descriptor_rows,
                const SgmParams& params, Rows rows, std::span<std::byte> scratch,
                ImageView<std::int16_t> disparity) {
  const SgmInput input{image, left, right, textured, descriptor_rows, rows};
  const Status status = check_sgm(input, params, scratch.size(), disparity);
  if (status != Status::ok) return status;
  const bool some_columns = params.range.valid_begin < params.range.valid_end;
  const Rows aggregated = some_columns ? rows_to_aggregate(input, params) : Rows{};
  fill_not_searched(input, aggregated, disparity);
  if (aggregated.begin >= aggregated.end) return Status::ok;
  ScratchLayout layout(scratch.data());
  const SgmSimdRows kept = lay_out_sgm_simd(left.width, params.range.disparities, layout);
  HWY_DYNAMIC_DISPATCH(sgm_band)(input, params, kept, aggregated, disparity);
  return Status::ok;
}

}  // namespace lakshya
#endif
