#include "app/tools/sim/textures.h"

#include <mutex>

#include "app/tools/sim/texture_painters.h"

namespace lakshya::sim {
namespace {

constexpr std::uint32_t kSeeds = 4;  // pictures of one material

// Once made, a picture stays: worlds of a campaign share them.
class Pictures {
 public:
  template <class Paint>
  const TexturePicture& get(std::size_t index, const Paint& paint) {
    Slot& slot = slots_[index];
    std::call_once(slot.made, [&] { slot.picture = std::make_unique<TexturePicture>(paint().pixels()); });
    return *slot.picture;
  }

 private:
  struct Slot {
    std::once_flag made;
    std::unique_ptr<TexturePicture> picture;
  };
  std::array<Slot, kTextureNames.size() * kSeeds + 1> slots_;
};

Pictures& pictures() {
  static Pictures all;
  return all;
}

}  // namespace

TexturePicture::TexturePicture(const std::vector<float>& level0) : texels_(kStart[kLevels]) {
  std::vector<float> level = level0;
  for (std::size_t k = 0; k < kLevels; ++k) {
    std::uint16_t* const to = texels_.data() + kStart[k];
    for (std::size_t i = 0; i < level.size(); ++i)
      to[i] = static_cast<std::uint16_t>(level[i] * 65535 + 0.5F);
    const std::size_t side = static_cast<std::size_t>(kSide >> k);
    std::vector<float> half(side / 2 * (side / 2));
    for (std::size_t y = 0; y < side / 2; ++y) {
      for (std::size_t x = 0; x < side / 2; ++x) {
        const float* const p = &level[2 * y * side + 2 * x];
        half[y * (side / 2) + x] = (p[0] + p[1] + p[side] + p[side + 1]) / 4;
      }
    }
    level = std::move(half);
  }
}

TextureLayout texture_layout(Texture texture) {
  switch (texture) {
    case Texture::wallpaper:
    case Texture::brick:
    case Texture::tiles:
      return {4, 1, 0, 0};
    case Texture::paper:
    case Texture::cardboard:
      return {1, 1, 0, 0};
    case Texture::wood:
      return {2, 0.9F, 0.2F, 0};
    case Texture::plain:
      return {2, 1, 0, 0.7F};
    case Texture::gravel:
    case Texture::grass:
    case Texture::asphalt:
    case Texture::concrete:
    case Texture::carpet:
      return {2, 0.8F, 0.6F, 0.45F};
    default:
      return {2, 0.85F, 0.55F, 0};
  }
}

const TexturePicture& texture_picture(Texture texture, std::uint32_t seed) {
  const std::uint32_t kind = seed % kSeeds;
  return pictures().get(static_cast<std::size_t>(texture) * kSeeds + kind,
                        [&] { return painted_texture(texture, kind); });
}

const TexturePicture& cloud_picture() {
  return pictures().get(kTextureNames.size() * kSeeds, [] { return painted_clouds(); });
}

}  // namespace lakshya::sim
