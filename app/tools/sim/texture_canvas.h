// A square picture without borders on which textures are painted: everything wraps around. Start-up only.
#pragma once

#include <cstdint>
#include <vector>

namespace lakshya::sim {

class TextureCanvas {
 public:
  static constexpr int kSide = 512;  // px, a power of two

  TextureCanvas() : pixels_(static_cast<std::size_t>(kSide) * kSide) {}

  float& at(int x, int y) { return pixels_[index(x, y)]; }  // any x, y
  float at(int x, int y) const { return pixels_[index(x, y)]; }
  const std::vector<float>& pixels() const { return pixels_; }

  // Smooth noise in [-amplitude, amplitude] with `cells_x` x `cells_y` lattice points (1..kSide), added.
  void add_noise(int cells_x, int cells_y, float amplitude, std::uint32_t seed);
  // The same with `cells`, 2 `cells`, ... lattice points each way, up to `last`; each octave `decay` times the one before.
  void add_octaves(int cells, int last, float amplitude, float decay, std::uint32_t seed);
  // Every pixel: += amplitude * f(distance to the nearest of the scattered points, to the second nearest, its shade in
  // [-1, 1]); distances in cells. One point in each of cells x cells.
  template <class F>
  void add_stones(int cells, std::uint32_t seed, const F& f);
  // A straight stroke from (x, y), blended over what is there.
  void stroke(float x, float y, float dx, float dy, int length, float value);
  // A filled ellipse with half axes a >= b (px), turned; its rim is `rim` darker, its middle line too.
  void leaf(float x, float y, float a, float b, float angle, float value, float rim);
  void fill(int x, int y, int width, int height, float value);

  // Mean 0.5 and the standard deviation given, clamped to [0, 1].
  void normalize(float deviation);

 private:
  static std::size_t index(int x, int y) {
    constexpr int kMask = kSide - 1;
    return static_cast<std::size_t>((y & kMask) * kSide + (x & kMask));
  }
  struct Nearest {
    float first = 9;
    float second = 9;
    float shade = 0;
  };
  static Nearest nearest_point(const std::vector<float>& points, int cells, float x, float y);
  static std::vector<float> scattered_points(int cells, std::uint32_t seed);

  std::vector<float> pixels_;
};

template <class F>
void TextureCanvas::add_stones(int cells, std::uint32_t seed, const F& f) {
  const std::vector<float> points = scattered_points(cells, seed);
  const float step = static_cast<float>(cells) / kSide;
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide; ++x) {
      const Nearest n = nearest_point(points, cells, static_cast<float>(x) * step, static_cast<float>(y) * step);
      at(x, y) += f(n.first, n.second, n.shade);
    }
  }
}

}  // namespace lakshya::sim
