#include "app/tools/sim/texture_painters.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "app/tools/sim/hash.h"

namespace lakshya::sim {
namespace {

constexpr int kSide = TextureCanvas::kSide;
constexpr float kPi = std::numbers::pi_v<float>;

// A sequence of chances for one painter.
class Dice {
 public:
  explicit Dice(std::uint32_t seed) : seed_(seed) {}
  float unit() { return unit_of(hash_of(seed_, ++count_)); }
  float between(float low, float high) { return low + (high - low) * unit(); }
  int below(int n) { return std::min(n - 1, static_cast<int>(unit() * static_cast<float>(n))); }

 private:
  std::uint32_t seed_;
  std::uint32_t count_ = 0;
};

float shade_of(int i, int j, std::uint32_t seed) {
  return 2 * unit_of(hash_of(seed, static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(j))) - 1;
}

template <class F>
void add_everywhere(TextureCanvas& c, const F& f) {
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide; ++x)
      c.at(x, y) += f(x, y);
  }
}

void specks(TextureCanvas& c, std::uint32_t seed, int count, float radius, float low, float high) {
  Dice dice(seed);
  for (int i = 0; i < count; ++i) {
    const float x = dice.between(0, kSide);
    const float y = dice.between(0, kSide);
    const float r = radius * dice.between(0.6F, 1.4F);
    c.leaf(x, y, r, r * dice.between(0.6F, 1), dice.between(0, kPi), dice.between(low, high), 0);
  }
}

void plaster(TextureCanvas& c, std::uint32_t seed) {
  c.add_octaves(4, 32, 0.35F, 0.7F, seed);
  c.add_octaves(64, 512, 0.7F, 0.8F, seed);
  c.add_stones(56, seed + 1, [](float first, float, float) { return -0.7F * std::max(0.0F, 0.35F - first); });
}

// One figure of 128 px: a flower with leaves in a lattice of diamonds. No chance between the figures.
void wallpaper(TextureCanvas& c, std::uint32_t seed) {
  constexpr int kFigure = 128;
  TextureCanvas grain;
  grain.add_noise(kSide / 2, kSide / 2, 0.12F, seed);
  const float petals = seed % 2 == 0 ? 5 : 6;
  add_everywhere(c, [&](int px, int py) {
    const int mx = px % kFigure;
    const int my = py % kFigure;
    const float x = static_cast<float>(mx) - kFigure / 2 + 0.5F;
    const float y = static_cast<float>(my) - kFigure / 2 + 0.5F;
    const float r = std::hypot(x, y);
    const float a = std::atan2(y, x);
    const float flower = r < 26 + 10 * std::cos(petals * a) ? 0.9F - 0.02F * r : 0;
    const float heart = r < 9 ? -1.4F : 0;
    const float diamond = std::abs(std::abs(x) + std::abs(y) - 60) < 2.5F ? 0.7F : 0;
    const float bud = std::hypot(std::abs(x) - 64, std::abs(y) - 64) < 15 ? -0.8F : 0;
    const float stem = std::abs(x - 8 * std::sin(y * 0.1F)) < 2 && r > 34 ? -0.6F : 0;
    return flower + heart + diamond + bud + stem + grain.at(mx, my);
  });
}

// Running bond: 4 stretchers across, 12 courses; joints of mortar.
void brick(TextureCanvas& c, std::uint32_t seed) {
  TextureCanvas grain;
  grain.add_octaves(32, 512, 0.25F, 0.8F, seed);
  add_everywhere(c, [&](int px, int py) {
    constexpr float kLength = kSide / 4.0F;
    constexpr float kCourse = kSide / 12.0F;
    const int course = std::min(static_cast<int>(static_cast<float>(py) / kCourse), 11);
    const float v = static_cast<float>(py) - static_cast<float>(course) * kCourse;
    float u = static_cast<float>(px) + (course % 2 == 0 ? 0 : kLength / 2);
    if (u >= kSide) u -= kSide;
    const int stone = static_cast<int>(u / kLength);
    u -= static_cast<float>(stone) * kLength;
    const float wobble = 2 * grain.at(px, py);
    const bool joint = u + wobble < 5 || v + wobble < 5;
    return joint ? 1 + 0.4F * grain.at(px + 9, py)
                 : 0.55F * shade_of(stone, course, seed) + 0.9F * grain.at(px, py) - 0.2F;
  });
}

void concrete(TextureCanvas& c, std::uint32_t seed) {
  c.add_octaves(2, 32, 0.5F, 0.75F, seed);
  c.add_octaves(64, 512, 0.35F, 0.9F, seed);
  specks(c, seed + 1, 500, 1.6F, -1.3F, -0.7F);
  specks(c, seed + 2, 900, 1.4F, 0.4F, 1);
}

