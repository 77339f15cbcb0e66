// Private to the generator: a course while it is being furnished. Things come one by one, and only where a way for the vehicle stays.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "app/tools/sim/footprint.h"
#include "app/tools/sim/free_space.h"
#include "app/tools/sim/random.h"
#include "app/tools/sim/shapes.h"
#include "app/tools/sim/world.h"

namespace lakshya::sim {

class Course {
 public:
  static constexpr int kNothing = -1;

  // The world has its start and goal; `rooms` may be furnished. Ground patches and boundary come before begin().
  Course(World& world, Random& random, std::vector<Rect> rooms)
      : world_(world), random_(random), rooms_(std::move(rooms)) {}

  void add_boundary(Thing thing);
  // Whether this part of the ground is away from start and goal, from what is there, and within a room; then it is kept free.
  bool reserve(const Rect& rect, bool driven = false);
  void keep_clear(const Eigen::Vector2d& point, double radius_m) { clear_.push_back({point, radius_m}); }
  // False: boundary and ground leave no way.
  bool begin(double cell_m);

  // Takes the thing if it may stand there: away from start and goal; as far from others that the vehicle fits between, or against
  // a wall; and a way stays. `beside` is the index of a thing that it may touch. With `close` there must be others so near that a
  // vehicle has to steer between them.
  bool place(Thing thing, bool close, int beside = kNothing);
  // What may be driven over or under, and who walks: no conditions.
  void add(Thing thing);

  // A point anywhere in the rooms; one on the vehicle's present way, at most `aside` from it.
  Eigen::Vector2d anywhere();
  Eigen::Vector2d on_the_way(double aside);
  // Somebody who crosses the present way.
  std::optional<Walk> crossing_walk();

  double area_m2() const { return area_m2_; }
  double density() const { return obstacle_count(world_) / area_m2_; }
  // How many obstacles the straight line from start to goal runs into.
  int on_the_straight_line() const;

  World& world() { return world_; }
  Random& random() { return random_; }
  const std::vector<Rect>& rooms() const { return rooms_; }

 private:
  struct Clear {
    Eigen::Vector2d point;
    double radius_m;
  };
  struct Known {
    Footprint footprint;
    int thing;  // kNothing: ground
    bool driven;
  };

  bool fits(const Footprint& footprint, bool close, int beside);
  bool is_on_way(const Footprint& footprint) const;
  Eigen::Vector2d start() const { return {world_.start.x, world_.start.y}; }
  void name(Thing& thing);

  World& world_;
  Random& random_;
  std::vector<Rect> rooms_;
  std::vector<Clear> clear_;
  std::vector<Known> things_;
  std::vector<Footprint> boundary_;
  std::optional<FreeSpace> space_;
  std::vector<Eigen::Vector2d> way_;
  std::map<std::string, int, std::less<>> count_;
  double area_m2_ = 0;
};

// Private to the generator, too.
bool has_trait(const World& world, std::string_view trait);
void maybe_add_indoor_stairs(Course& course, const Rect& room);  // before begin()
void furnish_rooms(Course& course);
void add_what_is_passed(Course& course);  // papers on the way, things that hang high over it

// False: try again with other numbers.
bool furnish_indoor(World& world, Random& random);
bool furnish_outdoor(World& world, Random& random);

}  // namespace lakshya::sim
