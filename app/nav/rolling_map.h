// The map that remembers: docs/contract.md section 4. A square of cells fixed to the odometric world, rolled by whole cells as the
// vehicle moves; what leaves it is forgotten. Each cell holds integer evidence: nothing here depends on the number of threads.
//
// Evidence. A frame's obstacle cell adds to the world cell that holds its centre: kBelieved within near_m plus the braking
// distance, beyond that less with distance, at least kBelieved / far_hits, and up to kMostHits times that. A cell with kBelieved is
// an obstacle, with less it is unknown. A world cell whose centre lies in an unoccupied cell of the frame loses kCleared at once, or
// less from far away, and is unoccupied when nothing is left. Unknown cells of a frame change nothing: what the camera does not see
// (blind zone, beside, behind) stays for keep_s, an obstacle for keep_s for each kBelieved of its evidence, and what is within blind_m
// for as long as the vehicle is there.
// Ground near by that the camera looks at, and nothing hides, and that kDoubts frames in a row do not show is unknown: floor that a
// matcher went on with into a wall that shows nothing is seen from far away only, and from there does not count again for a while.
// Floor that goes on into unknown cells within kBorderRows of the image does not count there: a matcher's window reaches across the
// border of what it can match, so that floor seems to go on into a wall that shows nothing.
// Floor seen below something does not clear it: an obstacle loses evidence only where the camera's upper edge, as far away as the
// cell is, lies above the greatest mean height that the cell was seen with. So a bar or a table top that has left the image at
// the top stays. Behind the face of what hangs, with floor in view below it, kBody cells get the same evidence: a look at the floor could
// not show the rest of it. What is higher than kHangingMm must also not be seen any more where it was (depth_view.h): a board shows
// few pixels and much floor behind and below them. Where there is nothing to be seen it loses less. Where no floor is seen, as in the
// blind zone, it loses kCleared while what lies behind it is seen, and leaves unknown ground: who stood right before the vehicle has gone.
// With `trim`, an obstacle cell that a frame does not show, though it shows its neighbour, which is no nearer, loses kTrimmed: a thing
// seen from several places is else drawn out by one cell to each side, and a gap of 1 m closes.
// What came to ground that was seen free before, was_free(), may go again: the planner doubts it first.
// What is an obstacle below the vehicle, kSunk cells or more within its radius, cannot be there and is forgotten; what is at its edge
// may touch it and stays. Unknown ground below it stays unknown: it says nothing about the way on.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>

#include "app/nav/depth_view.h"
#include "app/nav/shadow.h"
#include "app/nav/way_point.h"
#include "kernels/base/image_view.h"
#include "kernels/base/nav_grid.h"
#include "kernels/base/status.h"

