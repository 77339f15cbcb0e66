#include "app/tools/sim/tracer.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

namespace lakshya::sim {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3f;

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr float kOffSurface = 1e-3F;   // m, so that no surface shades itself
constexpr float kLampRadius = 0.08F;   // m, so that a lamp's own glass does not shade everything
constexpr float kThroughGlass = 0.9F;  // two surfaces' reflection, twice
constexpr float kGlassSheen = 0.03F;   // of what is around

RTCIntersectContext coherent_context() {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  return context;
}

// Rays through the pixels' centres whose parameter is the depth along the optical axis.
void aim(const RayTable& table, const CameraPose& pose, const PacketPixels& pixels, Packet& p) {
  const Eigen::Matrix3f turn = pose.world_from_camera.cast<float>();
  const Vector3f at = pose.position.cast<float>();
  Lanes x;
  Lanes y;
  for (int i = 0; i < kLanes; ++i) {
    const int u = std::min(pixels.column(i), table.width() - 1);
    const int v = std::min(pixels.row(i), table.height() - 1);
    const std::ptrdiff_t at_pixel = static_cast<std::ptrdiff_t>(v) * table.width() + u;
    x[static_cast<std::size_t>(i)] = table.x()[at_pixel];
    y[static_cast<std::size_t>(i)] = table.y()[at_pixel];
    p.valid[i] = pixels.has(i) ? -1 : 0;
  }
  RTCRay16& r = p.rays.ray;
  for (std::size_t i = 0; i < kLanes; ++i) {
    r.org_x[i] = at.x();
    r.org_y[i] = at.y();
    r.org_z[i] = at.z();
    r.dir_x[i] = turn(0, 0) * x[i] + turn(0, 1) * y[i] + turn(0, 2);
    r.dir_y[i] = turn(1, 0) * x[i] + turn(1, 1) * y[i] + turn(1, 2);
    r.dir_z[i] = turn(2, 0) * x[i] + turn(2, 1) * y[i] + turn(2, 2);
    r.tnear[i] = 1e-4F;
    r.tfar[i] = kInfinity;
    r.time[i] = 0;
    r.mask[i] = ~0U;
    r.id[i] = 0;
    r.flags[i] = 0;
    p.rays.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
    p.rays.hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
  }
}

}  // namespace

Tracer::Tracer(const World& world)
    : scene(world),
      light_(world.light),
      sky_(world.light),
      to_sun_(world.light.sun_direction.normalized().cast<float>()) {
  for (const Lamp& l : world.light.lamps) {
    const Vector3f at = l.position.cast<float>();
    lamps_.push_back({at.x(), at.y(), at.z(), static_cast<float>(l.strength)});
  }
  shadow_lamp_ = light_.sun > 0 || lamps_.empty() ? kNoLamp : 0;
}

void Tracer::intersect(Packet& p, bool sees_glass) const {
  RTCIntersectContext context = coherent_context();
  rtcIntersect16(p.valid, scene.still(), &context, &p.rays);
  if (scene.walking() != nullptr) rtcIntersect16(p.valid, scene.walking(), &context, &p.rays);
  if (sees_glass && scene.glass() != nullptr) rtcIntersect16(p.valid, scene.glass(), &context, &p.rays);
}

// Lanes whose way is not free have tfar < 0 afterwards.
bool Tracer::occluded(const int* valid, RTCRay16& rays) const {
  bool any = false;
  for (int i = 0; i < kLanes; ++i)
    any = any || valid[i] != 0;
  if (!any) return false;
  RTCIntersectContext context = coherent_context();
  rtcOccluded16(valid, scene.still(), &context, &rays);
  if (scene.walking() != nullptr) rtcOccluded16(valid, scene.walking(), &context, &rays);
  return true;
}

