#include "app/core/devices.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <string>
#include <utility>

#include "app/core/device_config_keys.h"
#include "app/core/input_error.h"
#include "app/core/recorded_folder.h"
#include "hal/camera/bumblebee_camera.h"
#include "hal/camera/dc1394_camera.h"
#include "hal/camera/folder_camera.h"
#include "hal/camera/v4l2_camera.h"
#include "hal/compass/iio_compass.h"
#include "hal/compass/os5000.h"
#include "hal/estop/file_estop.h"
#include "hal/estop/gpio_estop.h"
#include "hal/estop/gpiod_line.h"
#include "hal/serial/tty_port.h"
#include "hal/servo/pwm_servo.h"
#include "hal/servo/quicksilver.h"
#include "hal/servo/record_servo.h"
#include "hal/watchdog/linux_watchdog.h"

namespace lakshya {
namespace {

// ---- what a driver needs from the configuration

template <class Kind>
Made<Kind> none(const VehicleConfig& /*config*/, Clock& /*clock*/) {
  return {};
}

template <class Kind>
Made<Kind> sim(const VehicleConfig& /*config*/, Clock& /*clock*/) {
  throw InputError("drivers", "\"sim\" is the simulator's (choose a driver of a device)");
}

bool yes(const std::string& answer) {
  return answer == kNoYes[1];
}

// The enumerator in the place of the name in its list: both are in the same order.
template <class Enum, class Names>
Enum by_name(const Names& names, const std::string& name) {
  return static_cast<Enum>(std::ranges::find(names, name) - names.begin());
}

void require_port(const std::string& key, const std::string& port) {
  if (port.empty())
    throw InputError(key, "no serial port is given (`lakshya devices` lists those of this machine)");
}

Made<StereoCamera> folder(const VehicleConfig& config, Clock& clock) {
  const FolderConfig& c = config.folder;
  auto pairs = std::make_shared<RecordedFolder>(c);
  const FolderCameraSettings settings{
      .pace = by_name<Pace>(kPaces, c.pace), .rate_hz = c.rate_hz, .repeat = yes(c.repeat)};
  auto camera = std::make_unique<FolderCamera>(settings, *pairs, clock);
  return {std::move(pairs), std::move(camera)};
}

Made<StereoCamera> v4l2(const VehicleConfig& config, Clock& clock) {
  const V4l2Config& c = config.v4l2;
  V4l2Settings settings{.device = c.device,
                        .right_device = c.right_device,
                        .format = by_name<V4l2Format>(kV4l2Formats, c.format),
                        .width = c.width,
                        .height = c.height,
                        .fps = c.fps,
                        .swap = yes(c.swap),
                        .check_eyes = yes(c.check_eyes),
                        .skew_ms = c.skew_ms,
                        .exposure_us = c.exposure_us,
                        .gain = c.gain,
                        .buffers = c.buffers};
  return {nullptr, std::make_unique<V4l2Camera>(std::move(settings), clock)};
}

Made<StereoCamera> dc1394(const VehicleConfig& config, Clock& clock) {
  const Dc1394Config& c = config.dc1394;
  std::uint64_t guid = 0;
  const char* const end = c.guid.data() + c.guid.size();
  if (!c.guid.empty() && std::from_chars(c.guid.data(), end, guid, 16).ptr != end)
    throw InputError("dc1394.guid", "\"" + c.guid + "\" is no hexadecimal number (see the camera's label)");
  const BumblebeeSettings settings{.guid = guid,
                                   .width = c.width,
                                   .height = c.height,
                                   .pattern = by_name<BayerPattern>(kBayerPatterns, c.bayer),
                                   .first_is_left = yes(c.first_is_left),
                                   .check_eyes = yes(c.check_eyes),
                                   .packet_bytes = c.packet_bytes,
                                   .buffers = c.buffers};
  std::shared_ptr<IidcCamera> bus = make_dc1394_camera();
  auto camera = std::make_unique<BumblebeeCamera>(settings, *bus, clock);
  return {std::move(bus), std::move(camera)};
}

Made<Servo> record(const VehicleConfig& config, Clock& clock) {
  return {nullptr, std::make_unique<RecordServo>(RecordServoSettings{.path = config.record.path,
                                                                     .max_speed_mps = config.vehicle.max_speed_mps},
                                                 clock)};
}

Made<Servo> quicksilver(const VehicleConfig& config, Clock& clock) {
  const QuicksilverConfig& c = config.quicksilver;
  require_port("quicksilver.port", c.port);
  const auto wheel = [&c](int address, int direction) {
    return QuickSilverWheel{.address = address,
                            .direction = direction,
                            .radius_m = c.wheel_radius_m,
                            .gear_ratio = c.gear_ratio,
                            .counts_per_rev = c.counts_per_rev};
  };
  const QuickSilverWheel left = wheel(c.left_address, c.left_direction);
  // Motors that cannot turn so fast are asked for what they can.
  constexpr double kFastestRpm = 3999;
  const double fastest_mps = kFastestRpm / std::abs(motor_rpm_per_mps(left));
  const QuickSilverSettings settings{
      .left = left,
      .right = wheel(c.right_address, c.right_direction),
      .max_speed_mps = std::min(config.vehicle.max_speed_mps, fastest_mps),
      // The drives' own ramp must not be the slower one: the speed governor counts on the vehicle's braking.
      .max_acceleration_mps2 = std::max(config.vehicle.acceleration_mps2, config.vehicle.deceleration_mps2),
      .supervised = yes(c.supervised),
      .v_unsupervised_mps = config.drivers.unsupervised_speed_mps,
      .velocity_register = c.velocity_register,
      .counter_register = c.counter_register,
      .heartbeat_register = c.heartbeat_register,
      .signature_register = c.signature_register,
      .watchdog_s = c.watchdog_s,
      .answer_timeout_s = c.answer_timeout_s};
  auto port =
      std::make_shared<TtyPort>(TtySettings{.path = c.port, .baud = c.baud, .stop_bits = c.stop_bits}, clock);
  auto servo = std::make_unique<QuickSilver>(settings, *port, clock);
  return {std::move(port), std::move(servo)};
}

Made<Servo> pwm(const VehicleConfig& config, Clock& clock) {
  const PwmConfig& c = config.pwm;
  PwmServoSettings settings;
  settings.chip = c.chip;
  settings.channel = {c.left_channel, c.right_channel};
  settings.direction = {c.left_direction, c.right_direction};
  settings.center_us = {c.left_center_us, c.right_center_us};
  settings.span_us = c.span_us;
  settings.period_us = c.period_us;
  settings.full_speed_mps = c.full_speed_mps;
  settings.max_speed_mps = std::min(c.full_speed_mps, config.vehicle.max_speed_mps);
  settings.slew_mps2 = c.slew_mps2;
  settings.supervised = yes(c.supervised);
  settings.unsupervised_mps = config.drivers.unsupervised_speed_mps;
  return {nullptr, std::make_unique<PwmServo>(std::move(settings), clock)};
}

Made<Compass> os5000(const VehicleConfig& config, Clock& clock) {
  const Os5000Config& c = config.os5000;
  require_port("os5000.port", c.port);
  const Os5000Settings settings{.set_up = yes(c.set_up),
                                .commands_end_with_space = c.command_end == kCommandEnds[1],
                                .rate_hz = static_cast<int>(std::lround(config.compass.rate_hz)),
                                .baud = c.baud,
                                .declination_deg = config.compass.declination_deg,
                                .mounting_deg = config.compass.mounting_deg,
                                .pitch_sign = c.pitch_sign,
                                .roll_sign = c.roll_sign};
  auto port = std::make_shared<TtyPort>(TtySettings{.path = c.port, .baud = c.baud}, clock);
  auto compass = std::make_unique<Os5000>(settings, *port, clock);
  return {std::move(port), std::move(compass)};
}

// "-y,x,z": rows of the matrix from the sensor's axes to forward, left and up.
Matrix3 axes_matrix(const std::string& text) {
  Matrix3 matrix{};
  std::size_t at = 0;
  for (std::size_t row = 0; row < 3; ++row) {
    if (row > 0 && (at >= text.size() || text[at++] != ',')) return {};
    const bool negative = at < text.size() && text[at] == '-';
    if (negative) ++at;
    if (at >= text.size() || text[at] < 'x' || text[at] > 'z') return {};
    matrix[3 * row + static_cast<std::size_t>(text[at++] - 'x')] = negative ? -1 : 1;
  }
  return at == text.size() && is_rotation(matrix) ? matrix : Matrix3{};
}

Made<Compass> iio(const VehicleConfig& config, Clock& clock) {
  return {nullptr, std::make_unique<IioCompass>(iio_settings(config), linux_system_calls(), clock)};
}

Made<EmergencyStop> file(const VehicleConfig& config, Clock& /*clock*/) {
  if (config.estop.path.empty()) throw InputError("estop.path", "no file is given (it says 0 or 1)");
  return {nullptr, std::make_unique<FileEstop>(FileEstopSettings{.path = config.estop.path})};
}

Made<EmergencyStop> gpio(const VehicleConfig& config, Clock& /*clock*/) {
  const EstopConfig& c = config.estop;
  if (c.chip.empty()) throw InputError("estop.chip", "no GPIO chip is given (they are /dev/gpiochip*)");
  if (c.line < 0) throw InputError("estop.line", "no line of " + c.chip + " is given (docs/wiring.md)");
  GpioEstopSettings settings{.chip = c.chip, .line = c.line, .active_low = yes(c.active_low)};
  std::shared_ptr<GpioLine> line = make_gpiod_line();
  auto estop = std::make_unique<GpioEstop>(std::move(settings), *line);
  return {std::move(line), std::move(estop)};
}

Made<Watchdog> linux_watchdog(const VehicleConfig& config, Clock& /*clock*/) {
  const WatchdogConfig& c = config.watchdog;
  return {nullptr,
          std::make_unique<LinuxWatchdog>(LinuxWatchdogSettings{.path = c.path, .timeout_s = c.timeout_s})};
}

// ---- the lists

constexpr Driver<StereoCamera> kCameras[] = {
    {"none", none}, {"folder", folder}, {"v4l2", v4l2}, {"dc1394", dc1394}, {"sim", sim}};
constexpr Driver<Servo> kServos[] = {{"record", record}, {"quicksilver", quicksilver}, {"pwm", pwm}, {"sim", sim}};
constexpr Driver<Compass> kCompasses[] = {{"none", none}, {"os5000", os5000}, {"iio", iio}, {"sim", sim}};
constexpr Driver<EmergencyStop> kEstops[] = {{"none", none}, {"file", file}, {"gpio", gpio}};
constexpr Driver<Watchdog> kWatchdogs[] = {{"none", none}, {"linux", linux_watchdog}};

template <class Kind>
Made<Kind> make(std::span<const Driver<Kind>> drivers, const std::string& name, const VehicleConfig& config,
                Clock& clock) {
  const auto found = std::ranges::find(drivers, name, &Driver<Kind>::name);
  if (found == drivers.end()) throw InputError("drivers", "\"" + name + "\" is no driver in this program");
  return found->make(config, clock);
}

}  // namespace

std::span<const Driver<StereoCamera>> camera_drivers() {
  return kCameras;
}
std::span<const Driver<Servo>> servo_drivers() {
  return kServos;
}
std::span<const Driver<Compass>> compass_drivers() {
  return kCompasses;
}
std::span<const Driver<EmergencyStop>> estop_drivers() {
  return kEstops;
}
std::span<const Driver<Watchdog>> watchdog_drivers() {
  return kWatchdogs;
}

Made<StereoCamera> make_camera(const VehicleConfig& config, Clock& clock) {
  return make(camera_drivers(), config.drivers.camera, config, clock);
}
Made<Servo> make_servo(const VehicleConfig& config, Clock& clock) {
  return make(servo_drivers(), config.drivers.servo, config, clock);
}
Made<Compass> make_compass(const VehicleConfig& config, Clock& clock) {
  return make(compass_drivers(), config.drivers.compass, config, clock);
}
Made<EmergencyStop> make_estop(const VehicleConfig& config, Clock& clock) {
  return make(estop_drivers(), config.drivers.estop, config, clock);
}
Made<Watchdog> make_watchdog(const VehicleConfig& config, Clock& clock) {
  return make(watchdog_drivers(), config.drivers.watchdog, config, clock);
}

IioCompassSettings iio_settings(const VehicleConfig& config) {
  const IioConfig& c = config.iio;
  const Matrix3 axes = axes_matrix(c.axes);
  if (axes == Matrix3{}) {
    throw InputError("iio.axes",
                     "\"" + c.axes + "\" does not say which axes point forward, left and up " +
                         "(x, y and z once each, with a minus where opposite, and right-handed: -y,x,z)");
  }
  IioCompassSettings settings;
  settings.name = c.name;
  settings.accelerometer = c.accelerometer;
  settings.rate_hz = config.compass.rate_hz;
  settings.axes = axes;
  settings.hard_iron = {c.hard_iron_x_gauss, c.hard_iron_y_gauss, c.hard_iron_z_gauss};
  settings.soft_iron = {c.soft_iron_xx, c.soft_iron_xy, c.soft_iron_xz, c.soft_iron_xy, c.soft_iron_yy,
                        c.soft_iron_yz, c.soft_iron_xz, c.soft_iron_yz, c.soft_iron_zz};
  settings.declination_deg = config.compass.declination_deg;
  settings.mounting_deg = config.compass.mounting_deg;
  settings.min_horizontal_gauss = c.min_horizontal_gauss;
  settings.max_horizontal_gauss = c.max_horizontal_gauss;
  settings.saturated_raw = c.saturated_raw;
  return settings;
}

WheelOdometrySettings odometry_settings(const VehicleConfig& config) {
  return {.track_m = config.vehicle.track_m,
          .has_compass = config.drivers.compass != "none",
          .heading_time_s = config.odometry.heading_time_s,
          .heading_jump_deg = config.odometry.heading_jump_deg,
          .jump_hold_s = config.odometry.jump_hold_s,
          .max_speed_mps = 1.5 * config.vehicle.max_speed_mps};  // downhill, or pushed
}

}  // namespace lakshya
