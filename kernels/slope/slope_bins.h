// How the image is cut.
#pragma once

#include <cstdint>

#include "kernels/base/image_view.h"
#include "kernels/slope/slope.h"

namespace lakshya {

struct SlopeBox {
  int left, right, top, bottom;
};

inline SlopeBox slope_box(ImageView<const std::int16_t> image, int strip, int bin) {
  return {image.width * strip / kSlopeStrips, image.width * (strip + 1) / kSlopeStrips,
          image.height * bin / kSlopeBins, image.height * (bin + 1) / kSlopeBins};
}

inline bool has_slope_boxes(ImageView<const std::int16_t> image) {
  return image.width >= kSlopeStrips && image.height >= kSlopeBins;
}

}  // namespace lakshya
