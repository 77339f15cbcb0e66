// Traces and shades packets of rays: the renderer's inside. For its own files only.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "app/tools/sim/ray_scene.h"
#include "app/tools/sim/ray_table.h"
#include "app/tools/sim/shading.h"
#include "app/tools/sim/sky.h"
#include "app/tools/sim/world.h"
#include "kernels/base/image_view.h"

namespace lakshya::sim {

inline constexpr int kPacketWidth = 8;
inline constexpr int kPacketHeight = kLanes / kPacketWidth;

// A packet's pixels: 8 x 2 from (u, v), fewer at the right and lower border.
struct PacketPixels {
  int u, v, width, height;
  bool has(int lane) const { return u + lane % kPacketWidth < width && v + lane / kPacketWidth < height; }
  int column(int lane) const { return u + lane % kPacketWidth; }
  int row(int lane) const { return v + lane / kPacketWidth; }
};

struct alignas(64) Packet {
  RTCRayHit16 rays;
  int valid[kLanes];
};

class Tracer {
 public:
  explicit Tracer(const World& world);

  void radiance(const RayTable& table, const CameraPose& pose, const PacketPixels& pixels,
                ImageView<float> out) const;
  void depth(const RayTable& table, const CameraPose& pose, const PacketPixels& pixels, bool sees_glass,
             ImageView<float> depth, ImageView<std::int16_t> thing) const;
  double range(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction, bool sees_glass) const;
  double sun_at(const Eigen::Vector3d& position) const;

  RayScene scene;

 private:
  static constexpr std::size_t kNoLamp = ~std::size_t{0};

  void intersect(Packet& p, bool sees_glass) const;
  bool occluded(const int* valid, RTCRay16& rays) const;
  // Adds the light that comes straight from the sun or the first lamp.
  void add_hard_light(const Packet& p, const Hits& hits, Lanes& light) const;
  void tint_behind_glass(const Packet& p, Lanes& radiance) const;
  // The ray's parameter where it meets the facet's plane, in double.
  double exact(std::uint32_t facet, const Eigen::Vector3d& origin, const Eigen::Vector3d& direction,
               double traced) const;

  const Light& light_;
  Sky sky_;
  Eigen::Vector3f to_sun_;
  std::vector<PointLight> lamps_;
  std::size_t shadow_lamp_ = kNoLamp;
};

}  // namespace lakshya::sim
