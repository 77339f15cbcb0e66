// What the commands about simulated worlds share: which world, which vehicle, which sensor.
#pragma once

#include <cstdint>
#include <string>

#include "app/lakshyad/options.h"
#include "app/tools/sim/run_world.h"
#include "app/tools/sim/world.h"

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace lakshya {

struct SimOptions {
  std::string world;
  std::uint64_t seed = 1;
  std::string size = "320x240";
  std::string sensor = "stereo";
  std::string matcher;
  std::string planner;
  ConfigOptions config;
  KernelOptions kernels;
};

// --world, --seed, --size
CLI::Option* add_world_options(CLI::App& command, SimOptions& options);

// A name of ours, a YAML file, or random-indoor or random-outdoor made of the seed. Throws InputError.
sim::World choose_world(const std::string& world, std::uint64_t seed);

// The vehicle that is simulated: the configuration's, its devices the simulator's. Without a file the profile for the world's kind
// with the camera of the simulated vehicle (simulated_vehicle_settings), so that --set still counts.
VehicleConfig choose_vehicle(const SimOptions& options, bool indoor);

sim::RunSettings run_settings(const SimOptions& options, std::uint64_t seed);

}  // namespace lakshya
