// A recorded drive over a textured floor, as files: folders left and right, calibration, for programs that are started by tests.
#pragma once

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <random>
#include <string>

#include "app/core/image.h"
#include "app/core/image_file.h"
#include "tests/support/temp_folder.h"

namespace lakshya::test {

// A flat thing that stands on the floor 2 m ahead, seen in these columns of the pairs from `first` on.
struct StandingThing {
  int first = 1'000'000;
  int left_column = 0;
  int right_column = 0;
};

// f = 0.625 px per pixel of width, B = 0.12 m, camera 0.6 m above the floor; no two pairs are the same.
class RecordedRun {
 public:
  RecordedRun(int pairs, int width, int height, const StandingThing& thing = {})
      : width_(width), height_(height), thing_(thing) {
    std::filesystem::create_directories(folder_.path("left"));
    std::filesystem::create_directories(folder_.path("right"));
    const double f = 0.625 * width;
    std::ofstream(folder_.path("calib.txt"))
        << "cam0=[" << f << " 0 " << width / 2 << "; 0 " << f << " " << height / 2 << "; 0 0 1]\ncam1=[" << f
        << " 0 " << width / 2 << "; 0 " << f << " " << height / 2
        << "; 0 0 1]\ndoffs=0\nbaseline=120\nwidth=" << width << "\nheight=" << height << "\n";
    for (int n = 0; n < pairs; ++n)
      add(n);
  }

  std::string path() const { return folder_.path(""); }

  // Pair n is replaced by one of this brightness alone.
  void cover(int n, std::uint8_t brightness) const {
    const Image<std::uint8_t> image(width_, height_, brightness);
    write(n, image, image);
  }
  // Pair n is replaced by a copy of the one before it.
  void freeze(int n) const {
    for (const char* eye : {"left", "right"}) {
      std::filesystem::copy_file(name(eye, n - 1), name(eye, n), std::filesystem::copy_options::overwrite_existing);
    }
  }
  std::string name(const std::string& eye, int n) const {
    std::string number = std::to_string(n);
    return folder_.path(eye) + "/" + std::string(6 - number.size(), '0') + number + ".png";
  }

 private:
  void add(int n) const {
    std::mt19937 random(static_cast<unsigned>(n) + 1);
    Image<std::uint8_t> left(width_, height_);
    Image<std::uint8_t> right(width_, height_);
    constexpr int kMost = 128;
    std::vector<std::uint8_t> texture(static_cast<std::size_t>(width_ + kMost));
    for (int v = 0; v < height_; ++v) {
      for (std::uint8_t& texel : texture)
        texel = static_cast<std::uint8_t>(random() & 0xFFU);
      const int disparity = std::clamp((v - height_ / 2) / 5, 1, kMost);  // (B/H) (v - c_v)
      std::copy_n(texture.begin(), width_, left.view().row(v));
      std::copy_n(texture.begin() + disparity, width_, right.view().row(v));
    }
    if (n >= thing_.first) stand(left, right, random);
    write(n, left, right);
  }

  void stand(Image<std::uint8_t>& left, Image<std::uint8_t>& right, std::mt19937& random) const {
    const int disparity = static_cast<int>(0.625 * width_ * 0.12 / 2.0);
    for (int v = height_ * 2 / 5; v < height_ / 2 + 5 * disparity; ++v) {
      for (int u = thing_.left_column; u < thing_.right_column; ++u) {
        const auto texel = static_cast<std::uint8_t>(random() & 0xFFU);
        left.view().at(u, v) = texel;
        if (u >= disparity) right.view().at(u - disparity, v) = texel;
      }
    }
  }

  void write(int n, const Image<std::uint8_t>& left, const Image<std::uint8_t>& right) const {
    write_png(name("left", n), left.view());
    write_png(name("right", n), right.view());
  }

  TempFolder folder_;
  int width_;
  int height_;
  StandingThing thing_;
};

}  // namespace lakshya::test