void Tracer::add_hard_light(const Packet& p, const Hits& hits, Lanes& light) const {
  const bool sun = light_.sun > 0;
  if (!sun && shadow_lamp_ == kNoLamp) return;
  alignas(64) RTCRay16 r = p.rays.ray;
  alignas(64) int valid[kLanes];
  Lanes strength;
  for (std::size_t i = 0; i < kLanes; ++i) {
    Vector3f way = to_sun_;
    float far = kInfinity;
    float factor = static_cast<float>(light_.sun);
    const Vector3f normal(hits.nx[i], hits.ny[i], hits.nz[i]);
    const Vector3f at(hits.px[i], hits.py[i], hits.pz[i]);
    if (!sun) {
      const PointLight& lamp = lamps_[shadow_lamp_];
      way = Vector3f(lamp.x, lamp.y, lamp.z) - at;
      const float squared = way.squaredNorm() + 1e-2F;
      const float distance = std::sqrt(squared);
      way /= distance;
      far = distance - kLampRadius;
      factor = lamp.strength / squared;
    }
    strength[i] = factor * normal.dot(way);
    valid[i] = hits.hit[i] && strength[i] > 0 && far > 0 ? -1 : 0;
    r.org_x[i] = at.x() + kOffSurface * normal.x();
    r.org_y[i] = at.y() + kOffSurface * normal.y();
    r.org_z[i] = at.z() + kOffSurface * normal.z();
    r.dir_x[i] = way.x();
    r.dir_y[i] = way.y();
    r.dir_z[i] = way.z();
    r.tnear[i] = 0;
    r.tfar[i] = far;
  }
  if (!occluded(valid, r)) return;
  for (std::size_t i = 0; i < kLanes; ++i) {
    if (valid[i] != 0 && r.tfar[i] >= 0) light[i] += strength[i];
  }
}

void Tracer::tint_behind_glass(const Packet& p, Lanes& radiance) const {
  alignas(64) RTCRay16 r = p.rays.ray;  // tfar: as far as one sees
  alignas(64) int valid[kLanes];
  std::copy(std::begin(p.valid), std::end(p.valid), std::begin(valid));
  RTCIntersectContext context = coherent_context();
  rtcOccluded16(valid, scene.glass(), &context, &r);
  const float sheen = kGlassSheen * static_cast<float>(light_.ambient + light_.sky);
  for (std::size_t i = 0; i < kLanes; ++i) {
    if (r.tfar[i] < 0) radiance[i] = kThroughGlass * radiance[i] + sheen;
  }
}

void Tracer::radiance(const RayTable& table, const CameraPose& pose, const PacketPixels& pixels,
                      ImageView<float> out) const {
  Packet p;
  aim(table, pose, pixels, p);
  intersect(p, false);
  const RTCRay16& r = p.rays.ray;

  Hits hits;
  Lanes reflected;
  for (std::size_t i = 0; i < kLanes; ++i) {
    const Vector3f way(r.dir_x[i], r.dir_y[i], r.dir_z[i]);
    const float length = way.norm();
    hits.hit[i] = p.valid[i] != 0 && p.rays.hit.geomID[i] != RTC_INVALID_GEOMETRY_ID;
    Vector3f at = pose.position.cast<float>();
    Vector3f normal(0, 0, 1);
    if (hits.hit[i]) {
      const Facet& facet = scene.facet(scene.facet_index(p.rays.hit.geomID[i], p.rays.hit.primID[i]));
      at += r.tfar[i] * way;
      const float towards = facet.normal.dot(way) / length;
      normal = towards > 0 ? Vector3f(-facet.normal) : facet.normal;
      Footprint pixel;
      pixel.depth_pixel = r.tfar[i] * table.pixel_m();
      pixel.cosine = std::max(std::abs(towards), 0.02F);
      const float flat = std::sqrt(std::max(1 - towards * towards, 1e-6F));
      pixel.along = (way / length - facet.normal * towards) / flat;
      reflected[i] = reflectance(facet, scene.material(facet), at, pixel);
    } else {
      reflected[i] = p.valid[i] != 0 ? sky_.radiance(way / length) : 0;
    }
    hits.px[i] = at.x();
    hits.py[i] = at.y();
    hits.pz[i] = at.z();
    hits.nx[i] = normal.x();
    hits.ny[i] = normal.y();
    hits.nz[i] = normal.z();
  }

  Lanes light;
  soft_light(hits, static_cast<float>(light_.ambient), lamps_, shadow_lamp_, light);
  add_hard_light(p, hits, light);
  for (std::size_t i = 0; i < kLanes; ++i) {
    if (hits.hit[i]) reflected[i] *= light[i];
  }
  if (scene.glass() != nullptr) tint_behind_glass(p, reflected);
  for (int i = 0; i < kLanes; ++i) {
    if (pixels.has(i)) out.at(pixels.column(i), pixels.row(i)) = reflected[static_cast<std::size_t>(i)];
  }
}

