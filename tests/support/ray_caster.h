// Exact stereo pairs of simple scenes, with the truth: textured rectangles and boxes in the body frame (x forward, y
// left, z up, metres; docs/contract.md section 1), seen by a rectified pair of pinhole cameras. The same scene gives the
// same images every time.
#pragma once

#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <vector>

#include "app/core/image.h"
#include "kernels/base/integer.h"
#include "kernels/base/units.h"
#include "tests/support/surface_texture.h"

namespace lakshya::test {

struct Vec3 {
  double x = 0;
  double y = 0;
  double z = 0;
};
inline Vec3 operator+(const Vec3& a, const Vec3& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
inline Vec3 operator-(const Vec3& a, const Vec3& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
inline Vec3 operator*(double s, const Vec3& a) {
  return {s * a.x, s * a.y, s * a.z};
}
inline double dot(const Vec3& a, const Vec3& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
inline Vec3 cross(const Vec3& a, const Vec3& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

// ---- the scene

// corner + s along_a + t along_b, s in [0, size_a], t in [0, size_b]; along_a and along_b are unit vectors at right
// angles. Seen from both sides.
struct Rectangle {
  Vec3 corner;
  Vec3 along_a;
  Vec3 along_b;
  double size_a = 0;
  double size_b = 0;
  std::uint8_t object = 0;  // the caller's name for it, above 0
  SurfaceTexture texture;
};

// An upright box: `base` is the centre of its underside, `size` its length (forward), width (left) and height before it
// is turned by `yaw` (radians, counter-clockwise from above) about the vertical through its centre.
struct Cuboid {
  Vec3 base;
  Vec3 size;
  double yaw = 0;
};

using Surfaces = std::vector<Rectangle>;

inline void add_cuboid(Surfaces& scene, const Cuboid& box, std::uint8_t object, SurfaceTexture texture) {
  const Vec3 length{std::cos(box.yaw), std::sin(box.yaw), 0};
  const Vec3 width{-std::sin(box.yaw), std::cos(box.yaw), 0};
  const Vec3 up{0, 0, 1};
  const Vec3 low = box.base - 0.5 * box.size.x * length - 0.5 * box.size.y * width;
  const Vec3 high = low + box.size.x * length + box.size.y * width + box.size.z * up;
  const auto add = [&](const Vec3& corner, const Vec3& a, double size_a, const Vec3& b, double size_b) {
    ++texture.seed;  // no two faces alike
    scene.push_back({corner, a, b, size_a, size_b, object, texture});
  };
  add(low, width, box.size.y, up, box.size.z);
  add(low, length, box.size.x, up, box.size.z);
  add(low, length, box.size.x, width, box.size.y);
  add(high, -1 * width, box.size.y, -1 * up, box.size.z);
  add(high, -1 * length, box.size.x, -1 * up, box.size.z);
  add(high, -1 * length, box.size.x, -1 * width, box.size.y);
}

// ---- the cameras

// The left camera is height_m above the origin of the body frame, the right one a baseline along the left one's
// x-axis. Pitch and roll as in docs/contract.md section 1. The centre of projection is the image's.
struct CameraRig {
  int width = 480;
  int height = 360;
  double focal_px = 400;
  double baseline_m = 0.16;
  double height_m = 0.6;
  double pitch_deg = 0;
  double roll_deg = 0;

  double center_u() const { return (width - 1) / 2.0; }
  double center_v() const { return (height - 1) / 2.0; }
};

// The cameras' axes in the body frame.
struct CameraAxes {
  Vec3 right;
  Vec3 down;
  Vec3 ahead;
};

inline CameraAxes camera_axes(const CameraRig& rig) {
  constexpr double kDegree = std::numbers::pi / 180;
  const double p = rig.pitch_deg * kDegree;
  const double r = rig.roll_deg * kDegree;
  // First the nose goes down, then the camera turns about its own axis, right side down.
  const Vec3 level_right{0, -1, 0};
  const Vec3 pitched_down{-std::sin(p), 0, -std::cos(p)};
  return {std::cos(r) * level_right + std::sin(r) * pitched_down,
          std::cos(r) * pitched_down - std::sin(r) * level_right,
          {std::cos(p), 0, -std::sin(p)}};
}

// Where a pixel looks, in the body frame, for one metre of camera depth.
inline Vec3 pixel_ray(const CameraRig& rig, const CameraAxes& axes, double u, double v) {
  return axes.ahead + (u - rig.center_u()) / rig.focal_px * axes.right +
         (v - rig.center_v()) / rig.focal_px * axes.down;
}

// ---- casting

struct Hit {
  const Rectangle* surface = nullptr;                      // none: the ray leaves the scene
  double depth = std::numeric_limits<double>::infinity();  // in lengths of the ray
  double a = 0;                                            // along the surface, metres
  double b = 0;
};

inline Hit cast(const Surfaces& scene, const Vec3& eye, const Vec3& ray) {
  constexpr double kNearest = 1e-6;
  Hit hit;
  for (const Rectangle& r : scene) {
    const Vec3 normal = cross(r.along_a, r.along_b);
    const double towards = dot(normal, ray);
    if (towards == 0) continue;
    const double depth = dot(normal, r.corner - eye) / towards;
    if (!(depth > kNearest && depth < hit.depth)) continue;
    const Vec3 point = eye + depth * ray - r.corner;
    const double a = dot(point, r.along_a);
    const double b = dot(point, r.along_b);
    if (a >= 0 && a <= r.size_a && b >= 0 && b <= r.size_b) hit = {&r, depth, a, b};
  }
  return hit;
}

// Grey level of what a ray hits. `step`: how the ray changes from one pixel of a row to the next.
inline double shade(const Hit& hit, const Vec3& ray, const Vec3& step) {
  constexpr double kSky = 225;
  if (hit.surface == nullptr) return kSky;
  const Vec3 normal = cross(hit.surface->along_a, hit.surface->along_b);
  const Vec3 along = hit.depth * (step - dot(normal, step) / dot(normal, ray) * ray);
  const double gray = gray_at(hit.surface->texture, hit.a, hit.b, std::sqrt(dot(along, along)));
  // Daylight from above: fronts, sides and tops of a box differ.
  const double light = 0.82 + 0.18 * std::abs(normal.z) - 0.14 * std::abs(normal.y);
  return light * gray;
}

struct CameraView {
  Image<std::uint8_t> gray;
  Image<float> depth;  // of the pixel's centre along the optical axis, metres; infinity where there is nothing
  Image<std::uint8_t> object;  // Rectangle::object, 0 where there is nothing
};

// Each pixel is the mean of 2 x 2 rays; depth and object are those of its centre.
inline CameraView render_view(const Surfaces& scene, const CameraRig& rig, const Vec3& eye) {
  CameraView view{Image<std::uint8_t>(rig.width, rig.height), Image<float>(rig.width, rig.height),
                  Image<std::uint8_t>(rig.width, rig.height)};
  const CameraAxes axes = camera_axes(rig);
  const Vec3 step = 1 / rig.focal_px * axes.right;
  for (int v = 0; v < rig.height; ++v) {
    for (int u = 0; u < rig.width; ++u) {
      const Hit center = cast(scene, eye, pixel_ray(rig, axes, u, v));
      view.depth.view().at(u, v) = static_cast<float>(center.depth);
      view.object.view().at(u, v) = center.surface == nullptr ? std::uint8_t{0} : center.surface->object;
      double sum = 0;
      for (const double dv : {-0.25, 0.25}) {
        for (const double du : {-0.25, 0.25}) {
          const Vec3 ray = pixel_ray(rig, axes, u + du, v + dv);
          sum += shade(cast(scene, eye, ray), ray, step);
        }
      }
      view.gray.view().at(u, v) = static_cast<std::uint8_t>(std::lround(std::clamp(sum / 4, 0.0, 255.0)));
    }
  }
  return view;
}

struct RenderedPair {
  CameraView left;
  CameraView right;
  Image<float> disparity;           // of the left image, f B / depth, px; 0 where there is nothing
  Image<std::int16_t> disparity16;  // the same in 1/16 px, rounded half up
};

inline RenderedPair render_pair(const Surfaces& scene, const CameraRig& rig) {
  const Vec3 eye{0, 0, rig.height_m};
  RenderedPair pair{render_view(scene, rig, eye),
                    render_view(scene, rig, eye + rig.baseline_m * camera_axes(rig).right),
                    Image<float>(rig.width, rig.height), Image<std::int16_t>(rig.width, rig.height)};
  for (int v = 0; v < rig.height; ++v) {
    for (int u = 0; u < rig.width; ++u) {
      const double d = rig.focal_px * rig.baseline_m / pair.left.depth.view().at(u, v);
      pair.disparity.view().at(u, v) = static_cast<float>(d);
      pair.disparity16.view().at(u, v) = static_cast<std::int16_t>(round_half_up(d * kDisparityScale));
    }
  }
  return pair;
}

}  // namespace lakshya::test
