#include "app/tools/sim/mesh_builder.h"

#include <cmath>
#include <numbers>

namespace lakshya::sim {

void MeshBuilder::surface(const Surface& surface) {
  surfaces_.push_back(surface);
}

std::uint32_t MeshBuilder::vertex(const Point& point) {
  points_.push_back(point);
  return static_cast<std::uint32_t>(points_.size() - 1);
}

void MeshBuilder::triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
  if (surfaces_.empty()) surfaces_.emplace_back();
  triangles_.push_back({a, b, c});
  surface_of_.push_back(static_cast<std::uint16_t>(surfaces_.size() - 1));
}

void MeshBuilder::triangle(const Point& a, const Point& b, const Point& c) {
  const std::uint32_t i = vertex(a);
  const std::uint32_t j = vertex(b);
  triangle(i, j, vertex(c));
}

void MeshBuilder::box(const Point& low, const Point& high) {
  std::array<std::uint32_t, 8> v{};  // bit 0: high x, bit 1: high y, bit 2: high z
  for (std::size_t i = 0; i < v.size(); ++i) {
    v[i] = vertex({(i & 1U) != 0 ? high.x() : low.x(), (i & 2U) != 0 ? high.y() : low.y(),
                   (i & 4U) != 0 ? high.z() : low.z()});
  }
  constexpr std::array<std::array<std::size_t, 4>, 6> kFaces{
      {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}};
  for (const auto& f : kFaces) {
    triangle(v[f[0]], v[f[1]], v[f[2]]);
    triangle(v[f[0]], v[f[2]], v[f[3]]);
  }
}

void MeshBuilder::frustum(double x, double y, double z0, double z1, double radius0, double radius1, int sides) {
  std::vector<std::vector<Point>> rows;
  for (const auto& [z, radius] : {std::pair{z0, radius0}, std::pair{z1, radius1}}) {
    if (radius <= 0) continue;
    auto& row = rows.emplace_back();
    for (int i = 0; i < sides; ++i) {
      const double angle = 2 * std::numbers::pi * i / sides;
      row.emplace_back(x + radius * std::cos(angle), y + radius * std::sin(angle), z);
    }
  }
  closed_rows(rows, {x, y, z0}, {x, y, z1});
}

void MeshBuilder::ellipsoid(const Point& centre, const Point& radii, int rings, int sides) {
  std::vector<std::vector<Point>> rows;
  for (int r = 1; r <= rings; ++r) {
    const double polar = std::numbers::pi * (static_cast<double>(r) / (rings + 1) - 0.5);
    auto& row = rows.emplace_back();
    for (int i = 0; i < sides; ++i) {
      const double angle = 2 * std::numbers::pi * i / sides;
      const Point unit{std::cos(polar) * std::cos(angle), std::cos(polar) * std::sin(angle), std::sin(polar)};
      row.emplace_back(centre + radii.cwiseProduct(unit));
    }
  }
  const Point up{0, 0, radii.z()};
  closed_rows(rows, centre - up, centre + up);
}

void MeshBuilder::closed_rows(const std::vector<std::vector<Point>>& rows, const Point& south, const Point& north) {
  std::vector<std::vector<std::uint32_t>> index;
  for (const auto& row : rows) {
    auto& of_row = index.emplace_back();
    for (const Point& p : row)
      of_row.push_back(vertex(p));
  }
  const std::uint32_t bottom = vertex(south);
  const std::uint32_t top = vertex(north);
  const std::size_t n = rows.front().size();
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t j = (i + 1) % n;
    triangle(bottom, index.front()[j], index.front()[i]);
    triangle(top, index.back()[i], index.back()[j]);
    for (std::size_t r = 0; r + 1 < rows.size(); ++r) {
      triangle(index[r][i], index[r][j], index[r + 1][j]);
      triangle(index[r][i], index[r + 1][j], index[r + 1][i]);
    }
  }
}

Mesh MeshBuilder::placed(const Spot& spot) const {
  Mesh mesh;
  const double c = std::cos(spot.yaw);
  const double s = std::sin(spot.yaw);
  mesh.vertices.reserve(points_.size());
  for (const Point& p : points_) {
    const Point moved{spot.x + c * p.x() - s * p.y(), spot.y + s * p.x() + c * p.y(), spot.bottom_m + p.z()};
    mesh.vertices.push_back(moved.cast<float>());
  }
  mesh.triangles = triangles_;
  mesh.surface = surface_of_;
  mesh.surfaces = surfaces_;
  return mesh;
}

}  // namespace lakshya::sim
