#include "app/tools/picture_colors.h"

#include <algorithm>
#include <cmath>

namespace lakshya {
namespace {

std::uint8_t byte(double value) {
  return static_cast<std::uint8_t>(std::lround(std::clamp(value, 0.0, 255.0)));
}

Rgb8 shade(std::uint8_t gray, double gain) {
  const std::uint8_t g = byte(gain * gray);
  return {g, g, g};
}

struct Tint {
  Rgb8 color;
  double share;  // of the colour, the rest is the image
  double gain;   // of the image
};

Tint class_tint(PixelClass pixel_class) {
  switch (pixel_class) {
    case PixelClass::obstacle:
      return {{220, 50, 32}, 0.46, 1.0};
    case PixelClass::floor:
      return {{0, 158, 115}, 0.38, 1.0};
    case PixelClass::ceiling:
      return {{0, 114, 200}, 0.44, 1.0};
    case PixelClass::drop_off:
      return {{225, 60, 190}, 0.55, 1.0};
    case PixelClass::too_far:
    case PixelClass::no_disparity:
      break;
  }
  return {{255, 255, 255}, 0.0, 1.0};
}

Tint reason_tint(std::int16_t disparity) {
  switch (disparity) {
    case kNotSearched:
      return {{0, 0, 0}, 0.75, 1.0};
    case kLowTexture:
      return {{130, 120, 20}, 0.45, 0.45};
    case kNotUnique:
      return {{40, 130, 160}, 0.45, 0.45};
    case kLeftRightFailed:
      return {{150, 85, 20}, 0.45, 0.45};
    case kNoSupport:
      return {{120, 70, 150}, 0.45, 0.45};
    case kPrunedEarly:
      return {{70, 70, 80}, 0.60, 0.45};
    default:
      return {{240, 228, 66}, 0.25, 0.80};  // matched, but nothing concluded
  }
}

}  // namespace

Rgb8 mix(Rgb8 a, Rgb8 b, double share) {
  const auto channel = [share](std::uint8_t x, std::uint8_t y) { return byte(x + share * (y - x)); };
  return {channel(a.r, b.r), channel(a.g, b.g), channel(a.b, b.b)};
}

Rgb8 turbo(double t) {
  const double x = std::clamp(t, 0.0, 1.0);
  const auto polynomial = [x](double a, double b, double c, double d, double e, double f) {
    return byte(255 * (a + x * (b + x * (c + x * (d + x * (e + x * f))))));
  };
  return {polynomial(0.13572138, 4.61539260, -42.66032258, 132.13108234, -152.94239396, 59.28637943),
          polynomial(0.09140261, 2.19418839, 4.84296658, -14.18503333, 4.27729857, 2.82956604),
          polynomial(0.10667330, 12.64194608, -60.58204836, 110.36276771, -89.90310912, 27.34824973)};
}

Rgb8 disparity_color(double disparity_px, double largest_px) {
  constexpr double kFirst = 0.07;
  return turbo(kFirst + (1 - kFirst) * std::clamp(disparity_px / largest_px, 0.0, 1.0));
}

Rgb8 height_color(double height_m, double clearance_m) {
  return mix({178, 84, 48}, {38, 10, 8}, std::clamp(height_m / clearance_m, 0.0, 1.0));
}

Rgb8 class_color(PixelClass pixel_class, std::int16_t disparity, std::uint8_t gray) {
  const Tint tint = pixel_class == PixelClass::no_disparity ? reason_tint(disparity) : class_tint(pixel_class);
  return mix(shade(gray, tint.gain), tint.color, tint.share);
}

}  // namespace lakshya
