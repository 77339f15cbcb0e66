#include "app/core/matcher.h"

#include <algorithm>
#include <cmath>

#include "kernels/base/units.h"

namespace lakshya {
namespace {

SgmParams sgm_params(const MatcherConfig& c, double doffs, int width) {
  const StoredRange range = stored_range(c.min_disparity, doffs);
  SgmParams p;
  p.range = {.first = range.first_raw,
             .disparities = c.disparities,
             .valid_begin = std::min(kCensusRadiusU, width),
             .valid_end = std::max(width - kCensusRadiusU, std::min(kCensusRadiusU, width))};
  p.select = {.uniqueness_percent = c.uniqueness_percent,
              .left_right_max = c.left_right_max_px,
              .offset16 = range.offset16};
  p.paths = c.paths;
  p.p1 = c.p1;
  p.p2 = c.p2;
  p.warmup_rows = c.band_warmup_rows;
  return p;
}

SupportParams support_params(const MatcherConfig& c) {
  const int side = 2 * c.support_radius_px + 1;
  return {.radius = c.support_radius_px,
          .min_count = std::max(1, c.support_min_percent * side * side / 100),
          .max_difference = c.support_max_difference};
}

int code(Status s) {
  return static_cast<int>(s);
}

}  // namespace

StoredRange stored_range(int min_disparity, double doffs) {
  const int offset16 = static_cast<int>(std::lround(doffs * kDisparityScale));
  // Rounded down, so that no stored disparity of the range is below min_disparity.
  return {min_disparity - (offset16 >> kDisparityBits), offset16};
}

Matcher::Matcher(const MatcherConfig& config, double doffs, int width, int height, const KernelTable& kernels,
                 Arena& arena)
    : kernels_(&kernels),
      height_(height),
      bands_(config.bands),
      texture_threshold_(config.texture_threshold),
      sgm_(sgm_params(config, doffs, width)),
      support_(support_params(config)),
      census_left_(arena.take_image<std::uint32_t>(width, height)),
      census_right_(arena.take_image<std::uint32_t>(width, height)),
      textured_(arena.take_image<std::uint8_t>(width, height)),
      matched_(arena.take_image<std::int16_t>(width, height)),
      supported_(arena.take_image<std::int16_t>(width, height)),
      scratch_(
          arena.take<std::byte>(static_cast<std::size_t>(bands_) * sgm_scratch_bytes(width, config.disparities))) {}

Rows Matcher::band(int index) const {
  return rows_of_band(height_, bands_, index);
}

Status Matcher::match_band(int index, const ImageView<const std::uint8_t>& left) {
  const Rows rows = band(index);
  Status status = kernels_->texture(left, texture_threshold_, rows, textured_);
  if (status != Status::ok) return status;
  const Rows descriptor_rows{std::min(kCensusRadiusV, height_),
                             std::max(height_ - kCensusRadiusV, std::min(kCensusRadiusV, height_))};
  const std::size_t part = scratch_.size() / static_cast<std::size_t>(bands_);
  return kernels_->sgm(census_left_, census_right_, textured_, descriptor_rows, sgm_, rows,
                       scratch_.subspan(static_cast<std::size_t>(index) * part, part), matched_);
}

Status Matcher::match(ImageView<const std::uint8_t> left, ImageView<const std::uint8_t> right,
                      ImageView<const std::int16_t>& disparity) {
  int worst = code(Status::ok);
  // Three passes, because a band reads its neighbours' codes (warm-up rows) and disparities (support window).
#pragma omp parallel for schedule(dynamic) reduction(max : worst)
  for (int b = 0; b < bands_; ++b) {
    worst = std::max({worst, code(kernels_->census(left, band(b), census_left_)),
                      code(kernels_->census(right, band(b), census_right_))});
  }
#pragma omp parallel for schedule(dynamic) reduction(max : worst)
  for (int b = 0; b < bands_; ++b)
    worst = std::max(worst, code(match_band(b, left)));
#pragma omp parallel for schedule(dynamic) reduction(max : worst)
  for (int b = 0; b < bands_; ++b) {
    worst = std::max(worst, code(kernels_->support(matched_, support_, band(b), supported_)));
  }
  disparity = supported_;
  return static_cast<Status>(worst);
}

}  // namespace lakshya
