#include "app/core/matcher.h"

#include <omp.h>

#include <algorithm>
#include <cmath>

#include "app/core/over_bands.h"
#include "kernels/base/units.h"

namespace lakshya {
namespace {

constexpr const char* kEdgeSobel = "sobel";

// How far from the image's border descriptors begin.
struct Border {
  int u = 0;
  int v = 0;
};

Border border_of(const MatcherConfig& c) {
  if (c.name != "sad") return {};  // census repeats the border
  const int radius = c.edge == kEdgeSobel ? kEdgeSobelRadius : kEdgeLogRadius;
  return {radius, radius};
}

SearchRange search_range(const MatcherConfig& c, double doffs, int width) {
  const int border = std::min(border_of(c).u, width);
  return {.first = stored_range(c.min_disparity, doffs).first_raw,
          .disparities = c.disparities,
          .valid_begin = border,
          .valid_end = std::max(width - border, border)};
}

}  // namespace

Rows descriptor_rows(const MatcherConfig& c, int height) {
  const int border = std::min(border_of(c).v, height);
  return {border, std::max(height - border, border)};
}

namespace {

SelectParams select_params(const MatcherConfig& c, double doffs) {
  return {.uniqueness_percent = c.name == "sgm" ? c.uniqueness_percent : c.window_uniqueness_percent,
          .left_right_max = c.left_right_max_px,
          .offset16 = stored_range(c.min_disparity, doffs).offset16};
}

}  // namespace

SgmParams sgm_params(const MatcherConfig& c, double doffs, int width) {
  SgmParams p;
  p.range = search_range(c, doffs, width);
  p.select = select_params(c, doffs);
  p.paths = c.paths;
  p.p1 = c.p1;
  p.p2 = c.p2;
  p.p2_min = c.p2_min;
  p.p2_slope = c.p2_slope;
  p.warmup_rows = c.band_warmup_rows;
  return p;
}

BlockParams block_params(const MatcherConfig& c, double doffs, int width) {
  return {.range = search_range(c, doffs, width),
          .select = select_params(c, doffs),
          .radius_u = c.window_radius_px,
          .radius_v = c.window_radius_px,
          .edge_cap = c.edge_cap};
}

SupportParams support_params(const MatcherConfig& c) {
  return {.radius = c.support_radius_px,
          .min_percent = c.name == "sgm" ? c.support_min_percent : c.window_support_min_percent,
          .max_difference = c.support_max_difference};
}

StoredRange stored_range(int min_disparity, double doffs) {
  const int offset16 = static_cast<int>(std::lround(doffs * kDisparityScale));
  // Rounded down, so that no stored disparity of the range is below min_disparity.
  return {min_disparity - (offset16 >> kDisparityBits), offset16};
}

Matcher::Method Matcher::method_of(const std::string& name) {
  if (name == "sad") return Method::sad;
  return name == "census" ? Method::census : Method::sgm;
}

Matcher::Matcher(const MatcherConfig& config, double doffs, int width, int height, const KernelTable& kernels,
                 Arena& arena)
    : kernels_(&kernels),
      height_(height),
      bands_(config.bands),
      texture_threshold_(config.texture_threshold),
      method_(method_of(config.name)),
      edge_(config.edge == kEdgeSobel ? kernels.edge_sobel : kernels.edge_log),
      descriptor_rows_(descriptor_rows(config, height)),
      sgm_(sgm_params(config, doffs, width)),
      block_(block_params(config, doffs, width)),
      support_(support_params(config)),
      left_(take_descriptors(width, arena)),
      right_(take_descriptors(width, arena)),
      textured_(arena.take_image<std::uint8_t>(width, height)),
      matched_(arena.take_image<std::int16_t>(width, height)),
      supported_(arena.take_image<std::int16_t>(width, height)),
      scratch_(arena.take<std::byte>(static_cast<std::size_t>(bands_) * scratch_bytes(width))) {}

Matcher::Descriptors Matcher::take_descriptors(int width, Arena& arena) const {
  Descriptors d;
  if (method_ == Method::sad) {
    d.edges = arena.take_image<std::uint8_t>(width, height_);
  } else {
    d.codes = arena.take_image<CensusCode>(width, height_);
  }
  return d;
}

std::size_t Matcher::scratch_bytes(int width) const {
  if (method_ == Method::sgm) return sgm_scratch_bytes(width, sgm_.range.disparities);
  return block_scratch_bytes(width, block_.range.disparities, block_.radius_v);
}

Rows Matcher::band(int index) const {
  return rows_of_band(height_, bands_, index);
}

// Rows that are matched together: bands where the result depends on them. A window's does not, and every piece starts
// with the rows of its window, so there are as few of them as occupy the threads.
int Matcher::pieces() const {
  return method_ == Method::sgm ? bands_ : std::min(bands_, omp_get_max_threads());
}

Status Matcher::describe_band(int index, const ImageView<const std::uint8_t>& image, const Descriptors& out) const {
  if (method_ == Method::sad) return edge_(image, block_.edge_cap, band(index), out.edges);
  return kernels_->census(image, band(index), out.codes);
}

Status Matcher::match_piece(int index, int pieces, const ImageView<const std::uint8_t>& left) {
  const Rows rows = rows_of_band(height_, pieces, index);
  const Status status = kernels_->texture(left, texture_threshold_, rows, textured_);
  if (status != Status::ok) return status;
  const std::size_t part = scratch_.size() / static_cast<std::size_t>(bands_);
  const std::span<std::byte> scratch = scratch_.subspan(static_cast<std::size_t>(index) * part, part);
  switch (method_) {
    case Method::sad:
      return kernels_->sad_block(left_.edges, right_.edges, textured_, descriptor_rows_, block_, rows, scratch,
                                 matched_);
    case Method::census:
      return kernels_->census_block(left_.codes, right_.codes, textured_, descriptor_rows_, block_, rows, scratch,
                                    matched_);
    case Method::sgm:
      break;
  }
  return kernels_->sgm(left, left_.codes, right_.codes, textured_, descriptor_rows_, sgm_, rows, scratch, matched_);
}

Status Matcher::match(ImageView<const std::uint8_t> left, ImageView<const std::uint8_t> right,
                      ImageView<const std::int16_t>& disparity, const Clock* clock, MatchTimes* times) {
  const auto mark = [&](std::size_t pass) {
    if (clock != nullptr) times->at[pass] = clock->now();
  };
  mark(0);
  // Three passes, because a band reads its neighbours' descriptors (warm-up rows, window) and disparities (support window).
  const Status described = over_bands(
      bands_, [&](int b) { return std::max(describe_band(b, left, left_), describe_band(b, right, right_)); });
  mark(1);
  const int count = pieces();
  const Status searched = over_bands(count, [&](int i) { return match_piece(i, count, left); });
  mark(2);
  const Status supported =
      over_bands(bands_, [&](int b) { return kernels_->support(matched_, support_, band(b), supported_); });
  mark(3);
  disparity = supported_;
  return std::max({described, searched, supported});
}

}  // namespace lakshya