double Tracer::exact(std::uint32_t facet, const Vector3d& origin, const Vector3d& direction, double traced) const {
  const FacetPlane& plane = scene.plane(facet);
  const double t = (plane.distance - plane.normal.dot(origin)) / plane.normal.dot(direction);
  // A sliver's plane says little.
  return std::abs(t - traced) <= 1e-2 * traced ? t : traced;
}

void Tracer::depth(const RayTable& table, const CameraPose& pose, const PacketPixels& pixels, bool sees_glass,
                   ImageView<float> depth, ImageView<std::int16_t> thing) const {
  Packet p;
  aim(table, pose, pixels, p);
  intersect(p, sees_glass);
  for (int i = 0; i < kLanes; ++i) {
    if (!pixels.has(i)) continue;
    float& z = depth.at(pixels.column(i), pixels.row(i));
    std::int16_t& what = thing.at(pixels.column(i), pixels.row(i));
    if (p.rays.hit.geomID[i] == RTC_INVALID_GEOMETRY_ID) {
      z = kInfinity;
      what = kSky;
      continue;
    }
    const std::uint32_t facet = scene.facet_index(p.rays.hit.geomID[i], p.rays.hit.primID[i]);
    const std::ptrdiff_t at = static_cast<std::ptrdiff_t>(pixels.row(i)) * table.width() + pixels.column(i);
    const Vector3d way = pose.world_from_camera * Vector3d(table.x()[at], table.y()[at], 1);
    z = static_cast<float>(exact(facet, pose.position, way, p.rays.ray.tfar[i]));
    what = scene.facet(facet).thing;
  }
}

double Tracer::range(const Vector3d& origin, const Vector3d& direction, bool sees_glass) const {
  const Vector3d way = direction.normalized();
  RTCRayHit hit{};
  hit.ray.org_x = static_cast<float>(origin.x());
  hit.ray.org_y = static_cast<float>(origin.y());
  hit.ray.org_z = static_cast<float>(origin.z());
  hit.ray.dir_x = static_cast<float>(way.x());
  hit.ray.dir_y = static_cast<float>(way.y());
  hit.ray.dir_z = static_cast<float>(way.z());
  hit.ray.tfar = kInfinity;
  hit.ray.mask = ~0U;
  hit.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  hit.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcIntersect1(scene.still(), &context, &hit);
  if (scene.walking() != nullptr) rtcIntersect1(scene.walking(), &context, &hit);
  if (sees_glass && scene.glass() != nullptr) rtcIntersect1(scene.glass(), &context, &hit);
  if (hit.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::numeric_limits<double>::infinity();
  return exact(scene.facet_index(hit.hit.geomID, hit.hit.primID), origin, way, hit.ray.tfar);
}

double Tracer::sun_at(const Vector3d& position) const {
  if (!(light_.sun > 0)) return 0;
  return std::isinf(range(position, light_.sun_direction, false)) ? light_.sun : 0;
}

}  // namespace lakshya::sim
