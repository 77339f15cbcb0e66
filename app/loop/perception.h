// The second thread's work: a raw pair through the pipeline to a plan.
#pragma once

#include "app/core/pipeline.h"
#include "app/loop/messages.h"

namespace lakshya {

// Is shown every result before the next pair is begun, in perception's thread: for recordings on the virtual clock.
class FrameSink {
 public:
  virtual ~FrameSink() = default;
  virtual void on_frame(const FrameResult& frame, const PlanNote& plan) = 0;
};

class Perception {
 public:
  // All of them outlive it.
  Perception(const VehicleConfig& config, Pipeline& pipeline, const Clock& clock, Exchange& exchange)
      : config_(&config), pipeline_(&pipeline), clock_(&clock), exchange_(&exchange) {}

  // Makes OpenMP's threads and touches all memory, by processing two grey pairs of the raw pairs' size.
  void warm_up();

  // The newest pair that was not looked at yet, if there is one. `plan` is what it gave; nothing is handed over.
  bool step(PlanNote& plan);

  // Hands a plan over to control.
  void publish(const PlanNote& plan);

  // Results are shown to it; null: to nobody.
  void show(FrameSink* sink) { sink_ = sink; }
  // Every map is copied for whoever draws.
  void copy_maps(bool on) { copies_maps_ = on; }

  std::uint64_t frames() const { return frames_; }
  const StageTimes& times() const { return pipeline_->times(); }

 private:
  PlanInput input(const PlanNote& plan, double target_m) const;
  void describe(PlanNote& plan) const;

  const VehicleConfig* config_;
  Pipeline* pipeline_;
  const Clock* clock_;
  Exchange* exchange_;
  FrameSink* sink_ = nullptr;
  bool copies_maps_ = false;
  FrameResult result_;
  std::uint64_t frames_ = 0;
  double planned_yaw_ = 0;      // of the plan before
  bool has_direction_ = false;  // and whether it chose one
  double direction_ = 0;
};

}  // namespace lakshya
