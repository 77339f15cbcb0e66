// The one image type that crosses public headers: a pointer with its shape, owning nothing.
#pragma once

#include <cstddef>
#include <span>
#include <type_traits>

namespace lakshya {

// Row-major image. `stride` counts elements (not bytes) from one row to the next, stride >= width.
template <class T>
struct ImageView {
  T* data = nullptr;
  int width = 0;
  int height = 0;
  std::ptrdiff_t stride = 0;

  constexpr ImageView() = default;
  constexpr ImageView(T* d, int w, int h, std::ptrdiff_t s) : data(d), width(w), height(h), stride(s) {}
  constexpr ImageView(T* d, int w, int h) : ImageView(d, w, h, w) {}

  // A view of T reads as a view of const T.
  template <class U>
  requires(std::is_same_v<const U, T>) constexpr ImageView(
      const ImageView<U>& o)  // NOLINT(google-explicit-constructor)
      : data(o.data), width(o.width), height(o.height), stride(o.stride) {}

  constexpr T* row(int v) const { return data + static_cast<std::ptrdiff_t>(v) * stride; }
  constexpr T& at(int u, int v) const { return row(v)[u]; }
};

template <class A, class B>
constexpr bool same_size(const ImageView<A>& a, const ImageView<B>& b) {
  return a.width == b.width && a.height == b.height;
}

// The pixel, or outside the image the nearest one of its border (the border is repeated). The image is not empty.
template <class T>
constexpr T& at_repeated(const ImageView<T>& image, int u, int v) {
  const int x = u < 0 ? 0 : u < image.width ? u : image.width - 1;
  const int y = v < 0 ? 0 : v < image.height ? v : image.height - 1;
  return image.at(x, y);
}

template <class T>
constexpr std::span<T> row_span(const ImageView<T>& image, int v) {
  return {image.row(v), static_cast<std::size_t>(image.width)};
}

// Half-open range of image rows [begin, end): kernels work on row ranges, threads belong to the pipeline.
struct Rows {
  int begin = 0;
  int end = 0;
};

// Band `index` of `bands` nearly equal ones that make up an image of `height` rows.
constexpr Rows rows_of_band(int height, int bands, int index) {
  return {height * index / bands, height * (index + 1) / bands};
}

template <class T>
constexpr bool rows_inside(const Rows& r, const ImageView<T>& image) {
  return 0 <= r.begin && r.begin <= r.end && r.end <= image.height;
}

}  // namespace lakshya
