#include "app/tools/sim/ray_scene.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "app/core/over_bands.h"
#include "app/tools/sim/ground_mesh.h"
#include "app/tools/sim/hash.h"
#include "app/tools/sim/walk.h"

namespace lakshya::sim {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3f;

constexpr unsigned kStillId = 0;
constexpr unsigned kGlassId = 1;
constexpr unsigned kFirstWalkerId = 2;

Material material_of(const Surface& surface) {
  Material m;
  m.picture = &texture_picture(surface.texture, surface.seed);
  m.layout = texture_layout(surface.texture);
  m.albedo = surface.albedo;
  m.contrast = surface.contrast;
  m.texels_per_m = static_cast<float>(TexturePicture::kSide) / (m.layout.figures * surface.scale_m);
  return m;
}

// The picture lies on the triangle without being stretched: u runs level, v up; on what is nearly level u is x and v is y.
Facet facet_of(const Vector3f& a, const Vector3f& b, const Vector3f& c, const Material& material,
               std::uint32_t seed) {
  Facet f;
  const Vector3d normal = (b - a).cast<double>().cross((c - a).cast<double>());
  const double size = normal.norm();
  if (size > 0) f.normal = (normal / size).cast<float>();
  const float turns = material.texels_per_m / static_cast<float>(TexturePicture::kSide);
  Vector3f u = Vector3f::UnitX();
  if (std::abs(f.normal.z()) < 0.9F) {
    u = Vector3f(-f.normal.y(), f.normal.x(), 0).normalized();
    // The same way on both sides of a sheet.
    if (u.x() < -1e-4F || (std::abs(u.x()) <= 1e-4F && u.y() < 0)) u = -u;
  }
  Vector3f v = f.normal.cross(u).normalized();
  if (v.z() < 0 || (v.z() == 0 && v.y() < 0)) v = -v;
  f.u_axis = u * turns;
  f.v_axis = -v * turns;  // pictures have their first row on top
  f.u_offset = unit_of(hash_of(seed, 1));
  f.v_offset = unit_of(hash_of(seed, 2));
  return f;
}

FacetPlane plane_of(const Vector3f& a, const Vector3f& b, const Vector3f& c) {
  FacetPlane plane;
  const Vector3d corner = a.cast<double>();
  plane.normal = (b.cast<double>() - corner).cross(c.cast<double>() - corner);
  plane.distance = plane.normal.dot(corner);
  return plane;
}

// Pictures take some 10 ms each to paint: all that are missing at once.
void paint_pictures(const World& world) {
  std::vector<std::pair<Texture, std::uint32_t>> wanted{
      {world.ground.surface.texture, world.ground.surface.seed % 4}};
  for (const GroundPatch& p : world.ground.patches)
    wanted.emplace_back(p.surface.texture, p.surface.seed % 4);
  for (const Thing& t : world.things) {
    for (const Surface& s : t.mesh.surfaces)
      wanted.emplace_back(s.texture, s.seed % 4);
  }
  std::sort(wanted.begin(), wanted.end());
  wanted.erase(std::unique(wanted.begin(), wanted.end()), wanted.end());
  static_cast<void>(over_bands(static_cast<int>(wanted.size()), [&](int i) {
    texture_picture(wanted[static_cast<std::size_t>(i)].first, wanted[static_cast<std::size_t>(i)].second);
    return Status::ok;
  }));
}

}  // namespace

RayScene::RayScene(const World& world) {
  paint_pictures(world);
  // One thread: Embree builds in the caller's and starts none of its own.
  device_.reset(rtcNewDevice("threads=1,set_affinity=0"));
  if (!device_) throw std::runtime_error("Embree does not start");
  for (auto* scene : {&still_, &walking_, &glass_}) {
    scene->reset(rtcNewScene(device_.get()));
    // Robust: no ray slips through the edge between two triangles.
    rtcSetSceneFlags(scene->get(),
                     scene == &walking_ ? RTC_SCENE_FLAG_ROBUST | RTC_SCENE_FLAG_DYNAMIC : RTC_SCENE_FLAG_ROBUST);
  }

  const auto is_still = [](const Thing& t) { return !t.walk && t.expect != Expect::glass; };
  Triangles still;
  Triangles glass;
  first_facet_.push_back(0);
  add_mesh(ground_mesh(world.ground), kGround, still);
  for (std::size_t i = 0; i < world.things.size(); ++i) {
    if (is_still(world.things[i])) add_mesh(world.things[i].mesh, static_cast<std::int16_t>(i), still);
  }
  attach(still_.get(), kStillId, still.vertices, still.triangles, nullptr);
  first_facet_.push_back(static_cast<std::uint32_t>(facets_.size()));
  for (std::size_t i = 0; i < world.things.size(); ++i) {
    const Thing& thing = world.things[i];
    if (thing.expect == Expect::glass) add_mesh(thing.mesh, static_cast<std::int16_t>(i), glass);
  }
  has_glass_ = !glass.triangles.empty();
  attach(glass_.get(), kGlassId, glass.vertices, glass.triangles, nullptr);
  for (std::size_t i = 0; i < world.things.size(); ++i) {
    const Thing& thing = world.things[i];
    if (!thing.walk || thing.expect == Expect::glass || thing.mesh.triangles.empty()) continue;
    Triangles own;
    Walker walker;
    walker.thing = &thing;
    walker.index = i;
    walker.first = static_cast<std::uint32_t>(facets_.size());
    first_facet_.push_back(walker.first);
    add_mesh(thing.mesh, static_cast<std::int16_t>(i), own);
    walker.facets.assign(facets_.begin() + walker.first, facets_.end());
    walker.geometry = attach(walking_.get(), kFirstWalkerId + static_cast<unsigned>(walkers_.size()), own.vertices,
                             own.triangles, &walker.vertices);
    walkers_.push_back(std::move(walker));
  }
  rtcCommitScene(still_.get());
  rtcCommitScene(glass_.get());
  set_time(0);
}

