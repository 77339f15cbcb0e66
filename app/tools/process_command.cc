#include "app/tools/process_command.h"

#include <spdlog/spdlog.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <memory>
#include <numbers>
#include <optional>

#include "app/core/file_bytes.h"
#include "app/core/geometry.h"
#include "app/core/image_file.h"
#include "app/core/input_error.h"
#include "app/core/pipeline.h"
#include "app/core/vehicle_config_file.h"
#include "app/core/vehicle_config_text.h"
#include "app/lakshyad/options.h"
#include "app/tools/disparity_file.h"
#include "app/tools/map_file.h"
#include "app/tools/output_folder.h"
#include "app/tools/pictures.h"
#include "app/tools/process_report.h"
#include "app/tools/stereo_input.h"
#include "hal/clock/monotonic_clock.h"
#include "kernels/base/isa.h"

namespace lakshya {
namespace {

struct ProcessOptions {
  StereoInputOptions input;
  std::string out;
  ConfigOptions config;
  KernelOptions kernels;
  std::string matcher;
  std::optional<int> disparities;
  std::optional<int> min_disparity;
  std::optional<double> camera_height;
  std::optional<double> camera_pitch;
  std::optional<double> camera_roll;
  double target_deg = 0;
  bool points = false;
  bool json = false;
};

// The options that stand for one key each, as --set would say them.
std::vector<std::string> all_sets(const ProcessOptions& o) {
  std::vector<std::string> sets = o.config.sets;
  const auto add = [&](const char* key, const auto& value) {
    if (value) sets.push_back(std::string(key) + "=" + number_text(*value));
  };
  if (!o.matcher.empty()) sets.push_back("matcher.name=" + o.matcher);
  if (o.disparities) sets.push_back("matcher.disparities=" + std::to_string(round_up_to_16(*o.disparities)));
  add("matcher.min_disparity", o.min_disparity);
  add("camera.height_m", o.camera_height);
  add("camera.pitch_deg", o.camera_pitch);
  add("camera.roll_deg", o.camera_roll);
  return sets;
}

void write_results(const ProcessOptions& o, const VehicleConfig& config, const StereoInput& input,
                   const Pipeline& pipeline, const FrameResult& frame, OutputFolder& folder) {
  const KittiDisparity disparity = kitti_disparity(frame.disparity, pipeline.camera().doffs());
  if (disparity.clipped > 0) {
    spdlog::warn(
        "{} disparities do not fit disparity.png's 0 to 256 px and were clipped there (the map is not affected)",
        disparity.clipped);
  }
  const PictureInput pictures{frame,
                              pipeline.camera(),
                              config,
                              o.target_deg * std::numbers::pi / 180,
                              pipeline.blind_zone(),
                              std::filesystem::path(input.left_path).filename()};
  write_png(folder.file("disparity.png"), disparity.image.view());
  write_png(folder.file("disparity_color.png"), disparity_picture(pictures).view());
  write_png(folder.file("classes.png"), classes_picture(pictures).view());
  write_png(folder.file("map.png"), map_picture(pictures).view());
  write_png(folder.file("summary.png"), summary_picture(pictures).view());
  write_file_atomically(folder.file("map.json"), write_map_json(frame.grid));
  if (o.points) write_file_atomically(folder.file("points.ply"), ply_points(frame, pipeline.prune_model()));
  folder.commit("points.ply");
}

void process(const ProcessOptions& o) {
  const VehicleConfig config = load_vehicle_config(o.config.config, o.config.profile, all_sets(o));
  const StereoInput input = read_stereo_input(o.input, config.camera.calibration_unit_m);
  const int width = input.left.width();
  const int height = input.left.height();
  const MonotonicClock clock;
  const KernelTable kernels = choose_kernels(o.kernels);  // the pipeline keeps a reference to it
  Pipeline pipeline(config, input.calibration, width, height, kernels, clock);

  spdlog::info("{}x{}, {} disparities: kernels {} on {}", width, height, config.matcher.disparities,
               o.kernels.backend, active_isa());
  OutputFolder folder(o.out);  // refuses before the long work, not after it
  FrameResult frame;
  const PlanInput plan{.target = o.target_deg * std::numbers::pi / 180};
  const Status status = pipeline.process(input.left.view(), input.right.view(), plan, frame);
  if (status != Status::ok) {
    throw InputError(input.left_path, std::string("cannot be processed: ") + to_string(status));
  }
  spdlog::info("drawing and writing {}", o.out);
  write_results(o, config, input, pipeline, frame, folder);

  if (o.json) {
    nlohmann::ordered_json json = frame_json(frame, config.planner);
    json["focal_px"] = pipeline.camera().focal_px;
    json["baseline_m"] = pipeline.camera().baseline_m;
    json["doffs"] = pipeline.camera().doffs();
    json["ground_offset_px"] = static_cast<double>(frame.ground_offset16) / kDisparityScale;
    json["ground_pitch_deg"] = pitch_deg_of_disparity16(config, pipeline.camera(), frame.ground_offset16);
    json["blind_zone_m"] = pipeline.blind_zone();
    json["arena_bytes"] = pipeline.arena_bytes();
    json["left"] = input.left_path;
    json["right"] = input.right_path;
    if (input.timestamp_ns) json["timestamp_ns"] = *input.timestamp_ns;
    json["out"] = o.out;
    std::cout << json.dump() << '\n';
  } else {
    std::cout << frame_text(frame) << "results: " << o.out << "/summary.png shows everything on one sheet\n";
  }
}

void add_options(CLI::App& command, ProcessOptions& o) {
  add_stereo_input_options(command, o.input);
  add_config_options(command, o.config);
  add_kernel_options(command, o.kernels);
  command.add_option("--out", o.out, "Folder for the results; made when missing")->required();
  command.add_option("--matcher", o.matcher, "Matcher: sgm");
  command
      .add_option("--disparities", o.disparities, "Number of disparities searched, rounded up to a multiple of 16")
      ->check(CLI::Range(1, 512));
  command.add_option("--min-disparity", o.min_disparity, "Smallest disparity searched");
  command.add_option("--target", o.target_deg, "Direction of the way point, degrees to the left of straight ahead")
      ->check(angle_in_degrees());
  command.add_option("--camera-height", o.camera_height, "Left camera above the ground, m");
  command.add_option("--camera-pitch", o.camera_pitch, "Degrees, positive nose down");
  command.add_option("--camera-roll", o.camera_roll, "Degrees, positive right side down");
  command.add_flag("--points", o.points, "Also write points.ply");
  command.add_flag("--json", o.json, "Print JSON instead of a table");
  command.footer(
      "Writes disparity.png (16 bits, u_left - u_right in 1/256 px, 0 = none), disparity_color.png, classes.png,\n"
      "map.png, map.json, summary.png and, with --points, points.ply. All of them appear together or not at all.\n"
      "Example: lakshya process --left left.png --right right.png --calib calib.txt --camera-height 0.6\n"
      "           --camera-pitch 5 --profile indoor --target 20 --out out/frame\n"
      "KITTI:   lakshya process --sequence sequences/06 --frame 12 --camera-height 1.65 --camera-pitch 0\n"
      "           --disparities 128 --out out/kitti\n"
      "EuRoC:   lakshya process --sequence V1_01_easy --frame 100 --camera-height 1.2 --camera-pitch 20\n"
      "           --profile indoor --out out/euroc\n"
      "ROS:     lakshya process --left left_images --right right_images --frame 0 --calib left.yaml right.yaml\n"
      "           --out out/ros");
}

}  // namespace

void add_process_command(CLI::App& app) {
  auto options = std::make_shared<ProcessOptions>();
  CLI::App* command = app.add_subcommand("process", "One stereo pair to map, steering decision and pictures");
  add_options(*command, *options);
  command->callback([options] { process(*options); });
}

}  // namespace lakshya
