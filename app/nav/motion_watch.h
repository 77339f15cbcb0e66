// Finds what moves near the vehicle in the frames' obstacle cells (detection and tracking of moving objects): docs/contract.md section 5.
//
// Evidence. A window of kWatchSide cells about the vehicle, fixed to the odometric world and rolled with it, remembers when each cell
// was last seen free and for how many frames in a row. A cell that is an obstacle now, was seen free within kFreshNs, and in kFreeFrames
// frames before that, is fresh: something has come there. One beside an obstacle cell that was not seen free is that thing's edge, which
// comes and goes with the cells' rounding and the pose's drift, and counts no more. Fresh cells at most two cells apart are a
// cluster; those of person size and not just above the floor are measurements. Cells that were free for fewer frames belong to
// clusters, too, but begin no track: where somebody has turned round he comes back over ground that he has just left.
// Tracks. Alpha-beta filters of position and velocity, each measurement given to the nearest track whose gate holds it. A track is a
// mover after kConfirmHits measurements when it has gone kConfirmM nearly straight away from a place that is no obstacle any more. It is
// none any more when it has stopped, when the place where it should be is seen free, or when nobody has seen it for kRememberedNs.
// At the border of the view, and where no floor is seen before the vehicle, a mover keeps its velocity: what is left of it there
// moves with the border.
//
// All work and memory are bounded; nothing is allocated. Lengths in metres, angles in radians, times in nanoseconds.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "app/nav/mover.h"
#include "app/nav/rolling_map.h"
#include "kernels/base/nav_grid.h"
#include "kernels/base/status.h"

namespace lakshya {

inline constexpr int kWatchSide = 128;  // cells
inline constexpr std::size_t kWatchCells = std::size_t{kWatchSide} * kWatchSide;

// What the camera sees; lengths from the turning centre.
struct MotionWatchParams {
  double forward_m = 0;
  double left_m = 0;
  double yaw = 0;          // positive to the left
  double view = 0.6;       // half of its field of view, in (0, 1.5]
  double blind_m = 1.0;    // nearer than this it sees no floor
  double depth_sigma = 0;  // standard deviation of a depth at 1 m: RollingMapParams
};

// The caller's, kWatchCells each.
struct MotionWatchMemory {
  std::span<std::uint32_t> free_at;  // when last seen free, ticks; 0: never
  std::span<std::uint8_t> free_run;  // frames in a row that saw it free, and whether it was an obstacle since
  std::span<std::uint8_t> now;       // what the last frame showed there
};

class MotionWatch {
 public:
  static constexpr std::int64_t kTickNs = 10'000'000;
  static constexpr std::int64_t kFreshNs = 1'600'000'000;
  static constexpr std::int64_t kRememberedNs = 4'500'000'000;
  static constexpr std::int64_t kRememberedPerHitNs = 250'000'000;  // at most for each time that it was seen
  static constexpr double kReachM = 6;                              // farther obstacle cells are not looked at
  static constexpr double kLeastMeanHeightM = 0.15;                 // of a cluster
  static constexpr double kMostExtentM = 1.0;
  static constexpr int kLeastCells = 2;
  static constexpr int kConfirmCells = 4;  // in the largest of a track's clusters
  static constexpr int kFreeFrames = 5;
  static constexpr int kMostFresh = 512;  // a frame with more has lost its pose or its floor, and shows no motion
  static constexpr int kMostClusters = 16;
  static constexpr int kConfirmHits = 4;
  static constexpr double kConfirmM = 0.35;
  static constexpr double kConfirmSigmas = 3;  // ... and so many standard deviations of the depth there
  static constexpr double kConfirmMps = 0.2;
  static constexpr double kMostMps = 2.5;
  static constexpr double kAlongCosine = 0.8;  // of the largest angle between the way gone and the velocity
  static constexpr double kStraight = 0.7;     // least share of the way gone that is left between its ends

  // geometry: of the frames. bad_argument: no such grid or camera; size_mismatch: the memory. Forgets everything. Keeps the memory.
  Status configure(const MotionWatchParams& params, const GridGeometry& geometry, const MotionWatchMemory& memory);
  void reset();

  // Takes a frame in: type, count and height_sum are read. Poses in order of time; one that is not later than the last begins anew.
  // bad_argument: not of the geometry, or a pose that is not finite or beyond 10^8 cells; all is then as before.
  Status add(const NavGrid& frame, const MapPose& at);

  std::span<const Mover> movers() const { return {movers_.data(), mover_count_}; }
  // The vehicle's own, between the last two poses.
  double speed_mps() const { return speed_mps_; }

 private:
  enum Seen : std::uint8_t { nothing, free, old, fresh, again, edge, taken };

  struct Cluster {
    double east_m = 0;
    double north_m = 0;
    int cells = 0;
    bool fresh = false;  // else what came is not new there: it follows a mover, but begins no track
    bool cut = false;    // by the border of the view, perhaps
    bool used = false;
  };

  struct Track {
    bool alive = false;
    bool moves = false;
    bool lost_way = false;
    int hits = 0;
    int cells = 0;   // of its largest cluster
    int absent = 0;  // frames in a row that show nothing where it should be
    int slow = 0;    // measurements in a row without speed
    double east_m = 0, north_m = 0, east_mps = 0, north_mps = 0;
    double pace_mps = 0;                       // before it was lost
    double from_east_m = 0, from_north_m = 0;  // where its way began, for the confirmation
    double way_m = 0;
    std::int64_t from_ns = 0;
    std::int64_t seen_ns = 0;
  };

  struct Sums;
  std::size_t index(std::int64_t x, std::int64_t y) const;
  bool holds(std::int64_t x, std::int64_t y) const;
  void roll(std::int64_t x, std::int64_t y);
  void look(const NavGrid& frame, const Pose& pose, std::uint32_t tick);
  void find_clusters(const NavGrid& frame, const Pose& pose);
  void grow(std::int64_t x, std::int64_t y, Sums& sums);
  Seen seen_near(double east_m, double north_m, int reach) const;
  void predict(double dt_s);
  void associate(std::int64_t time_ns, double dt_s);
  double depth_error_m(double east_m, double north_m) const;
  bool is_cut(const Pose& pose, double east_m, double north_m) const;
  static Track begun(const Cluster& cluster, std::int64_t time_ns);
  void measure(Track& track, const Cluster& cluster, std::int64_t time_ns, double dt_s);
  void begin_tracks(std::int64_t time_ns);
  void judge(Track& track, std::int64_t time_ns);
  bool confirmed(const Track& track) const;
  void list_movers(std::int64_t time_ns);

  MotionWatchParams params_;
  GridGeometry geometry_;
  MotionWatchMemory memory_;
  double cell_m_ = 0.1;
  bool started_ = false;
  MapPose at_;
  std::int64_t first_ns_ = 0;
  double speed_mps_ = 0;
  bool turns_ = false;
  std::int64_t x_begin_ = 0;  // world cells of the window's corner
  std::int64_t y_begin_ = 0;
  std::array<std::int32_t, kMostFresh> fresh_{};  // their places in the window, v * kWatchSide + u
  int fresh_count_ = 0;
  std::array<Cluster, kMostClusters> clusters_{};
  std::size_t cluster_count_ = 0;
  std::array<Track, kMostMovers> tracks_{};
  std::array<Mover, kMostMovers> movers_{};
  std::size_t mover_count_ = 0;
};

}  // namespace lakshya
