// Which of two images the left eye saw, told from what they show, because cables, drivers and byte orders are not to be
// believed. Nearer things lie further to the right in the left image: u_left - u_right > 0.
//
// Both images are reduced to at most kEyeSide px by averaging blocks; a horizontal gradient (Sobel's, a quarter of it, cut at
// +-31) takes the brightness out of them. A window with texture is looked for in the other image, to both sides and some rows
// up and down, and from there back again; one that comes back to its place and was clearly the best votes for the side to
// which it moved. Some windows tell first how many rows the images are apart.
//
// Lenses that squint shift everything, and then far things may vote for the wrong side. Where the votes disagree, the rows
// decide: of two windows the lower one is more often the nearer, because a vehicle stands on its ground.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "kernels/base/image_view.h"

namespace lakshya {

enum class EyeOrder : std::uint8_t { unsure, left_first, right_first };

constexpr const char* to_string(EyeOrder order) {
  if (order == EyeOrder::unsure) return "unsure";
  return order == EyeOrder::left_first ? "left first" : "right first";
}

struct EyeVotes {
  EyeOrder order = EyeOrder::unsure;
  int left_first = 0;   // windows that moved to the left from the first image to the second
  int right_first = 0;  // windows that moved to the right
  int still = 0;        // windows that moved by less than a reduced pixel
  // Pairs of windows far apart in v whose movements differ: the lower one moved more to the left, or to the right.
  int lower_left = 0;
  int lower_right = 0;
  int rows_apart = 0;  // v_second - v_first, reduced pixels
};

inline constexpr int kEyeSide = 320;  // px, longer side of a reduced image, at most

// Its memory, 240 KB, is all that a look needs: nothing is allocated.
class EyeOrderFinder {
 public:
  // Raw or rectified, both of one size, rows up to 10 reduced pixels apart (a reduced pixel: ceil(longer side / kEyeSide)
  // px). Takes 20 to 50 ms on a desktop's core, longer on a small board's: for the start, not for every frame. Sizes that
  // differ or have a side under 32 reduced pixels, and images with too little to see, are unsure.
  EyeVotes look(ImageView<const std::uint8_t> first, ImageView<const std::uint8_t> second);

 private:
  static constexpr int kStep = 8;  // reduced pixels from window to window
  static constexpr int kMostWindows = (kEyeSide / kStep) * (kEyeSide / kStep);

  struct Reduced {
    std::array<std::uint8_t, std::size_t{kEyeSide} * kEyeSide> gradient;  // + 31
    int width = 0;
    int height = 0;
    const std::uint8_t* at(int u, int v) const {
      return gradient.data() + static_cast<std::ptrdiff_t>(v) * width + u;
    }
  };
  struct Window {
    int u = 0;
    int v = 0;
  };
  struct Rows {
    int least = 0;
    int most = 0;
  };
  struct Match {
    int du = 0;  // u_from - u_to
    int dv = 0;  // v_to - v_from
    int cost = 0;
    int next_cost = 0;  // the best more than two pixels away
  };
  struct Moved {
    std::int16_t v = 0;
    std::int16_t du = 0;
    std::int16_t dv = 0;
  };

  void reduce(ImageView<const std::uint8_t> image, Reduced& reduced);
  static int texture(const Reduced& image, Window window);
  static Match find(const Reduced& from, const Reduced& to, Window window, Rows rows);
  int collect(int step, Rows rows);
  int rows_apart(int count);
  void vote(int count, EyeVotes& votes) const;

  Reduced first_;
  Reduced second_;
  std::array<std::uint8_t, std::size_t{kEyeSide} * 3> lines_{};  // three averaged rows
  std::array<Moved, kMostWindows> moved_{};
};

}  // namespace lakshya
