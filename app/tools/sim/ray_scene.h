// The world's triangles in Embree, and what a ray needs to know of each. For the renderer's own files only.
//
// Three Embree scenes, traced one after the other with the ray shortened by what was hit before: what stands still, what
// walks (rebuilt when time moves, small), and glass, which only some look at. Embree is built without ray masks on many systems.
#pragma once

#include <embree3/rtcore.h>

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <type_traits>
#include <vector>

#include "app/tools/sim/textures.h"
#include "app/tools/sim/walk.h"
#include "app/tools/sim/world.h"

namespace lakshya::sim {

struct Material {
  const TexturePicture* picture = nullptr;
  TextureLayout layout;
  float albedo = 0;
  float contrast = 0;
  float texels_per_m = 0;  // at level 0 of the picture's own size
};

// One triangle as it is shaded: its normal, and where a point p lies on the picture, u = u_axis . p + u_offset, in pictures.
struct Facet {
  Eigen::Vector3f normal{0, 0, 1};
  Eigen::Vector3f u_axis{0, 0, 0};
  Eigen::Vector3f v_axis{0, 0, 0};
  float u_offset = 0;
  float v_offset = 0;
  std::uint32_t material = 0;
  std::int16_t thing = -1;  // index in World::things, -1: the ground
};

// The triangle's plane normal . p = distance, in double: depth is exact where Embree's float is not.
struct FacetPlane {
  Eigen::Vector3d normal{0, 0, 1};
  double distance = 0;
};

inline constexpr std::int16_t kGround = -1;
inline constexpr std::int16_t kSky = -2;

class RayScene {
 public:
  explicit RayScene(const World& world);

  void set_time(const WalkTimes& when);

  RTCScene still() const { return still_.get(); }
  RTCScene walking() const { return walkers_.empty() ? nullptr : walking_.get(); }
  RTCScene glass() const { return has_glass_ ? glass_.get() : nullptr; }

  std::uint32_t facet_index(unsigned geometry, unsigned primitive) const {
    return first_facet_[geometry] + primitive;
  }
  const Facet& facet(std::uint32_t index) const { return facets_[index]; }
  const FacetPlane& plane(std::uint32_t index) const { return planes_[index]; }
  const Material& material(const Facet& facet) const { return materials_[facet.material]; }

 private:
  struct Release {
    void operator()(RTCDevice d) const { rtcReleaseDevice(d); }
    void operator()(RTCScene s) const { rtcReleaseScene(s); }
    void operator()(RTCGeometry g) const { rtcReleaseGeometry(g); }
  };
  template <class Handle>
  using Owned = std::unique_ptr<std::remove_pointer_t<Handle>, Release>;

  struct Triangles {
    std::vector<Eigen::Vector3f> vertices;
    std::vector<std::array<std::uint32_t, 3>> triangles;
  };
  struct Walker {
    const Thing* thing = nullptr;
    std::size_t index = 0;  // in World::things
    Owned<RTCGeometry> geometry;
    std::uint32_t first = 0;              // facet
    std::vector<Facet> facets;            // about his own place
    Eigen::Vector3f* vertices = nullptr;  // Embree's
  };

  void add_mesh(const Mesh& mesh, std::int16_t thing, Triangles& to);
  Owned<RTCGeometry> attach(RTCScene scene, unsigned id, const std::vector<Eigen::Vector3f>& vertices,
                            const std::vector<std::array<std::uint32_t, 3>>& triangles, Eigen::Vector3f** buffer);
  void put_walker(Walker& walker, const Place& place);

  Owned<RTCDevice> device_;
  Owned<RTCScene> still_, walking_, glass_;
  bool has_glass_ = false;
  std::vector<std::uint32_t> first_facet_;  // of each Embree geometry: 0 still, 1 glass, then the walkers
  std::vector<Facet> facets_;
  std::vector<FacetPlane> planes_;
  std::vector<Material> materials_;
  std::vector<Walker> walkers_;
};

}  // namespace lakshya::sim
