#include "app/tools/sim/renderer.h"

#include <algorithm>

#include "app/core/over_bands.h"
#include "app/tools/sim/tracer.h"

namespace lakshya::sim {
namespace {

using Eigen::Vector3d;

constexpr int kBandRows = 16;  // a whole number of packets

// work(pixels) for all packets of an image.
template <class Work>
void for_packets(int width, int height, const Work& work) {
  static_cast<void>(over_bands((height + kBandRows - 1) / kBandRows, [&](int band) {
    const int end = std::min(height, (band + 1) * kBandRows);
    for (int v = band * kBandRows; v < end; v += kPacketHeight) {
      for (int u = 0; u < width; u += kPacketWidth)
        work(PacketPixels{u, v, width, end});
    }
    return Status::ok;
  }));
}

}  // namespace

Renderer::Renderer(const World& world) : tracer_(std::make_unique<Tracer>(world)) {}
Renderer::~Renderer() = default;
Renderer::Renderer(Renderer&&) noexcept = default;
Renderer& Renderer::operator=(Renderer&&) noexcept = default;

void Renderer::set_time(const WalkTimes& when) {
  tracer_->scene.set_time(when);
}

void Renderer::radiance(const RayTable& rays, const CameraPose& pose, ImageView<float> out) const {
  for_packets(rays.width(), rays.height(),
              [&](const PacketPixels& pixels) { tracer_->radiance(rays, pose, pixels, out); });
}

void Renderer::depth(const RayTable& rays, const CameraPose& pose, bool sees_glass, ImageView<float> depth,
                     ImageView<std::int16_t> thing) const {
  for_packets(rays.width(), rays.height(),
              [&](const PacketPixels& pixels) { tracer_->depth(rays, pose, pixels, sees_glass, depth, thing); });
}

double Renderer::range(const Vector3d& origin, const Vector3d& direction, bool sees_glass) const {
  return tracer_->range(origin, direction, sees_glass);
}

double Renderer::sun_at(const Vector3d& position) const {
  return tracer_->sun_at(position);
}

}  // namespace lakshya::sim
