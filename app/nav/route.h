// The way to the target through everything that the rolling map knows: docs/contract.md section 5.
//
// Dijkstra's search on a square window of the map about the vehicle, fixed to the world: cells nearer to an obstacle cell than the
// vehicle's radius and a margin are closed, cells within a comfortable distance cost more the nearer they are (so that a way keeps
// to the middle of a gap), unknown cells cost more than free ones, and unknown cells right before the camera, which it should have
// seen long ago, still more. The way of the plan before costs less than others: of two that are about as good the vehicle keeps to
// the one that it has begun. A target beyond the window is sought by the way to the border that leaves least to go.
// Where no way leads to the target, the cheapest one through closed cells shows which of them to doubt: first those that are closed by
// what came to ground that was free before, then gaps, then any. The vehicle goes to where it has them in view from farther than its
// blind zone and turns towards them. If they stay closed it leaves them for a while, looks at the next place if there is one, and comes
// back: somebody may have stood there. Where the only way costs much more than the straight line, a gap that would save much of it is
// looked at before it is taken: such ways lead far through what nobody has seen, and often there is a wall that shows nothing.
// Before it sets off the vehicle turns first_look to either side: what stands beside it at the start, and beyond the border of the view,
// would never come into view, and its side would sweep there.
// The direction is that of the farthest point of the way, up to reach_m ahead, that a straight line reaches without coming nearer
// to obstacles than the way itself does.
//
// Costs are integers, the search visits each cell once, and all memory is the caller's: the time is bounded.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "app/nav/clear_distance.h"
#include "app/nav/rolling_map.h"
#include "kernels/base/image_view.h"
#include "kernels/base/status.h"

namespace lakshya {

struct RouteParams {
  double radius_m = 0.35;       // the vehicle's
  double margin_m = 0.05;       // kept at least between the vehicle and the middle of an obstacle cell
  double comfort_m = 0.40;      // within which of the vehicle's side an obstacle is avoided where that is cheap
  double reach_m = 1.2;         // how far ahead the direction aims
  double blind_m = 1.0;         // what is nearer than this the camera does not see
  double view = 0.6;            // rad, half of the camera's field of view
  double first_look = 0;        // rad that it turns to either side before it sets off, to see what stands beside it
  double unknown_near_m = 2.0;  // unknown cells in view and nearer than this are very likely not free
};

inline constexpr int kRouteSide = 160;  // cells of the window's side
inline constexpr int kRouteCells = kRouteSide * kRouteSide;
inline constexpr int kRouteMostPoints = 1024;
inline constexpr int kRouteLooks = 8;  // places

// The caller's, kRouteCells each.
struct RouteMemory {
  std::span<std::uint8_t> type;
  std::span<std::uint8_t> distance2;  // squared, cells; saturated
  std::span<std::uint8_t> factor;     // cost of a step, tenths
  std::span<std::int32_t> cost;
  std::span<std::int32_t> next;  // lists of cells of one cost
  std::span<std::int32_t> previous;
  std::span<std::uint8_t> from;  // direction of the step that led here
};

struct Route {
  bool found = false;
  bool looks = false;     // stands and turns towards a place that it doubts: clear_m and swept_m are 0
  double direction = 0;   // rad, from straight ahead, counter-clockwise
  double straight_m = 0;  // to the point that it aims at
  // See RouteAim (planner.h).
  double clear_m = 0;
  ClearEnd clear_end = ClearEnd::unknown;
  double swept_m = 0;
  double cost_m = 0;            // of the whole way, as metres in the open
  bool reaches_target = false;  // false: only near it, or to the window's border
};

class RoutePlanner {
 public:
  // bad_argument: a parameter that is not finite or out of range; size_mismatch: the memory. Keeps the memory.
  Status configure(const RouteParams& params, std::int32_t cell_mm, const RouteMemory& memory);
  // Forgets the way of the plan before, and what was looked at.
  void reset() { count_ = looked_at_count_ = looks_ = doubts_ = first_looks_ = first_plans_ = plans_ = 0; }