void RayScene::add_mesh(const Mesh& mesh, std::int16_t thing, Triangles& to) {
  const auto first_vertex = static_cast<std::uint32_t>(to.vertices.size());
  const auto first_material = static_cast<std::uint32_t>(materials_.size());
  to.vertices.insert(to.vertices.end(), mesh.vertices.begin(), mesh.vertices.end());
  for (const Surface& s : mesh.surfaces)
    materials_.push_back(material_of(s));
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const auto& [a, b, c] = mesh.triangles[i];
    const std::uint16_t surface = mesh.surface[i];
    Facet f = facet_of(mesh.vertices[a], mesh.vertices[b], mesh.vertices[c], materials_[first_material + surface],
                       mesh.surfaces[surface].seed);
    f.material = first_material + surface;
    f.thing = thing;
    facets_.push_back(f);
    planes_.push_back(plane_of(mesh.vertices[a], mesh.vertices[b], mesh.vertices[c]));
    to.triangles.push_back({first_vertex + a, first_vertex + b, first_vertex + c});
  }
}

RayScene::Owned<RTCGeometry> RayScene::attach(RTCScene scene, unsigned id, const std::vector<Vector3f>& vertices,
                                              const std::vector<std::array<std::uint32_t, 3>>& triangles,
                                              Vector3f** buffer) {
  Owned<RTCGeometry> geometry(rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_TRIANGLE));
  if (triangles.empty()) return geometry;
  void* const corner = rtcSetNewGeometryBuffer(geometry.get(), RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                               sizeof(Vector3f), vertices.size());
  void* const index = rtcSetNewGeometryBuffer(geometry.get(), RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                              sizeof(triangles[0]), triangles.size());
  if (corner == nullptr || index == nullptr) throw std::runtime_error("Embree has no memory for the world");
  std::copy(vertices.begin(), vertices.end(), static_cast<Vector3f*>(corner));
  std::copy(triangles.begin(), triangles.end(), static_cast<std::array<std::uint32_t, 3>*>(index));
  if (buffer != nullptr) {
    *buffer = static_cast<Vector3f*>(corner);
    rtcSetGeometryBuildQuality(geometry.get(), RTC_BUILD_QUALITY_REFIT);  // who walks keeps his shape
  }
  rtcCommitGeometry(geometry.get());
  rtcAttachGeometryByID(scene, geometry.get(), id);
  return geometry;
}

void RayScene::put_walker(Walker& walker, const Place& place) {
  const Mesh& mesh = walker.thing->mesh;
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(place.yaw, Vector3d::UnitZ()).toRotationMatrix();
  const Vector3d at(place.x, place.y, 0);
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i)
    walker.vertices[i] = (turn * mesh.vertices[i].cast<double>() + at).cast<float>();
  const Eigen::Matrix3f turn_f = turn.cast<float>();
  const Vector3f at_f = at.cast<float>();
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const Facet& own = walker.facets[i];
    Facet& f = facets_[walker.first + i];
    f.normal = turn_f * own.normal;
    f.u_axis = turn_f * own.u_axis;
    f.v_axis = turn_f * own.v_axis;
    f.u_offset = own.u_offset - f.u_axis.dot(at_f);
    f.v_offset = own.v_offset - f.v_axis.dot(at_f);
    const auto& [a, b, c] = mesh.triangles[i];
    planes_[walker.first + i] = plane_of(walker.vertices[a], walker.vertices[b], walker.vertices[c]);
  }
  rtcUpdateGeometryBuffer(walker.geometry.get(), RTC_BUFFER_TYPE_VERTEX, 0);
  rtcCommitGeometry(walker.geometry.get());
}

void RayScene::set_time(const WalkTimes& when) {
  for (Walker& walker : walkers_)
    put_walker(walker, place_on_walk(*walker.thing->walk, when.of(walker.index)));
  rtcCommitScene(walking_.get());
}

}  // namespace lakshya::sim
