#include "app/loop/machinery.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <filesystem>
#include <utility>

#include "app/core/calibration_file.h"
#include "app/core/geometry.h"
#include "app/core/input_error.h"
#include "app/core/recorded_folder.h"
#include "app/core/way_point_file.h"

namespace lakshya {
namespace {

namespace fs = std::filesystem;

constexpr double kBytesPerMb = 1e6;

template <class Kind>
void open(Kind* device, const std::string& what) {
  if (device == nullptr) return;
  const Status status = device->open();
  if (status == Status::ok) return;
  throw InputError(
      what, std::string(to_string(status)) + ": " + device->problem() + " (try it alone: lakshya devices --test)");
}

std::string from_folder_of(const std::string& config_path, const std::string& path) {
  const fs::path beside = fs::path(config_path).parent_path() / path;
  std::error_code ignored;
  return fs::path(path).is_relative() && fs::exists(beside, ignored) ? beside.string() : path;
}

std::vector<std::string> calibration_paths(const std::string& list, const std::string& config_path) {
  std::vector<std::string> paths;
  for (std::size_t begin = 0; begin <= list.size();) {
    const std::size_t end = std::min(list.find(',', begin), list.size());
    paths.push_back(from_folder_of(config_path, list.substr(begin, end - begin)));
    begin = end + 1;
  }
  return paths;
}

// A limit, two control turns and an exchange with the drives are what stands between a fault and the wheels' zero.
void warn_of_slow_limits(const SafetyConfig& s) {
  constexpr double kPromise = 0.2;
  constexpr double kRest = 0.06;
  const std::pair<const char*, double> limits[] = {{"camera_silent_s", s.camera_silent_s},
                                                   {"compass_silent_s", s.compass_silent_s},
                                                   {"perception_s", s.perception_s},
                                                   {"control_late_s", s.control_late_s}};
  for (const auto& [name, limit_s] : limits) {
    if (limit_s + kRest > kPromise)
      spdlog::warn("safety.{} is {} s: the wheels get zero later than {} s after such a fault", name, limit_s,
                   kPromise);
  }
}

std::vector<WayPoint> way_points_of(const VehicleConfig& config) {
  if (config.mission.way_points.empty()) return {};
  return read_way_points(config.mission.way_points);
}

}  // namespace

VehicleDevices make_devices(const VehicleConfig& config, Clock& clock) {
  VehicleDevices devices;
  devices.servo = make_servo(config, clock);
  devices.estop = make_estop(config, clock);
  devices.compass = make_compass(config, clock);
  devices.camera = make_camera(config, clock);
  if (devices.camera.device == nullptr)
    throw InputError("drivers.camera", "none: the main loop needs a camera (lakshya devices lists the drivers)");
  return devices;
}

StereoCalibration loop_calibration(const VehicleConfig& config, const std::string& config_path) {
  CalibrationRequest request;
  request.opencv_unit_m = config.camera.calibration_unit_m;
  if (config.drivers.camera == "folder") {
    const RecordedFolder folder(config.folder);
    request.cameras = camera_numbers_of(folder.frames().left(0), folder.frames().right(0));
  }
  if (!config.camera.calibration.empty()) {
    request.paths = calibration_paths(config.camera.calibration, config_path);
  } else if (config.drivers.camera == "folder" && !config.folder.path.empty()) {
    request.paths = {config.folder.path};
  } else {
    throw InputError("camera.calibration", "is empty: the camera's calibration is needed (name its file)");
  }
  return read_calibration(request);
}

Machinery::Machinery(const VehicleConfig& config, const StereoCalibration& calibration, VehicleDevices devices,
                     const KernelTable& kernels, Clock& clock, const Clock& stage_clock)
    : config_(config), clock_(&clock), devices_(std::move(devices)) {
  std::vector<WayPoint> way_points = devices_.way_points ? *devices_.way_points : way_points_of(config_);
  open_devices();
  const int width = devices_.camera.device->width();
  const int height = devices_.camera.device->height();
  require_image_size(calibration, width, height, "camera");

  const std::size_t pipeline_bytes = Pipeline::memory_bytes(config_, calibration, width, height, kernels);
  Arena measure;
  const std::size_t bytes = lay_out(measure, pipeline_bytes);
  if (static_cast<double>(bytes) > config_.memory.limit_mb * kBytesPerMb) {
    throw InputError("memory.limit_mb",
                     fmt::format("{}: the main loop needs {:.1f} MB for images of {}x{} (smaller images, fewer "
                                 "matcher.disparities or matcher.bands, or a higher limit)",
                                 config_.memory.limit_mb, static_cast<double>(bytes) / kBytesPerMb, width, height));
  }
  arena_ = Arena(bytes);
  (void)lay_out(arena_, 0);
  pipeline_ = std::make_unique<Pipeline>(config_, calibration, width, height, kernels, stage_clock,
                                         arena_.part(pipeline_bytes));
  spdlog::info("memory: {:.1f} MB for {}x{}, {} disparities", static_cast<double>(arena_.used()) / kBytesPerMb,
               width, height, config_.matcher.disparities);
  if (config_.safety.plan_age_s > config_.vehicle.latency_s) {
    spdlog::warn(
        "safety.plan_age_s ({}) is more than vehicle.latency_s ({}): the speed governor counts on plans that "
        "are no older than that",
        config_.safety.plan_age_s, config_.vehicle.latency_s);
  }
  warn_of_slow_limits(config_.safety);
  capture_ = std::make_unique<Capture>(config_.safety, *devices_.camera.device, clock, exchange_);
  perception_ = std::make_unique<Perception>(config_, *pipeline_, clock, exchange_);
  if (devices_.compass.device != nullptr) sensing_ = std::make_unique<Sensing>(*devices_.compass.device, exchange_);
  driving_ = std::make_unique<Driving>(*devices_.servo.device, clock, exchange_);
  control_ =
      std::make_unique<Control>(config_, std::move(way_points),
                                ControlDevices{devices_.servo.device->max_speed_mps(),
                                               devices_.compass.device != nullptr, devices_.estop.device.get()},
                                clock, exchange_);
}

Machinery::~Machinery() {
  devices_.servo.device->close();
}

void Machinery::open_devices() {
  open(devices_.servo.device.get(), "drivers.servo: " + config_.drivers.servo);
  open(devices_.estop.device.get(), "drivers.estop: " + config_.drivers.estop);
  open(devices_.compass.device.get(), "drivers.compass: " + config_.drivers.compass);
  open(devices_.camera.device.get(), "drivers.camera: " + config_.drivers.camera);
}

std::size_t Machinery::lay_out(Arena& arena, std::size_t pipeline_bytes) {
  const int width = devices_.camera.device->width();
  const int height = devices_.camera.device->height();
  for (RawPair& raw : exchange_.raw.slots()) {
    raw.left = arena.take_image<std::uint8_t>(width, height);
    raw.right = arena.take_image<std::uint8_t>(width, height);
  }
  for (MapNote& map : exchange_.map.slots())
    map.type = arena.take_image<std::uint8_t>(config_.grid.cols, config_.grid.rows);
  if (pipeline_bytes > 0) (void)arena.part(pipeline_bytes);
  return arena.used();
}

bool Machinery::capture_decodes() const {
  return config_.drivers.camera == "folder" || (config_.drivers.camera == "v4l2" && config_.v4l2.format == "mjpg");
}

}  // namespace lakshya
