#include "app/loop/perception.h"

#include <omp.h>

#include <algorithm>

#include "app/core/geometry.h"
#include "app/loop/memory_watch.h"
#include "app/nav/nearest_obstacle.h"
#include "hal/angle.h"

namespace lakshya {
namespace {

void fill(ImageView<std::uint8_t> image, std::uint8_t value) {
  for (int v = 0; v < image.height; ++v)
    std::ranges::fill(row_span(image, v), value);
}

}  // namespace

void Perception::warm_up() {
  constexpr std::uint8_t kGrey = 128;
  for (RawPair& raw : exchange_->raw.slots()) {
    fill(raw.left, kGrey);
    fill(raw.right, kGrey);
  }
  const RawPair& raw = exchange_->raw.slots()[0];
  for (int i = 0; i < 2; ++i)
    (void)pipeline_->process(raw.left, raw.right, {}, result_);
  pipeline_->begin_anew();
#pragma omp parallel
  {
    if (omp_get_thread_num() > 0) watch_this_thread(WatchedPlace::loop);
  }
}

PlanInput Perception::input(const PlanNote& plan, double target_m) const {
  const double turned = wrapped_angle(plan.pose.yaw - planned_yaw_);
  PlanInput input{.target = plan.target,
                  .target_distance_m = target_m,
                  .heading_change = turned,
                  .pose = MapPose{{plan.pose.east_m, plan.pose.north_m, plan.pose.yaw}, plan.taken}};
  if (has_direction_) input.previous = wrapped_angle(direction_ - turned);
  return input;
}

void Perception::describe(PlanNote& plan) const {
  const Plan& p = result_.plan;
  plan.blocked = p.blocked;
  plan.recovery = p.recovery;
  plan.hemmed_in = p.hemmed_in;
  plan.yields = p.yields;
  plan.direction = p.direction;
  plan.clear_m = p.clear_distance_m;
  plan.clear_end = p.clear_end;
  plan.speed_mps = p.speed_mps;
  plan.took = result_.times.frame();
  plan.ground_pitch_deg = pitch_deg_of_disparity16(*config_, pipeline_->camera(), result_.ground_offset16);
  const NearestObstacle nearest = nearest_obstacle(result_.map, result_.grid.geometry);
  plan.obstacles = nearest.cells;
  plan.nearest_m = nearest.distance_m;
}

bool Perception::step(PlanNote& plan) {
  if (!exchange_->raw.take()) return false;
  const RawPair& raw = exchange_->raw.reading();
  (void)exchange_->nav.take();
  const NavNote& nav = exchange_->nav.reading();
  plan = {.number = raw.number,
          .taken = raw.taken,
          .arrived = raw.arrived,
          .started = clock_->now(),
          .pose = nav.history.at_time(raw.taken)};
  plan.target = wrapped_angle(nav.target + nav.pose.yaw - plan.pose.yaw);
  exchange_->looked_at.store(raw.number, std::memory_order_release);
  exchange_->working_since.store(plan.started, std::memory_order_release);
  plan.status = pipeline_->process(raw.left, raw.right, input(plan, nav.target_m), result_);
  if (plan.status == Status::ok) {
    describe(plan);
    planned_yaw_ = plan.pose.yaw;
    has_direction_ = !plan.blocked;
    direction_ = plan.direction;
    if (sink_ != nullptr) sink_->on_frame(result_, plan);
  }
  ++frames_;
  plan.done = clock_->now();
  exchange_->working_since.store(0, std::memory_order_release);
  return true;
}

void Perception::publish(const PlanNote& plan) {
  (void)exchange_->plans.push(plan);
  if (!copies_maps_ || plan.status != Status::ok) return;
  MapNote& map = exchange_->map.writing();
  map.plan = plan;
  for (int v = 0; v < map.type.height; ++v)
    std::ranges::copy(row_span(result_.map, v), map.type.row(v));
  (void)exchange_->map.publish();
}

}  // namespace lakshya
