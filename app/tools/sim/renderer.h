// What cameras and lasers see of a world: radiance, exact depth, ranges.
//
// One primary ray per pixel centre and one shadow ray to the sun (or to the first lamp); textures are filtered by the pixel's
// footprint. Rows are spread over OpenMP's threads in bands of a fixed height: the same numbers for any number of threads.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>

#include "app/tools/sim/ray_table.h"
#include "app/tools/sim/walk.h"
#include "app/tools/sim/world.h"
#include "kernels/base/image_view.h"

namespace lakshya::sim {

class Tracer;

class Renderer {
 public:
  // Start-up: throws std::runtime_error where Embree cannot start. `world` outlives the renderer and stays as it is.
  explicit Renderer(const World& world);
  ~Renderer();
  Renderer(Renderer&&) noexcept;
  Renderer& operator=(Renderer&&) noexcept;

  // Puts all who walk where they are then. Not while another thread looks; all below may be called by many.
  void set_time(const WalkTimes& when);

  // Linear radiance, 0.5 where an irradiance of 1 falls on albedo 0.5. `out` has the table's size. Glass is not seen, but for a
  // slight tint.
  void radiance(const RayTable& rays, const CameraPose& pose, ImageView<float> out) const;

  // Distance along the optical axis at every pixel's centre, metres, infinity: sky; and which of World::things is there, -1
  // ground, -2 sky. Both have the table's size.
  void depth(const RayTable& rays, const CameraPose& pose, bool sees_glass, ImageView<float> depth,
             ImageView<std::int16_t> thing) const;

  // How far a ray goes, metres; infinity: nothing is there. `direction` has any length but 0.
  double range(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction, bool sees_glass) const;

  // Irradiance of the sun's direct light on a lens at `position` that faces it; 0 in shadow, indoors, at night.
  double sun_at(const Eigen::Vector3d& position) const;

 private:
  std::unique_ptr<Tracer> tracer_;
};

}  // namespace lakshya::sim