// Four boards along u, each with its own grain.
void wood(TextureCanvas& c, std::uint32_t seed) {
  TextureCanvas bend;
  bend.add_noise(4, 8, 1, seed);
  bend.add_noise(8, 16, 0.4F, seed + 1);
  c.add_noise(8, 256, 0.35F, seed + 2);
  c.add_noise(32, 512, 0.35F, seed + 3);
  c.add_noise(128, 512, 0.2F, seed + 4);
  add_everywhere(c, [&](int x, int y) {
    const int board = y / 128;
    const float rings = std::sin(static_cast<float>(y) * (2 * kPi * 5 / 128) + 5 * bend.at(x + 170 * board, y));
    const float joint = y % 128 < 2 || (x + 190 * board) % kSide < 2 ? -1.5F : 0;
    return 0.45F * rings + 0.35F * shade_of(board, 0, seed) + joint;
  });
}

void carpet(TextureCanvas& c, std::uint32_t seed) {
  c.add_octaves(4, 16, 0.2F, 0.8F, seed);
  c.add_noise(64, 64, 0.3F, seed + 1);
  c.add_stones(110, seed, [](float first, float, float shade) { return 0.9F * shade - 1.1F * first; });
  c.add_noise(512, 512, 0.3F, seed + 2);
}

void tiles(TextureCanvas& c, std::uint32_t seed) {
  c.add_octaves(8, 64, 0.12F, 0.9F, seed);
  c.add_octaves(128, 512, 0.12F, 1, seed);
  specks(c, seed, 700, 1.5F, -0.5F, 0.4F);
  add_everywhere(c, [&](int x, int y) { return 0.16F * shade_of(x / 128, y / 128, seed); });
  for (int k = 0; k < 4; ++k) {
    c.fill(128 * k, 0, 3, kSide, -1.3F);
    c.fill(0, 128 * k, kSide, 3, -1.3F);
  }
  c.add_noise(256, 256, 0.06F, seed + 3);
}

void gravel(TextureCanvas& c, std::uint32_t seed) {
  c.add_octaves(4, 16, 0.15F, 0.8F, seed);
  const auto stone = [](float first, float second, float shade) {
    const float gap = std::min(1.0F, (second - first) * 4);
    return gap * (0.5F + 0.45F * shade - 0.5F * first) - 0.8F * (1 - gap);
  };
  c.add_stones(44, seed + 1, stone);
  c.add_stones(100, seed + 2, [&](float a, float b, float s) { return 0.55F * stone(a, b, s); });
  c.add_noise(512, 512, 0.15F, seed + 3);
}

void grass(TextureCanvas& c, std::uint32_t seed) {
  c.add_octaves(4, 128, 0.5F, 0.8F, seed);
  Dice dice(seed);
  for (int i = 0; i < 26000; ++i) {
    const float x = dice.between(0, kSide);
    const float y = dice.between(0, kSide);
    const float a = dice.between(0, 2 * kPi);
    const float value = dice.between(-0.9F, 0.8F) + static_cast<float>(i) * 1e-5F;  // the uppermost get most light
    c.stroke(x, y, std::cos(a), std::sin(a), 6 + dice.below(16), value);
  }
}

void asphalt(TextureCanvas& c, std::uint32_t seed) {
  c.add_octaves(4, 64, 0.22F, 0.8F, seed);
  c.add_octaves(128, 512, 0.5F, 1.1F, seed);
  specks(c, seed + 1, 5000, 1.5F, 0.3F, 1.5F);
  specks(c, seed + 2, 2500, 1.4F, -1.2F, -0.5F);
}

// A page: a headline, a photograph, columns of lines made of words.
void paper(TextureCanvas& c, std::uint32_t seed) {
  constexpr int kColumn = 128;
  Dice dice(seed);
  c.add_octaves(4, 64, 0.05F, 0.8F, seed);
  for (int column = 0; column < 4; ++column) {
    for (int y = 8; y < kSide - 8; y += 8) {
      for (int x = 6; x < kColumn - 12;) {
        const int word = 4 + dice.below(14);
        const int end = std::min(x + word, kColumn - 6);
        for (int u = x; u < end; ++u)
          c.fill(column * kColumn + u, y, 1, 4, -0.25F - dice.unit());
        x = end + 3;
      }
    }
  }
  for (int y = 14; y < 52; ++y)
    c.fill(0, y, kSide, 1, 0);
  for (int x = 10; x < kSide - 30;) {
    const int stem = 5 + dice.below(6);
    c.fill(x, 20 + 8 * dice.below(2), stem, 24, -1.2F);
    x += stem + 4 + dice.below(10);
  }
  const int left = 128 * dice.below(3) + 6;
  TextureCanvas photo;
  photo.add_octaves(8, 256, 0.9F, 0.7F, seed + 9);
  for (int y = 120; y < 290; ++y) {
    for (int x = left; x < left + 240; ++x)
      c.at(x, y) = photo.at(x, y) - 0.5F;
  }
}

