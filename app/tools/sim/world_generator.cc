#include "app/tools/sim/world_generator.h"

#include "app/tools/sim/course.h"

namespace lakshya::sim {

World random_world(Kind kind, std::uint64_t seed) {
  // A draw that leaves no way, or no need to steer, is thrown away. Few are: the bound is never reached.
  constexpr int kDraws = 1000;
  World world;
  for (int draw = 0; draw < kDraws; ++draw) {
    Random random((seed * 2 + (kind == Kind::indoor ? 0 : 1)) * kDraws + static_cast<std::uint64_t>(draw));
    world = World{};
    world.indoor = kind == Kind::indoor;
    world.name = (world.indoor ? "indoor-" : "outdoor-") + std::to_string(seed);
    world.seed = seed;
    if (world.indoor ? furnish_indoor(world, random) : furnish_outdoor(world, random)) break;
  }
  return world;
}

}  // namespace lakshya::sim
