// Images for tests: literal pixels, random pixels, padded strides with canaries.
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <initializer_list>
#include <random>
#include <vector>

#include "kernels/base/image_view.h"

namespace lakshya::test {

// An image whose rows are `padding` elements longer than its width; the padding holds a canary.
template <class T>
class PaddedImage {
 public:
  PaddedImage(int width, int height, int padding = 5, T canary = T{77})
      : width_(width),
        height_(height),
        stride_(width + padding),
        canary_(canary),
        data_(static_cast<std::size_t>(stride_) * static_cast<std::size_t>(height), canary) {}

  PaddedImage(int width, int height, std::initializer_list<T> pixels) : PaddedImage(width, height) {
    auto next = pixels.begin();
    for (int v = 0; v < height; ++v) {
      for (int u = 0; u < width; ++u)
        view().at(u, v) = *next++;
    }
  }

  ImageView<T> view() { return {data_.data(), width_, height_, stride_}; }
  ImageView<const T> view() const { return {data_.data(), width_, height_, stride_}; }

  bool canaries_alive() const {
    for (int v = 0; v < height_; ++v) {
      for (int u = width_; u < stride_; ++u) {
        if (view().at(u, v) != canary_) return false;
      }
    }
    return true;
  }

 private:
  int width_;
  int height_;
  int stride_;
  T canary_;
  std::vector<T> data_;
};

// Says where the first difference is.
template <class A, class B>
testing::AssertionResult equal_images(const ImageView<A>& actual, const ImageView<B>& expected) {
  if (!same_size(actual, expected)) return testing::AssertionFailure() << "sizes differ";
  for (int v = 0; v < actual.height; ++v) {
    for (int u = 0; u < actual.width; ++u) {
      if (actual.at(u, v) == expected.at(u, v)) continue;
      return testing::AssertionFailure()
             << "at (" << u << ", " << v << "): " << +actual.at(u, v) << ", expected " << +expected.at(u, v);
    }
  }
  return testing::AssertionSuccess();
}

template <class T>
void fill_random(ImageView<T> image, std::mt19937& random, int low, int high) {
  std::uniform_int_distribution<int> value(low, high);
  for (int v = 0; v < image.height; ++v) {
    for (int u = 0; u < image.width; ++u)
      image.at(u, v) = static_cast<T>(value(random));
  }
}

}  // namespace lakshya::test
