// The tracks of motion_watch.h.
#include <algorithm>
#include <cmath>
#include <limits>

#include "app/nav/motion_watch.h"

namespace lakshya {
namespace {

constexpr double kNanosecond = 1e-9;
constexpr double kAlpha = 0.5;
constexpr double kAlphaCut = 0.2;
constexpr double kBeta = 0.25;
constexpr double kGateM = 0.35;
constexpr double kWidestGateM = 1.0;
constexpr double kLostS = 0.5;    // unseen for longer, and the velocity is not believed any more
constexpr int kAbsentFrames = 4;  // until a track ends that should be seen and is not
constexpr int kSlowHits = 8;      // until a mover has stopped
constexpr double kSlowMps = 0.12;
constexpr double kFoundM = 0.2;  // gone in kFoundS, and one that was lost is found
constexpr double kFoundS = 1.0;
constexpr double kTrialS = 1.5;     // in which a track must have gone kConfirmM
constexpr double kStandsMps = 0.1;  // the vehicle itself

}  // namespace

void MotionWatch::predict(double dt_s) {
  for (Track& t : tracks_) {
    t.east_m += t.east_mps * dt_s;
    t.north_m += t.north_mps * dt_s;
  }
}

MotionWatch::Track MotionWatch::begun(const Cluster& c, std::int64_t time_ns) {
  return {.alive = true,
          .hits = 1,
          .cells = c.cells,
          .east_m = c.east_m,
          .north_m = c.north_m,
          .from_east_m = c.east_m,
          .from_north_m = c.north_m,
          .from_ns = time_ns,
          .seen_ns = time_ns};
}

void MotionWatch::measure(Track& t, const Cluster& c, std::int64_t time_ns, double dt_s) {
  const double unseen_s = static_cast<double>(time_ns - t.seen_ns) * kNanosecond;
  // The border of the view sweeps along what stands.
  if (!t.moves && c.cut && (turns_ || speed_mps_ > kStandsMps)) {
    t = begun(c, time_ns);
    return;
  }
  if (t.moves && unseen_s > kLostS) {
    const double pace_mps = std::max(std::hypot(t.east_mps, t.north_mps), t.pace_mps);
    t = begun(c, time_ns);
    t.moves = t.lost_way = true;
    t.pace_mps = pace_mps;
    return;
  }
  t.seen_ns = time_ns;
  t.absent = 0;
  t.cells = std::max(t.cells, c.cells);
  ++t.hits;
  const double east = c.east_m - t.east_m;
  const double north = c.north_m - t.north_m;
  const bool holds_on = c.cut && t.moves;
  const double gain = holds_on ? 0 : kBeta / std::max(dt_s, 0.02);
  const double alpha = holds_on ? kAlphaCut : kAlpha;
  t.east_m += alpha * east;
  t.north_m += alpha * north;
  t.east_mps += gain * east;
  t.north_mps += gain * north;
}

void MotionWatch::associate(std::int64_t time_ns, double dt_s) {
  std::array<bool, kMostMovers> given{};
  for (int round = 0; round < kMostMovers; ++round) {
    double best = std::numeric_limits<double>::infinity();
    std::size_t track = 0;
    std::size_t cluster = 0;
    for (std::size_t i = 0; i < tracks_.size(); ++i) {
      const Track& t = tracks_[i];
      if (!t.alive || given[i]) continue;
      const double unseen_s = static_cast<double>(time_ns - t.seen_ns) * kNanosecond - dt_s;
      const double pace = std::max(std::hypot(t.east_mps, t.north_mps), 0.5);
      // One that was lost may have turned round: twice the way that it was thought to go.
      const double gate = std::min(kGateM + (t.moves ? 2 * pace * std::max(0.0, unseen_s) : 0.0), kWidestGateM);
      for (std::size_t k = 0; k < cluster_count_; ++k) {
        const double d = std::hypot(clusters_[k].east_m - t.east_m, clusters_[k].north_m - t.north_m);
        if (clusters_[k].used || d > gate || d >= best) continue;
        best = d;
        track = i;
        cluster = k;
      }
    }
    if (best == std::numeric_limits<double>::infinity()) break;
    given[track] = true;
    clusters_[cluster].used = true;
    Track& t = tracks_[track];
    const double was_east = t.east_m - t.east_mps * dt_s;
    const double was_north = t.north_m - t.north_mps * dt_s;
    measure(t, clusters_[cluster], time_ns, dt_s);
    if (t.hits > 1) t.way_m += std::hypot(t.east_m - was_east, t.north_m - was_north);
  }
}

void MotionWatch::begin_tracks(std::int64_t time_ns) {
  for (std::size_t k = 0; k < cluster_count_; ++k) {
    if (clusters_[k].used || !clusters_[k].fresh) continue;
    const auto slot = std::ranges::find(tracks_, false, &Track::alive);
    if (slot == tracks_.end()) return;
    *slot = begun(clusters_[k], time_ns);
  }
}

bool MotionWatch::confirmed(const Track& t) const {
  const double gone_m = std::hypot(t.east_m - t.from_east_m, t.north_m - t.from_north_m);
  const double speed = std::hypot(t.east_mps, t.north_mps);
  const double least_m = std::max(kConfirmM, kConfirmSigmas * depth_error_m(t.east_m, t.north_m));
  const double along = (t.east_m - t.from_east_m) * t.east_mps + (t.north_m - t.from_north_m) * t.north_mps;
  return t.hits >= kConfirmHits && t.cells >= kConfirmCells && gone_m >= least_m && gone_m >= kStraight * t.way_m &&
         speed >= kConfirmMps && speed <= kMostMps && along >= kAlongCosine * gone_m * speed &&
         seen_near(t.from_east_m, t.from_north_m, 1) != old;
}

void MotionWatch::judge(Track& t, std::int64_t time_ns) {
  const double unseen_s = static_cast<double>(time_ns - t.seen_ns) * kNanosecond;
  const bool measured = t.seen_ns == time_ns;
  const double speed = std::hypot(t.east_mps, t.north_mps);
  if (!measured && seen_near(t.east_m, t.north_m, 2) == free) ++t.absent;
  if (t.lost_way) {
    const double gone_m = std::hypot(t.east_m - t.from_east_m, t.north_m - t.from_north_m);
    if (t.hits >= kConfirmHits && gone_m > kFoundM) t.lost_way = false;
    if (t.lost_way && static_cast<double>(time_ns - t.from_ns) * kNanosecond > kFoundS) t = {};
    return;
  }
  if (t.moves) {
    t.slow = !measured || speed > kSlowMps ? 0 : t.slow + 1;
    const std::int64_t remembered_ns = std::min(kRememberedNs, t.hits * kRememberedPerHitNs);
    if (t.absent >= kAbsentFrames || time_ns - t.seen_ns > remembered_ns || t.slow >= kSlowHits || speed > kMostMps)
      t = {};
    return;
  }
  if (unseen_s > kLostS || t.absent >= kAbsentFrames || speed > 2 * kMostMps) {
    t = {};
    return;
  }
  if (measured && confirmed(t)) {
    t.moves = true;
  } else if (static_cast<double>(time_ns - t.from_ns) * kNanosecond > kTrialS) {
    t.from_east_m = t.east_m;
    t.from_north_m = t.north_m;
    t.from_ns = time_ns;
    t.way_m = 0;
  }
}

void MotionWatch::list_movers(std::int64_t time_ns) {
  mover_count_ = 0;
  for (const Track& t : tracks_) {
    if (!t.alive || !t.moves) continue;
    Mover m{.east_m = t.east_m,
            .north_m = t.north_m,
            .east_mps = t.east_mps,
            .north_mps = t.north_mps,
            .unseen_s = static_cast<double>(time_ns - t.seen_ns) * kNanosecond,
            .lost_way = t.lost_way};
    if (t.lost_way) {
      m.east_mps = t.pace_mps;
      m.north_mps = 0;
    }
    movers_[mover_count_++] = m;
  }
}

}  // namespace lakshya
