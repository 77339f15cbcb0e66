// A made-up rectified stereo rig whose disparities are known by construction.
#pragma once

#include <algorithm>
#include <cstdint>
#include <random>
#include <sstream>
#include <string>

#include "app/core/image.h"

namespace lakshya::test {

// f = 100 px, B = 0.1 m: f B = 10 px m, so that 8 px are 1.25 m. The centre of projection is the image's.
struct StereoRig {
  static constexpr int kWidth = 160;
  static constexpr int kHeight = 120;
  static constexpr double kCenterV = 59.5;

  static std::string middlebury(double doffs = 0) {
    std::ostringstream text;
    text << "cam0=[100 0 79.5; 0 100 59.5; 0 0 1]\ncam1=[100 0 " << 79.5 + doffs
         << "; 0 100 59.5; 0 0 1]\ndoffs=" << doffs << "\nbaseline=100\nwidth=160\nheight=120\n";
    return text.str();
  }

  // The same rig; `baseline` in whatever unit T shall have.
  static std::string opencv_yaml(const std::string& baseline = "0.1") {
    return "K1: [[100, 0, 79.5], [0, 100, 59.5], [0, 0, 1]]\nK2: [[100, 0, 79.5], [0, 100, 59.5], [0, 0, 1]]\n"
           "R: [1, 0, 0, 0, 1, 0, 0, 0, 1]\nT: [-" +
           baseline + ", 0, 0]\n";
  }
};

struct StereoPair {
  Image<std::uint8_t> left{StereoRig::kWidth, StereoRig::kHeight};
  Image<std::uint8_t> right{StereoRig::kWidth, StereoRig::kHeight};
};

// Random texture, the same every time; every pixel of row v has u_left - u_right = shift_of_row(v), at most 64 px.
template <class ShiftOfRow>
StereoPair textured_pair(ShiftOfRow shift_of_row) {
  constexpr int kMaxShift = 64;
  std::mt19937 random(11);
  std::uniform_int_distribution<int> gray(0, 255);
  StereoPair pair;
  for (int v = 0; v < StereoRig::kHeight; ++v) {
    std::uint8_t texture[StereoRig::kWidth + kMaxShift];
    for (std::uint8_t& texel : texture)
      texel = static_cast<std::uint8_t>(gray(random));
    std::copy_n(texture, StereoRig::kWidth, pair.left.view().row(v));
    std::copy_n(texture + shift_of_row(v), StereoRig::kWidth, pair.right.view().row(v));
  }
  return pair;
}

}  // namespace lakshya::test