  // The map as of its last add(), made at `pose`; target in the world frame, metres. bad_argument: not finite.
  // turning: the angle that the vehicle will turn further even if it is told otherwise, rad.
  Status plan(const RollingMap& map, const Pose& pose, double target_east_m, double target_north_m, double turning,
              Route& route);

 private:
  struct Point {
    std::int64_t x = 0;  // world cells
    std::int64_t y = 0;
  };
  // A closed place that was looked at in vain.
  struct LookedAt {
    Point place;
    int times = 0;
    int until = 0;  // the plan from which on it is doubted again
  };
  // A window's cell, or a place in it in cells.
  static int index(int x, int y) { return y * kRouteSide + x; }
  static bool inside(int x, int y) { return x >= 0 && x < kRouteSide && y >= 0 && y < kRouteSide; }

  void close_blank_walls(const RollingMap& map);
  void measure_distances();
  void price_cells(const RollingMap& map, const Pose& pose, double x, double y);
  void search();
  int cell_before(int cell) const;
  void push(int cell, std::int32_t cost);
  void remove(int cell);
  int choose_end(double goal_x, double goal_y) const;
  double cost_to_goal(int end, double goal_x, double goal_y) const;
  void follow_back(int end);
  bool reaches(int end, double goal_x, double goal_y) const;
  int look_again(const RollingMap& map, const Pose& pose, double x, double y, double goal_x, double goal_y,
                 Route& route);
  enum class Through { comers, gaps, all };
  void open_where_ground_was_free(const RollingMap& map);
  void open_closed_cells(bool all);
  void close_again(Through what);
  int place_on_the_way(const RollingMap& map, Through what, double goal_x, double goal_y);
  int doubtful_place(const RollingMap& map, double goal_x, double goal_y);
  int view_point(int place) const;
  bool sees(double x, double y, double place_x, double place_y) const;
  bool is_same_place(const Point& place, double u, double v) const;
  bool has_been_looked_at(double u, double v) const;
  bool look_round(const Pose& pose, double target_east_m, double target_north_m, Route& route);
  bool is_closed(const Point& place) const;
  bool choose_doubt(const RollingMap& map, double goal_x, double goal_y);
  void note_looked_at();
  bool straight_is_free(double x, double y, double to_x, double to_y, int least_distance2) const;
  double unseen_from(double x, double y, double dx, double dy, bool beside) const;
  ClearDistance clear_along(double x, double y, double angle) const;
  void aim(const Pose& pose, double x, double y, Route& route) const;

  static constexpr int kBuckets = 4096;  // more than the most expensive step
  RouteParams params_;
  double cell_m_ = 0.1;
  int closed2_ = 16;
  std::array<std::uint8_t, 256> price_{};  // factor by squared distance
  RouteMemory memory_;
  std::array<std::int32_t, kBuckets> bucket_{};
  std::int64_t x_begin_ = 0;  // the window's corner, world cells
  std::int64_t y_begin_ = 0;
  int start_ = 0;
  std::array<Point, kRouteMostPoints> points_{};  // of the last way, from the vehicle on
  int count_ = 0;
  std::array<LookedAt, kRouteLooks> looked_at_{};
  int looked_at_count_ = 0;
  double dear_ = 0;      // a way through a place that is doubted must cost less than this
  int insists_ = 0;      // times up to which it looks once more at what it has looked at not long ago
  Point doubted_;        // the place that it goes to look at
  int doubts_ = 0;       // plans for which it still may; 0: none is doubted
  int plans_ = 0;        // since a way led to the target
  int first_looks_ = 0;  // sides that it has looked to since reset()
  int first_plans_ = 0;  // ... and plans that it took so far
  double first_yaw_ = 0;
  double last_yaw_ = 0;
  double first_side_ = 1;
  int looks_ = 0;  // plans in which it has faced it
};

}  // namespace lakshya
