#include "app/tools/sim/texture_canvas.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "app/tools/sim/hash.h"

namespace lakshya::sim {
namespace {

// Where a pixel lies between two lattice points, with a smooth step.
struct Between {
  int low;
  int high;
  float weight;  // of `high`
};

std::vector<Between> between_lattice(int cells) {
  std::vector<Between> all;
  all.reserve(TextureCanvas::kSide);
  for (int i = 0; i < TextureCanvas::kSide; ++i) {
    const float at = static_cast<float>(i) * static_cast<float>(cells) / TextureCanvas::kSide;
    const int low = static_cast<int>(at);
    const float t = at - static_cast<float>(low);
    all.push_back({low, (low + 1) % cells, t * t * (3 - 2 * t)});
  }
  return all;
}

std::uint32_t number(int i) {
  return static_cast<std::uint32_t>(i);
}

}  // namespace

void TextureCanvas::add_noise(int cells_x, int cells_y, float amplitude, std::uint32_t seed) {
  const std::vector<Between> across = between_lattice(cells_x);
  const std::vector<Between> down = between_lattice(cells_y);
  const auto lattice_row = [&](int y, std::vector<float>& row) {
    for (int x = 0; x < cells_x; ++x)
      row[static_cast<std::size_t>(x)] = amplitude * (2 * unit_of(hash_of(seed, number(x), number(y))) - 1);
  };
  std::vector<float> low(static_cast<std::size_t>(cells_x));
  std::vector<float> high(low);
  std::vector<float> mixed_row(low);
  int held = -1;
  for (int y = 0; y < kSide; ++y) {
    const Between& b = down[static_cast<std::size_t>(y)];
    if (b.low != held) {
      lattice_row(b.low, low);
      lattice_row(b.high, high);
      held = b.low;
    }
    for (std::size_t i = 0; i < low.size(); ++i)
      mixed_row[i] = low[i] + b.weight * (high[i] - low[i]);
    float* const row = &at(0, y);
    for (int x = 0; x < kSide; ++x) {
      const Between& a = across[static_cast<std::size_t>(x)];
      const float left = mixed_row[static_cast<std::size_t>(a.low)];
      row[x] += left + a.weight * (mixed_row[static_cast<std::size_t>(a.high)] - left);
    }
  }
}

void TextureCanvas::add_octaves(int cells, int last, float amplitude, float decay, std::uint32_t seed) {
  for (; cells <= last; cells *= 2, amplitude *= decay)
    add_noise(cells, cells, amplitude, seed + number(cells));
}

std::vector<float> TextureCanvas::scattered_points(int cells, std::uint32_t seed) {
  std::vector<float> points;
  points.reserve(static_cast<std::size_t>(cells) * static_cast<std::size_t>(cells) * 3);
  for (int i = 0; i < cells * cells; ++i) {
    for (std::uint32_t k = 0; k < 3; ++k)
      points.push_back(unit_of(hash_of(seed, number(i), k)));
  }
  return points;
}

TextureCanvas::Nearest TextureCanvas::nearest_point(const std::vector<float>& points, int cells, float x, float y) {
  Nearest n;
  const int cx = static_cast<int>(x);
  const int cy = static_cast<int>(y);
  for (int j = cy - 1; j <= cy + 1; ++j) {
    for (int i = cx - 1; i <= cx + 1; ++i) {
      const int wrapped = (j + cells) % cells * cells + (i + cells) % cells;
      const float* const p = &points[static_cast<std::size_t>(wrapped) * 3];
      const float dx = static_cast<float>(i) + p[0] - x;
      const float dy = static_cast<float>(j) + p[1] - y;
      const float d = dx * dx + dy * dy;
      if (d < n.first) {
        n = {d, n.first, 2 * p[2] - 1};
      } else {
        n.second = std::min(n.second, d);
      }
    }
  }
  n.first = std::sqrt(n.first);
  n.second = std::sqrt(n.second);
  return n;
}

void TextureCanvas::stroke(float x, float y, float dx, float dy, int length, float value) {
  for (int i = 0; i < length; ++i) {
    const float u = x + dx * static_cast<float>(i);
    const float v = y + dy * static_cast<float>(i);
    const int iu = static_cast<int>(std::floor(u));
    const int iv = static_cast<int>(std::floor(v));
    const float fu = u - static_cast<float>(iu);
    const float fv = v - static_cast<float>(iv);
    const float weights[4] = {(1 - fu) * (1 - fv), fu * (1 - fv), (1 - fu) * fv, fu * fv};
    for (int k = 0; k < 4; ++k) {
      float& p = at(iu + (k & 1), iv + (k >> 1));
      p += weights[k] * (value - p);
    }
  }
}

void TextureCanvas::leaf(float x, float y, float a, float b, float angle, float value, float rim) {
  const float c = std::cos(angle);
  const float s = std::sin(angle);
  const int reach = static_cast<int>(a) + 1;
  const int x0 = static_cast<int>(std::floor(x));
  const int y0 = static_cast<int>(std::floor(y));
  for (int j = -reach; j <= reach; ++j) {
    for (int i = -reach; i <= reach; ++i) {
      const float along = (c * static_cast<float>(i) + s * static_cast<float>(j)) / a;
      const float beside = (c * static_cast<float>(j) - s * static_cast<float>(i)) / b;
      const float width = 1 - along * along;
      if (std::abs(along) >= 1 || std::abs(beside) >= width) continue;
      const float vein = std::abs(beside) < 0.12F ? rim * 0.5F : 0;
      at(x0 + i, y0 + j) = value + 0.2F * beside - rim * (beside * beside) / (width * width) - vein;
    }
  }
}

void TextureCanvas::fill(int x, int y, int width, int height, float value) {
  for (int j = y; j < y + height; ++j) {
    for (int i = x; i < x + width; ++i)
      at(i, j) = value;
  }
}

void TextureCanvas::normalize(float deviation) {
  // Clamping moves both, so they are set a few times.
  for (int round = 0; round < 3; ++round) {
    double sum = 0;
    double squares = 0;
    for (const float p : pixels_) {
      sum += p;
      squares += static_cast<double>(p) * p;
    }
    const double mean = sum / static_cast<double>(pixels_.size());
    const double variance = std::max(squares / static_cast<double>(pixels_.size()) - mean * mean, 1e-12);
    const float factor = deviation / static_cast<float>(std::sqrt(variance));
    for (float& p : pixels_)
      p = std::clamp(0.5F + factor * (p - static_cast<float>(mean)), 0.0F, 1.0F);
  }
}

}  // namespace lakshya::sim
