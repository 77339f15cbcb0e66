#include "app/tools/sim_setup.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <filesystem>

#include "app/core/input_error.h"
#include "app/core/vehicle_config_file.h"
#include "app/core/vehicle_config_keys.h"
#include "app/tools/sim/named_worlds.h"
#include "app/tools/sim/world_file.h"
#include "app/tools/sim/world_generator.h"
#include "app/tools/sim_peers.h"

namespace lakshya {
namespace {

constexpr const char* kRandomIndoor = "random-indoor";
constexpr const char* kRandomOutdoor = "random-outdoor";

struct Size {
  int width = 0;
  int height = 0;
};

Size parse_size(const std::string& text) {
  Size size;
  const char* end = text.data() + text.size();
  const auto width = std::from_chars(text.data(), end, size.width);
  if (width.ec != std::errc() || width.ptr == end || *width.ptr != 'x') return {};
  const auto height = std::from_chars(width.ptr + 1, end, size.height);
  if (height.ec != std::errc() || height.ptr != end) return {};
  return size;
}

CLI::Validator image_size() {
  const auto check = [](const std::string& text) {
    const Size size = parse_size(text);
    const bool good = size.width >= 64 && size.width <= 2048 && size.height >= 48 && size.height <= 2048;
    return good ? std::string() : text + " is no size (64x48 to 2048x2048, for example 640x480)";
  };
  return {check, "WIDTHxHEIGHT"};
}

std::string known_worlds() {
  std::string names = std::string(kRandomIndoor) + ", " + kRandomOutdoor;
  for (const std::string_view name : sim::world_names())
    names.append(", ").append(name);
  return names;
}

}  // namespace

CLI::Option* add_world_options(CLI::App& command, SimOptions& o) {
  CLI::Option* world =
      command.add_option("--world", o.world, "World: " + known_worlds() + ", or a YAML file (docs/worlds.md)")
          ->type_name("NAME|FILE");
  command.add_option("--seed", o.seed, "Seed of a random world, and of all noise")->capture_default_str();
  command.add_option("--size", o.size, "Pictures of the simulated cameras")
      ->check(image_size())
      ->capture_default_str();
  return world;
}

sim::World choose_world(const std::string& world, std::uint64_t seed) {
  if (world == kRandomIndoor) return sim::random_world(sim::Kind::indoor, seed);
  if (world == kRandomOutdoor) return sim::random_world(sim::Kind::outdoor, seed);
  if (std::ranges::find(sim::world_names(), world) != sim::world_names().end()) {
    sim::World made = sim::named_world(world);
    made.seed = seed;
    return made;
  }
  if (!std::filesystem::exists(world))
    throw InputError("--world", world + ": no such world, and no such file (worlds: " + known_worlds() + ")");
  sim::World read = sim::read_world(world);
  read.seed = seed;
  return read;
}

VehicleConfig choose_vehicle(const SimOptions& o, bool indoor) {
  std::string profile = o.config.profile;
  std::vector<std::string> sets = o.config.sets;
  if (!o.matcher.empty()) sets.push_back("matcher.name=" + o.matcher);
  if (!o.planner.empty()) sets.push_back("planner.name=" + o.planner);
  if (o.config.config.empty()) {
    if (profile.empty()) profile = indoor ? "indoor" : "outdoor";
    // What the user sets takes the place of what the simulator would: a key that is set twice is refused.
    const auto key = [](const std::string& set) { return set.substr(0, set.find('=')); };
    const std::vector<std::string> asked = sets;
    for (const std::string& usual : sim::simulated_vehicle_settings(indoor)) {
      if (std::ranges::find(asked, key(usual), key) == asked.end()) sets.push_back(usual);
    }
  }
  return sim::with_simulated_devices(load_vehicle_config(o.config.config, profile, sets));
}

sim::RunSettings run_settings(const SimOptions& o, std::uint64_t seed) {
  sim::RunSettings settings;
  const Size size = parse_size(o.size);
  settings.simulation.rig.width = size.width;
  settings.simulation.rig.height = size.height;
  settings.simulation.seed = seed;
  const auto sensor = std::ranges::find(sim::kSensorNames, o.sensor);
  settings.sensor = static_cast<sim::Sensor>(sensor - sim::kSensorNames.begin());
  settings.make_matcher = [sensor = settings.sensor](const RectifiedGeometry& camera, const VehicleConfig& config) {
    return make_opencv_stand_in(sensor, camera, config);
  };
  return settings;
}

}  // namespace lakshya
