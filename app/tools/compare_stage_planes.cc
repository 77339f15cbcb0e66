#include "app/tools/compare_stage_planes.h"

namespace lakshya {
namespace {

Plane classes_plane(const ImageView<const PixelClass>& classes) {
  return plane_of("class", classes);
}

void add_counts(Planes& planes, const PixelCounts& counts) {
  planes.push_back(list_of("pixels by class", counts.by_class));
  planes.push_back(list_of("pixels by reason", counts.by_reason));
}

void add_grid(Planes& planes, const ImageView<const std::uint32_t>& count,
              const ImageView<const std::int64_t>& height_sum, const ImageView<const std::uint32_t>& floor_count,
              const ImageView<const std::uint32_t>& below_count) {
  planes.push_back(plane_of("points", count));
  planes.push_back(plane_of("height sum mm", height_sum));
  planes.push_back(plane_of("floor count", floor_count));
  planes.push_back(plane_of("below count", below_count));
}

void add_plan(Planes& planes, const Plan& plan) {
  planes.push_back(list_of("histogram", plan.histogram));
  planes.push_back(list_of("blocked sector", plan.binary));
  planes.push_back(list_of("masked sector", plan.masked));
  planes.push_back(list_of("seen sector", plan.seen));
  planes.push_back(list_of("selectable sector", plan.selectable));
  constexpr int kNumbers = 9;
  planes.push_back({"blocked, recovery, direction, clear distance, its end, speed, turn rate, wheels", kNumbers, 1,
                    [&plan](int i, int) {
                      const double numbers[kNumbers] = {plan.blocked ? 1.0 : 0.0,
                                                        static_cast<double>(plan.recovery),
                                                        plan.direction,
                                                        plan.clear_distance_m,
                                                        static_cast<double>(plan.clear_end),
                                                        plan.speed_mps,
                                                        plan.turn_rate_rps,
                                                        plan.wheels.left_mps,
                                                        plan.wheels.right_mps};
                      return numbers[i];
                    }});
}

}  // namespace

Planes rectify_planes(const StageOutputs& o) {
  return {plane_of("left", o.left.view()), plane_of("right", o.right.view())};
}

Planes census_planes(const StageOutputs& o) {
  return {plane_of("left", o.left_codes.view()), plane_of("right", o.right_codes.view())};
}

Planes texture_planes(const StageOutputs& o) {
  return {plane_of("textured", o.textured.view())};
}

Planes edge_log_planes(const StageOutputs& o) {
  return {plane_of("left", o.left_log.view()), plane_of("right", o.right_log.view())};
}

Planes edge_sobel_planes(const StageOutputs& o) {
  return {plane_of("left", o.left_sobel.view()), plane_of("right", o.right_sobel.view())};
}

Planes sgm_planes(const StageOutputs& o) {
  return {plane_of("disparity", o.matched[0].view())};
}

Planes census_block_planes(const StageOutputs& o) {
  return {plane_of("disparity", o.matched[1].view())};
}

Planes sad_block_planes(const StageOutputs& o) {
  return {plane_of("disparity", o.matched[2].view())};
}

Planes support_planes(const StageOutputs& o) {
  Planes planes;
  for (std::size_t m = 0; m < kComparedMatchers.size(); ++m)
    planes.push_back(plane_of(std::string(kComparedMatchers[m]) + " disparity", o.supported[m].view()));
  return planes;
}

Planes ground_planes(const StageOutputs& o) {
  return {list_of("residuals", o.residuals), list_of("offset", o.ground_offset16)};
}

Planes project_planes(const StageOutputs& o) {
  Planes planes{classes_plane(o.classes.view())};
  add_counts(planes, o.counts);
  const OwnedGrid& g = o.binned;
  add_grid(planes, g.count.view(), g.height_sum.view(), g.floor_count.view(), g.below_count.view());
  return planes;
}

Planes score_planes(const StageOutputs& o) {
  return {plane_of("type", o.scored.type.view())};
}

Planes polar_histogram_planes(const StageOutputs& o) {
  return {list_of("sector", o.polar_histogram)};
}

Planes frame_planes(const StageOutputs& o) {
  const FrameResult& f = o.frame;
  Planes planes{plane_of("left", f.left),
                plane_of("right", f.right),
                plane_of("disparity", f.disparity),
                {"ground offset", 1, 1, [&f](int, int) { return static_cast<double>(f.ground_offset16); }},
                classes_plane(f.classes)};
  add_counts(planes, f.pixels);
  add_grid(planes, f.grid.count, f.grid.height_sum, f.grid.floor_count, f.grid.below_count);
  planes.push_back(plane_of("type", f.grid.type));
  add_plan(planes, f.plan);
  return planes;
}

}  // namespace lakshya
