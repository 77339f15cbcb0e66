#include "app/tools/sim/ground_mesh.h"

#include <algorithm>
#include <cstddef>

namespace lakshya::sim {
namespace {

std::vector<double> cuts_between(double low, double high, std::vector<double> cuts) {
  std::erase_if(cuts, [&](double c) { return c <= low || c >= high; });
  cuts.push_back(low);
  cuts.push_back(high);
  std::sort(cuts.begin(), cuts.end());
  cuts.erase(std::unique(cuts.begin(), cuts.end()), cuts.end());
  return cuts;
}

// What lies on a cell: the patch's number + 1, 0 for the plain ground.
class Cover {
 public:
  Cover(const Ground& ground, std::size_t index) : patch_(index == 0 ? nullptr : &ground.patches[index - 1]) {}
  Eigen::Vector3f point(double x, double y) const {
    const double z = patch_ == nullptr ? 0
                                       : patch_->height_m + patch_->slope_x * (x - patch_->x0) +
                                             patch_->slope_y * (y - patch_->y0);
    return Eigen::Vector3d(x, y, z).cast<float>();
  }

 private:
  const GroundPatch* patch_;
};

class Builder {
 public:
  explicit Builder(const Ground& ground) : ground_(ground) {
    mesh.surfaces.push_back(ground.surface);
    for (const GroundPatch& p : ground.patches)
      mesh.surfaces.push_back(p.surface);
  }

  void add(const Eigen::Vector3f& a, const Eigen::Vector3f& b, const Eigen::Vector3f& c, std::size_t surface) {
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    mesh.vertices.insert(mesh.vertices.end(), {a, b, c});
    mesh.triangles.push_back({first, first + 1, first + 2});
    mesh.surface.push_back(static_cast<std::uint16_t>(surface));
  }

  void cell(double x0, double y0, double x1, double y1, std::size_t index) {
    const Cover cover(ground_, index);
    add(cover.point(x0, y0), cover.point(x1, y0), cover.point(x1, y1), index);
    add(cover.point(x0, y0), cover.point(x1, y1), cover.point(x0, y1), index);
  }

  // Between two cells, along the edge from (x0, y0) to (x1, y1).
  void wall(double x0, double y0, double x1, double y1, std::size_t one, std::size_t other) {
    if (one == other) return;
    const std::size_t surface = std::max(one, other);
    const Eigen::Vector3f a0 = Cover(ground_, one).point(x0, y0);
    const Eigen::Vector3f a1 = Cover(ground_, one).point(x1, y1);
    const Eigen::Vector3f b0 = Cover(ground_, other).point(x0, y0);
    const Eigen::Vector3f b1 = Cover(ground_, other).point(x1, y1);
    const float gap0 = a0.z() - b0.z();
    const float gap1 = a1.z() - b1.z();
    if (gap0 * gap1 < 0) {  // the planes cross on the way
      const Eigen::Vector3f cross = a0 + (a1 - a0) * (gap0 / (gap0 - gap1));
      add(a0, b0, cross, surface);
      add(a1, b1, cross, surface);
      return;
    }
    if (gap0 != 0) add(a0, b0, a1, surface);
    if (gap1 != 0) add(a1, b0, b1, surface);
  }

  Mesh mesh;

 private:
  const Ground& ground_;
};

}  // namespace

Mesh ground_mesh(const Ground& ground) {
  std::vector<double> xs;
  std::vector<double> ys;
  for (const GroundPatch& p : ground.patches) {
    xs.insert(xs.end(), {p.x0, p.x1});
    ys.insert(ys.end(), {p.y0, p.y1});
  }
  xs = cuts_between(ground.x0, ground.x1, std::move(xs));
  ys = cuts_between(ground.y0, ground.y1, std::move(ys));

  Builder builder(ground);
  const std::size_t columns = xs.size() - 1;
  const std::size_t rows = ys.size() - 1;
  std::vector<std::size_t> cover(columns * rows);
  for (std::size_t j = 0; j < rows; ++j) {
    for (std::size_t i = 0; i < columns; ++i) {
      const GroundPatch* p = patch_at(ground, (xs[i] + xs[i + 1]) / 2, (ys[j] + ys[j + 1]) / 2);
      const std::size_t index = p == nullptr ? 0 : static_cast<std::size_t>(p - ground.patches.data()) + 1;
      cover[j * columns + i] = index;
      builder.cell(xs[i], ys[j], xs[i + 1], ys[j + 1], index);
      if (i > 0) builder.wall(xs[i], ys[j], xs[i], ys[j + 1], cover[j * columns + i - 1], index);
      if (j > 0) builder.wall(xs[i], ys[j], xs[i + 1], ys[j], cover[(j - 1) * columns + i], index);
    }
  }
  return std::move(builder.mesh);
}

}  // namespace lakshya::sim
