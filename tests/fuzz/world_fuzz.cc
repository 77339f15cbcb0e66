// World files. What is taken must be a world that can be driven: finite everywhere, with a start from which the true geometry answers.
#include <cmath>
#include <cstdlib>

#include "app/tools/sim/named_worlds.h"
#include "app/tools/sim/truth.h"
#include "app/tools/sim/world_file.h"
#include "tests/fuzz/fuzz.h"

namespace lakshya::fuzz {

void read(Bytes bytes) {
  const sim::World world = sim::parse_world(text_of(bytes), "fuzz");
  const sim::TrueGeometry truth(world);
  const sim::Nearest nearest = truth.nearest(world.start.x, world.start.y, 0, 1, 0, true);
  if (!std::isfinite(world.start.x) || !std::isfinite(world.start.y) || std::isnan(nearest.distance_m) ||
      nearest.thing >= static_cast<int>(world.things.size())) {
    std::abort();
  }
}

std::vector<std::string> seeds() {
  std::vector<std::string> worlds;
  for (const std::string_view name : sim::world_names())
    worlds.emplace_back(sim::named_world_text(name));
  return worlds;
}

}  // namespace lakshya::fuzz
