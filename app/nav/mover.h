// What moves near the vehicle: found by motion_watch.h, given way to by give_way.h.
#pragma once

namespace lakshya {

inline constexpr int kMostMovers = 8;

// Something that moves, at the time and in the world frame of the last frame's pose.
struct Mover {
  double east_m = 0;  // the middle of what was seen of it
  double north_m = 0;
  double east_mps = 0;
  double north_mps = 0;
  double unseen_s = 0;  // since it was last measured; it is then where its velocity has carried it
  bool lost_way =
      false;  // found again after a while out of view: the velocity is not known yet, only how fast it was
};

}  // namespace lakshya