void cardboard(TextureCanvas& c, std::uint32_t seed) {
  c.add_octaves(4, 32, 0.22F, 0.8F, seed);
  c.add_noise(64, 256, 0.25F, seed + 1);
  c.add_noise(512, 512, 0.25F, seed + 2);
  add_everywhere(c, [](int x, int) { return 0.12F * std::sin(static_cast<float>(x) * (2 * kPi / 8)); });
  Dice dice(seed);
  const int tape = 60 + dice.below(300);
  for (int y = tape; y < tape + 36; ++y) {
    for (int x = 0; x < kSide; ++x)
      c.at(x, y) = 0.5F * c.at(x, y) + 0.8F;
  }
  for (int i = 0; i < 9; ++i)
    c.fill(40 + 46 * i, tape + 120 + 4 * dice.below(5), 8 + dice.below(26), 22, -1.2F);
  for (int i = 0; i < 40; ++i) {
    const float a = dice.between(0, 2 * kPi);
    c.stroke(dice.between(0, kSide), dice.between(0, kSide), std::cos(a), std::sin(a), 10 + dice.below(50), -0.5F);
  }
}

void cloth(TextureCanvas& c, std::uint32_t seed) {
  c.add_octaves(2, 16, 0.6F, 0.6F, seed);
  c.add_noise(128, 32, 0.25F, seed + 1);
  c.add_noise(32, 128, 0.25F, seed + 2);
  TextureCanvas thread;
  thread.add_noise(256, 256, 1, seed + 3);
  add_everywhere(c, [&](int x, int y) {
    const float weave =
        std::sin(static_cast<float>(x) * (2 * kPi / 8)) * std::sin(static_cast<float>(y) * (2 * kPi / 8));
    return (0.25F + 0.25F * thread.at(x, y)) * weave + 0.3F * thread.at(y, x);
  });
}

void leaves(TextureCanvas& c, std::uint32_t seed) {
  Dice dice(seed);
  add_everywhere(c, [](int, int) { return -1.2F; });
  for (int i = 0; i < 2600; ++i) {
    const float x = dice.between(0, kSide);
    const float y = dice.between(0, kSide);
    const float a = dice.between(9, 18);
    c.leaf(x, y, a, a * dice.between(0.4F, 0.6F), dice.between(0, 2 * kPi),
           dice.between(-0.5F, 0.6F) + static_cast<float>(i) * 2e-4F, 0.25F);
  }
  c.add_octaves(64, 512, 0.15F, 0.9F, seed);
}

void metal(TextureCanvas& c, std::uint32_t seed) {
  c.add_octaves(2, 8, 0.35F, 0.7F, seed);
  c.add_noise(4, 512, 0.35F, seed + 1);
  c.add_noise(16, 512, 0.3F, seed + 2);
  c.add_noise(64, 512, 0.25F, seed + 3);
  Dice dice(seed);
  for (int i = 0; i < 120; ++i) {
    const float a = dice.between(-0.5F, 0.5F);
    c.stroke(dice.between(0, kSide), dice.between(0, kSide), std::cos(a), std::sin(a), 20 + dice.below(120),
             dice.between(-1, 1));
  }
  specks(c, seed + 5, 150, 2.5F, -1, -0.4F);
}

void plain(TextureCanvas& c, std::uint32_t seed) {
  c.add_octaves(2, 16, 1, 0.7F, seed);
  c.add_octaves(128, 512, 0.25F, 1, seed);
}

using Painter = void (*)(TextureCanvas&, std::uint32_t);
constexpr Painter kPainters[] = {plain,  plaster, wallpaper, brick, concrete,  wood,  carpet, tiles,
                                 gravel, grass,   asphalt,   paper, cardboard, cloth, leaves, metal};
static_assert(std::size(kPainters) == kTextureNames.size());

// Standard deviations of [0, 1], as painted pictures of such materials have them at contrast 1.
float deviation_of(Texture texture) {
  switch (texture) {
    case Texture::plain:
      return 0.01F;
    case Texture::plaster:
    case Texture::concrete:
    case Texture::metal:
    case Texture::cardboard:
      return 0.14F;
    default:
      return 0.2F;
  }
}

}  // namespace

TextureCanvas painted_texture(Texture texture, std::uint32_t seed) {
  TextureCanvas c;
  const auto index = static_cast<std::uint32_t>(texture);
  kPainters[index](c, hash_of(index, seed));
  c.normalize(deviation_of(texture));
  return c;
}

TextureCanvas painted_clouds() {
  TextureCanvas c;
  c.add_octaves(4, 256, 0.5F, 0.6F, 77);
  c.normalize(0.22F);
  return c;
}

}  // namespace lakshya::sim