namespace lakshya {

// Where a frame was taken.
struct MapPose {
  Pose pose;
  std::int64_t time_ns = 0;  // on any one clock
};

// What the camera's upper edge sees. Lengths in metres from the ground below the turning centre, angles in radians.
struct UpperEdge {
  double height_m = 0.6;
  double forward_m = 0;
  double left_m = 0;
  double yaw = 0;    // positive to the left
  double angle = 0;  // of the upper edge above the horizon, pitch included; within +-1.5
};

struct RollingMapParams {
  double size_m = 50;       // side of the square
  double keep_s = 20;       // what was not seen for so long is forgotten
  double blind_m = 1.0;     // what is nearer than this does not age: nothing could show whether it is still there
  double near_m = 1.5;      // nearer than this plus the braking distance an obstacle is believed at once
  int far_hits = 2;         // frames that must see it anywhere, 1 to kBelieved
  double latency_s = 0.25;  // of braking
  double deceleration_mps2 = 2.0;  // of braking, > 0
  double radius_m = 0.35;          // the vehicle's
  bool trim = false;  // for a planner that keeps a distance of its own: faces are worn down to what one view shows
  UpperEdge camera;
  double view = 0;  // half of the camera's field of view, rad, within 1.5; 0: free ground is never doubted
  double row_m =
      0;  // of floor that one image row covers at 1 m, which grows with the square: 1 / (f H), m; 0: all floor counts
  DepthViewParams sight;  // focal_px 0: none
};

// One of each for every cell, rolling_map_side() squared.
struct RollingMapMemory {
  std::span<std::uint8_t> evidence;  // 0: unknown, 1: free, 1 + n: n of an obstacle
  std::span<std::int16_t>
      height;  // greatest mean height of the obstacle, mm; else the frames that looked there in vain
  std::span<std::uint32_t> seen;  // when last seen, in units of kTickNs since the first frame
  std::span<std::uint8_t> floor;  // frames that saw it free less those that saw an obstacle; saturates
};

inline constexpr int kRollingMapMaxSide = 4096;  // cells

// Cells of a side; 0: outside 1 to kRollingMapMaxSide.
int rolling_map_side(const GridGeometry& geometry, double size_m);

class RollingMap {
 public:
  static constexpr int kBelieved = 12;
  static constexpr int kMostHits = 3;                         // evidence saturates at what so many frames add
  static constexpr int kMostFar = kMostHits * kBelieved / 2;  // what was never seen from near by has no more
  static constexpr int kCleared = 6;
  static constexpr int kClearedFar = 2;
  static constexpr int kTrimmed = 6;       // lost by what a frame does not show, though it shows its neighbour
  static constexpr int kHidden = 1;        // lost by what only a distant view has shown, and is hidden now
  static constexpr double kHiddenM = 0.3;  // by something that is nearer by more than this
  static constexpr double kBesideM = 0.3;  // beyond blind_m: farther away a face is thick behind only
  static constexpr int kSunk = 2;
  static constexpr std::size_t kThickness = 2;
  static constexpr int kDoubts = 5;               // frames in a row
  static constexpr std::uint64_t kVainTimes = 3;  // of keep_s: where it was looked in vain is remembered longer
  static constexpr double kDoubtM = 1.2;          // how far beyond blind_m
  static constexpr double kEdgeMarginM = 0.05;    // of the upper edge above a remembered height
  static constexpr int kBorderRows = 5;
  static constexpr int kFarBorder = 6;  // cells: where those rows cover more, any floor counts
  static constexpr int kHangingMm = 300;
  static constexpr int kBodyMm = 600;    // what is seen so high, on the average ...
  static constexpr int kBodyFloor = 6;   // ... with one pixel of floor for so many of its own, hangs
  static constexpr int kBody = 2;        // cells behind the face of what hangs
  static constexpr int kFreeCounts = 2;  // a frame that sees floor, against one that sees an obstacle
  static constexpr int kMostFree = 40;
  static constexpr int kOftenFree = 6;
  static constexpr std::int64_t kTickNs = 10'000'000;
  static constexpr std::uint32_t kSweepTicks = 50;  // what is old is looked for so often

  // geometry: of the frames. bad_argument: a parameter that is not finite or out of range; size_mismatch: the memory is not of
  // rolling_map_side(). Forgets everything. Keeps the memory.
  Status configure(const RollingMapParams& params, const GridGeometry& geometry, const RollingMapMemory& memory);
  void reset();

  // Takes a frame in: type, count, height_sum and floor_count are read; disparity: that the frame was made from, empty where there is none. Poses in
  // order of time. bad_argument: not of the geometry, or a pose that is not finite or beyond 10^8 cells; the map is then as before.
  Status add(const NavGrid& frame, const MapPose& at, ImageView<const std::int16_t> disparity = {});

  // The map as seen from the pose of the last add(): cells of CellType, forward half-plane. Every believed obstacle marks the
  // cell that holds its centre, and so do up to kThickness cells to its east, west, north and south that were never seen: a face
  // has something behind it. All others ask the world cell below their own centre, and are unknown where that is an obstacle.
  // Beyond the square's edge `frame` counts alone. size_mismatch; bad_argument: nothing was added yet.
  Status view(ImageView<const std::uint8_t> frame, ImageView<std::uint8_t> type) const;

  // The cells from world cell (x, y) on as they lie in the world: column u east of x, row v north of y; CellType. What lies outside
  // the square is unknown. Obstacles have something behind them as in view(), but from kBesideM beyond blind_m on only on the
  // side away from the vehicle: beside the end of a wall a doorway may begin. bad_argument: nothing was added yet.
  Status window(std::int64_t x, std::int64_t y, ImageView<std::uint8_t> type) const;

