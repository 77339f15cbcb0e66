// Where somebody is who walks to and fro, and that he minds the vehicle.
#pragma once

#include <cstddef>
#include <vector>

#include "app/tools/sim/world.h"

namespace lakshya::sim {

// On the way there and back, `start_m` + speed x time along it, facing the direction of motion. A walk of length 0 stays at its
// first point and faces east.
Place place_on_walk(const Walk& walk, double time_s);

// When it is for each of World::things on his walk: the same for all, or, where the vehicle was in somebody's way, a time of his own.
class WalkTimes {
 public:
  WalkTimes(double time_s = 0) : time_s_(time_s) {}  // NOLINT(google-explicit-constructor): a time is one for all
  explicit WalkTimes(std::vector<double> own) : own_(std::move(own)) {}

  double of(std::size_t thing) const { return thing < own_.size() ? own_[thing] : time_s_; }

 private:
  double time_s_ = 0;
  std::vector<double> own_;
};

// A person does not walk into a vehicle that he sees: with it less than Walk::halts_m before him he stands still, and after a while
// he turns round. What comes at him from the side or from behind he does not see, nor does he step aside.
class Walkers {
 public:
  explicit Walkers(const World& world);

  // On to `time_s`, with the vehicle at (x, y); earlier times change nothing. In order of time.
  void step(double time_s, double x, double y, double vehicle_radius_m);

  WalkTimes times() const { return WalkTimes(own_s_); }

 private:
  const World* world_;
  double time_s_ = 0;
  std::vector<double> own_s_;   // of each thing
  std::vector<double> halted_;  // for how long, s
};

}  // namespace lakshya::sim
