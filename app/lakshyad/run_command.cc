#include "app/lakshyad/run_command.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <iostream>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/core/input_error.h"
#include "app/core/recorded_folder.h"
#include "app/core/vehicle_config_file.h"
#include "app/lakshyad/options.h"
#include "app/loop/real_time.h"
#include "app/loop/safety_table.h"
#include "app/loop/session.h"

namespace lakshya {
namespace {

struct LoopOptions {
  ConfigOptions config;
  KernelOptions kernels;
  std::string way_points;
  std::optional<double> target_deg;
  SessionOptions session;
};

void add_loop_options(CLI::App& command, LoopOptions& o) {
  add_config_options(command, o.config);
  add_kernel_options(command, o.kernels);
  command.add_option("--way-points", o.way_points, "File of way points (key mission.way_points)")
      ->type_name("FILE");
  command
      .add_option("--target", o.target_deg,
                  "Without way points: where to go, degrees to the left of straight ahead (mission.direction_deg)")
      ->check(angle_in_degrees());
  command.add_option("--frames", o.session.limits.frames,
                     "End after so many frames; 0: with the recording, or never");
  command.add_option("--report", o.session.report, "Write the report (JSON) here")->type_name("FILE");
  command.add_option("--out", o.session.out, "Record into this folder: decisions.jsonl and pictures of the map")
      ->type_name("DIR");
  command
      .add_option("--picture-every", o.session.picture_every,
                  "With --out: a picture of the map for every so many frames; 0: none")
      ->capture_default_str();
  command.add_flag("--json", o.session.json, "Print the report as JSON");
}

VehicleConfig load(const LoopOptions& o) {
  VehicleConfig config = load_vehicle_config(o.config.config, o.config.profile, o.config.sets);
  if (!o.way_points.empty()) config.mission.way_points = o.way_points;
  if (o.target_deg) config.mission.direction_deg = *o.target_deg;
  return config;
}

void run(LoopOptions o, const VehicleConfig& config) {
  o.session.config_path = o.config.config;
  const KernelTable kernels = choose_kernels(o.kernels);
  run_session(config, o.session, kernels);
}

// ---- replay

struct ReplayOptions {
  LoopOptions loop;
  std::vector<std::string> source;
  std::vector<std::string> calibration;
  std::string rate = "max";
};

// A recording that is slower than the safety limits allow is no camera that has fallen silent.
void watch_at_rate(VehicleConfig& config) {
  const double period_s = 1 / config.folder.rate_hz;
  config.safety.camera_silent_s = std::max(config.safety.camera_silent_s, 1.3 * period_s);
  config.safety.plan_age_s = std::max(config.safety.plan_age_s, 1.2 * (period_s + config.loop.virtual_latency_s));
}

// "max": as fast as it goes, on the virtual clock, where pairs come folder.rate_hz times a second. "real": at the times of the
// recording. Else so many pairs a second. The last two are on the machine's clock.
void set_rate(const std::string& rate, VehicleConfig& config, SessionOptions& session) {
  session.virtual_clock = rate == "max";
  config.folder.pace = rate == "real" ? "recorded" : "rate";
  if (rate == "max") watch_at_rate(config);
  if (rate == "max" || rate == "real") return;
  double hz = 0;
  if (!CLI::detail::lexical_cast(rate, hz) || !(hz >= 0.01 && hz <= 1000))
    throw CLI::ValidationError("--rate", rate + " is neither max nor real nor pairs per second from 0.01 to 1000");
  config.folder.rate_hz = hz;
  watch_at_rate(config);
}

// No vehicle: recorded pairs instead of a camera, and nobody's wheels.
std::uint64_t take_source(const ReplayOptions& o, VehicleConfig& config) {
  config.drivers = {
      .camera = "folder", .servo = "record", .unsupervised_speed_mps = config.drivers.unsupervised_speed_mps};
  // Where the recorded vehicle went is not known: a map carried along by wheels that nobody has would be smeared.
  config.map.rolling = "no";
  name_recording(config, o.source, o.calibration);
  const auto pairs = static_cast<std::uint64_t>(RecordedFolder(config.folder).count());
  config.folder.repeat = o.loop.session.limits.frames > pairs ? "yes" : "no";
  return pairs;
}

void replay(ReplayOptions o) {
  VehicleConfig config = load(o.loop);
  o.loop.session.limits.damaged = take_source(o, config);
  set_rate(o.rate, config, o.loop.session);
  o.loop.session.source = o.source[0];
  run(o.loop, config);
}

}  // namespace

void add_run_command(CLI::App& app, char** argv) {
  auto o = std::make_shared<LoopOptions>();
  auto print_states = std::make_shared<bool>(false);
  o->session.picture_every = 10;
  CLI::App* command =
      app.add_subcommand("run", "Drive: camera to wheels, on the devices that the configuration names");
  add_loop_options(*command, *o);
  command
      ->add_option(
          "--latch", o->session.latch,
          "File that is there while the vehicle is in the state FAULT; a start that finds it begins in FAULT")
      ->type_name("FILE");
  command->add_flag("--print-states", *print_states, "Print the table of states and events, and do nothing else");
  command->footer(
      "Ends with SIGINT, SIGTERM, SIGHUP or SIGQUIT, after the wheels have got zero. SIGUSR1 resets what waits for "
      "a person.\n"
      "Example: lakshyad run --config /etc/lakshya/vehicle.yaml --way-points tour.csv --out /var/lib/lakshya/tour");
  command->callback([o, print_states, argv] {
    if (*print_states) {
      std::cout << states_text();
      return;
    }
    require_openmp_settings(argv);
    const VehicleConfig config = load(*o);
    o->session.source = config.drivers.camera;
    run(*o, config);
  });
}

void add_replay_command(CLI::App& app, char** argv) {
  auto o = std::make_shared<ReplayOptions>();
  CLI::App* command = app.add_subcommand("replay", "The main loop on recorded stereo pairs; no vehicle moves");
  command
      ->add_option("source", o->source,
                   "Sequence (KITTI odometry, EuRoC, or a folder with left and right), or left and right images or "
                   "folders of images")
      ->required()
      ->expected(1, 2)
      ->type_name("SOURCE");
  command
      ->add_option("--calib", o->calibration,
                   "Calibration file, two files, or a folder; default: camera.calibration, else the sequence's own")
      ->expected(1, 2)
      ->type_name("FILE");
  command
      ->add_option("--rate", o->rate,
                   "max: as fast as it goes, on a virtual clock, the same result on any machine; real: at the "
                   "recording's times; or pairs per second")
      ->capture_default_str()
      ->type_name("max|real|HZ");
  add_loop_options(*command, o->loop);
  command->footer(
      "With more --frames than there are, the recording begins again after its last pair.\n"
      "Example: lakshyad replay sequences/06 --set camera.height_m=1.65 --report report.json --out out/replay");
  command->callback([o, argv] {
    require_openmp_settings(argv);
    replay(*o);
  });
}

}  // namespace lakshya