  // Whether world cell (x, y) was seen free so often that an obstacle there has probably come, and may go again. False outside.
  bool was_free(std::int64_t x, std::int64_t y) const {
    return holds(x, y) && memory_.floor[index(x, y)] >= kOftenFree;
  }

  // Whether world cell (x, y) is unknown though the camera looked at it from near by. False outside.
  bool looked_in_vain(std::int64_t x, std::int64_t y) const { return holds(x, y) && looked_in_vain(index(x, y)); }

 private:
  static constexpr std::uint8_t kFree = 1;  // evidence

  struct Sight;  // of one frame
  void thicken(ImageView<std::uint8_t> type, double from_x, double from_y) const;
  struct Run;

  bool holds(std::int64_t x, std::int64_t y) const;
  std::size_t index(std::int64_t x, std::int64_t y) const;  // of a cell that the square holds
  void forget(std::size_t i) {
    memory_.evidence[i] = memory_.floor[i] = 0;
    memory_.height[i] = 0;
  }
  void forget_old();
  void roll(std::int64_t x, std::int64_t y);
  void clear_seen_free(const NavGrid& frame, const Sight& sight, ImageView<const std::int16_t> disparity);
  void see_free(std::size_t i, double forward, double left, ImageView<const std::int16_t> disparity);
  bool can_look_for(std::size_t i, ImageView<const std::int16_t> disparity) const;
  void see_through(std::size_t i, double forward, double left, ImageView<const std::int16_t> disparity);
  int cleared(std::size_t i, double forward, double left, ImageView<const std::int16_t> disparity) const;
  std::pair<double, double> from_camera(double forward, double left) const;
  void find_shadows(const NavGrid& frame, const Sight& sight);
  bool is_hidden(double forward, double left) const;
  void lose(std::size_t i, int evidence);
  bool is_beside_hit(const NavGrid& frame, int row, int col) const;
  bool floor_goes_on(const NavGrid& frame, int row, int col) const;
  bool looked_in_vain(std::size_t i) const { return memory_.evidence[i] == 0 && memory_.height[i] >= kDoubts; }
  bool is_refuted(std::size_t i, double forward, double left) const;
  void look_in_vain(std::size_t i, double forward, double left);
  bool looks_at(double forward, double left) const;
  bool sees_height(std::size_t i, double forward, double left) const;
  void hit(std::size_t i, int evidence, std::int64_t height_mm);
  void add_body(const Sight& sight, int row, int col, int evidence, std::int64_t height_mm);
  void add_obstacles(const NavGrid& frame, const Sight& sight);
  void stand_here(const Sight& sight);
  Run run_of(const Sight& sight, std::int64_t y) const;
  template <class Visit>
  void visit_below(const Sight& sight, Visit&& visit) const;
  int weight(double forward, double left, int near, int far) const;

  RollingMapParams params_;
  Shadow shadow_;
  DepthView depth_view_{DepthViewParams{}};
  GridGeometry geometry_;
  RollingMapMemory memory_;
  int side_ = 0;
  double cell_m_ = 0.1;
  std::uint32_t keep_ = 0;   // ticks
  double edge_forward_ = 0;  // how the height of the upper edge changes per metre ahead and to the left
  double edge_left_ = 0;
  double edge_height_ = 0;  // above the turning centre
  double view_cos_ = 1;     // of half the field of view
  double yaw_cos_ = 1;      // of the camera
  double yaw_sin_ = 0;

  bool started_ = false;
  std::int64_t first_ns_ = 0;
  MapPose at_;
  std::int64_t x_begin_ = 0;  // world cells of the square's corner
  std::int64_t y_begin_ = 0;
  std::int64_t x_wrap_ = 0;  // where that corner lies in the memory
  std::int64_t y_wrap_ = 0;
  std::uint32_t now_ = 0;
  std::uint32_t swept_ = 0;  // when what is old was last forgotten
  double near_m_ = 0;        // within which one frame is enough, now
};

}  // namespace lakshya
