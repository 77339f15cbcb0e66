// Rectified pair to disparity: descriptors, matching band by band, local support. The matchers differ in descriptor
// and aggregation only (docs/contract.md section 2):
//   sgm     census codes, semi-global aggregation
//   census  census codes, square window
//   sad     edges, square window (the paper's)
#pragma once

#include <span>

#include "app/core/arena.h"
#include "app/core/kernel_table.h"
#include "app/core/stage_times.h"
#include "app/core/vehicle_config.h"

namespace lakshya {

// The stored search range (docs/contract.md section 2) as what the kernels want: raw u_left - u_right and its
// offset.
struct StoredRange {
  int first_raw = 0;  // u_left - u_right of the first candidate
  int offset16 = 0;   // doffs in 1/16 px
};
StoredRange stored_range(int min_disparity, double doffs);

// What the kernels are given for a configuration's matcher; `lakshya compare` calls them with the same.
Rows descriptor_rows(const MatcherConfig& config, int height);
SgmParams sgm_params(const MatcherConfig& config, double doffs, int width);
BlockParams block_params(const MatcherConfig& config, double doffs, int width);
SupportParams support_params(const MatcherConfig& config);

class Matcher {
 public:
  // Takes what it needs from the arena; call once to measure and once for real (see arena.h).
  Matcher(const MatcherConfig& config, double doffs, int width, int height, const KernelTable& kernels,
          Arena& arena);

  // left, right: rectified, of the size given above. The result stays valid until the next call.
  // Bands run on OpenMP's threads; the result does not depend on how many there are. With a clock, `times` gets when
  // each pass began.
  Status match(ImageView<const std::uint8_t> left, ImageView<const std::uint8_t> right,
               ImageView<const std::int16_t>& disparity, const Clock* clock = nullptr, MatchTimes* times = nullptr);

 private:
  enum class Method { sgm, census, sad };

  // Codes or edges of one image; the other stays empty.
  struct Descriptors {
    ImageView<CensusCode> codes;
    ImageView<std::uint8_t> edges;
  };

  static Method method_of(const std::string& name);
  Rows band(int index) const;
  Descriptors take_descriptors(int width, Arena& arena) const;
  std::size_t scratch_bytes(int width) const;
  Status describe_band(int index, const ImageView<const std::uint8_t>& image, const Descriptors& out) const;
  int pieces() const;
  Status match_piece(int index, int pieces, const ImageView<const std::uint8_t>& left);

  const KernelTable* kernels_;
  int height_;
  int bands_;
  int texture_threshold_;
  Method method_;
  decltype(&edge_log_ref) edge_;  // sad
  Rows descriptor_rows_;
  SgmParams sgm_;      // sgm
  BlockParams block_;  // census, sad
  SupportParams support_;
  Descriptors left_;
  Descriptors right_;
  ImageView<std::uint8_t> textured_;
  ImageView<std::int16_t> matched_;
  ImageView<std::int16_t> supported_;
  std::span<std::byte> scratch_;  // bands_ equal parts
};

}  // namespace lakshya
