// The part of the list of keys (vehicle_config_keys.h) that is about devices.
#pragma once

#include <array>
#include <string_view>

#include "app/core/config_key.h"

namespace lakshya {

inline constexpr std::array<std::string_view, 5> kCameraDrivers{"none", "folder", "v4l2", "dc1394", "sim"};
inline constexpr std::array<std::string_view, 4> kServoDrivers{"record", "quicksilver", "pwm", "sim"};
inline constexpr std::array<std::string_view, 4> kCompassDrivers{"none", "os5000", "iio", "sim"};
inline constexpr std::array<std::string_view, 3> kEstopDrivers{"none", "file", "gpio"};
inline constexpr std::array<std::string_view, 2> kWatchdogDrivers{"none", "linux"};
inline constexpr std::array<std::string_view, 3> kV4l2Formats{"grey", "yuyv", "mjpg"};
inline constexpr std::array<std::string_view, 5> kBayerPatterns{"none", "bggr", "rggb", "grbg", "gbrg"};
inline constexpr std::array<std::string_view, 2> kCommandEnds{"return", "space"};
inline constexpr std::array<std::string_view, 3> kPaces{"recorded", "rate", "fastest"};

template <class Drivers, class Visitor>
void visit_drivers_keys(Drivers& c, Visitor& v) {
  v(Key{"drivers.camera", "",
        "Stereo camera (folder: recorded pairs; v4l2: one or two cameras of the kernel; dc1394: Bumblebee2 or XB3; "
        "sim: "
        "the simulator's)"},
    c.camera, Names{kCameraDrivers});
  v(Key{"drivers.servo", "",
        "Motor drives (record: none, commands are written down; quicksilver: two QuickSilver drives; pwm: two "
        "hobby "
        "drives; sim: the simulator's)"},
    c.servo, Names{kServoDrivers});
  v(Key{"drivers.compass", "",
        "Compass (os5000: OceanServer OS5000; iio: a magnetometer of the kernel; sim: the simulator's)"},
    c.compass, Names{kCompassDrivers});
  v(Key{"drivers.estop", "",
        "Emergency stop that this program reads, besides the switch in the drives' power (file: a file of 0 or 1; "
        "gpio: a switch on a line of a GPIO chip)"},
    c.estop, Names{kEstopDrivers});
  v(Key{"drivers.watchdog", "", "What resets the machine when this program hangs (linux: the machine's own)"},
    c.watchdog, Names{kWatchdogDrivers});
  v(Key{"drivers.unsupervised_speed_mps", "m/s",
        "Greatest speed with drives that nothing stops when this computer has (v_unsupervised)"},
    c.unsupervised_speed_mps, Range{0, 5});
}

template <class Folder, class Visitor>
void visit_folder_keys(Folder& c, Visitor& v) {
  v(Key{"folder.path", "",
        "Recorded sequence: a folder of KITTI odometry, EuRoC, or with the folders left and right; empty: "
        "folder.left and "
        "folder.right"},
    c.path, Text{});
  v(Key{"folder.left", "", "Folder of the left images, or one image"}, c.left, Text{});
  v(Key{"folder.right", "", "Folder of the right images, or one image"}, c.right, Text{});
  v(Key{"folder.pace", "",
        "When the next pair comes (recorded: at the recording's times, where it has none at rate_hz; rate: at "
        "rate_hz; "
        "fastest: when it is asked for)"},
    c.pace, Names{kPaces});
  v(Key{"folder.rate_hz", "Hz", "Pairs per second"}, c.rate_hz, Range{0.01, 1000});
  v(Key{"folder.repeat", "", "Begin again after the last pair"}, c.repeat, Names{kNoYes});
}

template <class V4l2, class Visitor>
void visit_v4l2_keys(V4l2& c, Visitor& v) {
  v(Key{"v4l2.device", "", "Camera's node; better a name that stays, below /dev/v4l/by-id"}, c.device, Text{});
  v(Key{"v4l2.right_device", "", "Node of the right camera; empty: device gives both eyes side by side"},
    c.right_device, Text{});
  v(Key{"v4l2.format", "", "Pixel format (grey: taken as it is; yuyv: luma copied out; mjpg: decoded)"}, c.format,
    Names{kV4l2Formats});
  v(Key{"v4l2.width", "px", "Width of one eye's image"}, c.width, Range{16, 8192, 1});
  v(Key{"v4l2.height", "px", "Height of one eye's image"}, c.height, Range{16, 16384, 1});
  v(Key{"v4l2.fps", "Hz", "Pairs per second; 0: as the camera is set"}, c.fps, Range{0, 1000});
  v(Key{"v4l2.swap", "", "The left half, or device, is the right eye's"}, c.swap, Names{kNoYes});
  v(Key{"v4l2.check_eyes", "", "See from the first pairs which eye is the left one, and correct a wrong order"},
    c.check_eyes, Names{kNoYes});
  v(Key{"v4l2.skew_ms", "ms", "Two cameras: greatest difference between the times of a pair's images"}, c.skew_ms,
    Range{0, 1000});
  v(Key{"v4l2.exposure_us", "us",
        "Exposure of both eyes, in steps of 100; -1: automatic, for two cameras each by itself"},
    c.exposure_us, Range{-1, 1'000'000, 1});
  v(Key{"v4l2.gain", "",
        "Gain of both eyes, in the camera's own unit; -1: automatic, for two cameras each by itself"},
    c.gain, Range{-1, 1'000'000, 1});
  v(Key{"v4l2.buffers", "", "Images that the kernel keeps, of each camera"}, c.buffers, Range{4, 16, 1});
}

template <class Dc1394, class Visitor>
void visit_dc1394_keys(Dc1394& c, Visitor& v) {
  v(Key{"dc1394.guid", "", "The camera's number in hexadecimal digits (on its label); empty: the first one found"},
    c.guid, Text{16});
  v(Key{"dc1394.width", "px", "Width of one eye's image"}, c.width, Range{16, 4096, 2});
  v(Key{"dc1394.height", "px", "Height of one eye's image"}, c.height, Range{16, 4096, 2});
  v(Key{"dc1394.bayer", "", "Colour head: the pattern of its first two rows; none: a grey head"}, c.bayer,
    Names{kBayerPatterns});
  v(Key{"dc1394.first_is_left", "", "The first byte of a pixel is the left eye's"}, c.first_is_left, Names{kNoYes});
  v(Key{"dc1394.check_eyes", "", "See from the first pairs which eye is the left one, and correct a wrong order"},
    c.check_eyes, Names{kNoYes});
  v(Key{"dc1394.packet_bytes", "bytes",
        "Per cycle of the bus, which sets the frame rate; 0: as the camera recommends"},
    c.packet_bytes, Range{0, 8192, 1});
  v(Key{"dc1394.buffers", "", "Images that the kernel keeps"}, c.buffers, Range{2, 32, 1});
}

template <class Record, class Visitor>
void visit_record_keys(Record& c, Visitor& v) {
  v(Key{"record.path", "", "File for the commands, a line \"time_s,left_mps,right_mps\" each; empty: none"}, c.path,
    Text{});
}

template <class Quicksilver, class Visitor>
void visit_quicksilver_keys(Quicksilver& c, Visitor& v) {
  v(Key{"quicksilver.port", "", "Serial port; better a name that stays, below /dev/serial/by-id"}, c.port, Text{});
  v(Key{"quicksilver.baud", "baud", "Speed of the line: 9600, 19200, 38400, 57600, 115200 or 230400"}, c.baud,
    Range{9600, 230400, 1});
  v(Key{"quicksilver.stop_bits", "", "Stop bits"}, c.stop_bits, Range{1, 2, 1});
  v(Key{"quicksilver.left_address", "", "The left drive's address"}, c.left_address, Range{1, 254, 1});
  v(Key{"quicksilver.right_address", "", "The right drive's address"}, c.right_address, Range{1, 254, 1});
  v(Key{"quicksilver.left_direction", "", "-1 where positive counts turn the left wheel backward"},
    c.left_direction, Range{-1, 1, 2});
  v(Key{"quicksilver.right_direction", "", "-1 where positive counts turn the right wheel backward"},
    c.right_direction, Range{-1, 1, 2});
  v(Key{"quicksilver.wheel_radius_m", "m", "Radius of the wheels"}, c.wheel_radius_m, Range{0.01, 2});
  v(Key{"quicksilver.gear_ratio", "", "Revolutions of the motor for one of the wheel"}, c.gear_ratio,
    Range{0.01, 1000});
  v(Key{"quicksilver.counts_per_rev", "", "Counts of the position for one revolution of the motor"},
    c.counts_per_rev, Range{100, 1'000'000, 1});
  v(Key{"quicksilver.supervised", "",
        "The drives run the resident program that stops them when this computer does (docs/quicksilver.md)"},
    c.supervised, Names{kNoYes});
  v(Key{"quicksilver.velocity_register", "",
        "That program's register of the velocity; the acceleration lies before it"},
    c.velocity_register, Range{12, 198, 1});
  v(Key{"quicksilver.counter_register", "", "Its register that must move"}, c.counter_register, Range{11, 198, 1});
  v(Key{"quicksilver.heartbeat_register", "", "Its register that it moves itself"}, c.heartbeat_register,
    Range{11, 198, 1});
  v(Key{"quicksilver.signature_register", "", "Its register that tells it from other programs"},
    c.signature_register, Range{11, 198, 1});
  v(Key{"quicksilver.watchdog_s", "s", "Its time after which it zeroes the velocity"}, c.watchdog_s,
    Range{0.05, 1});
  v(Key{"quicksilver.answer_timeout_s", "s", "Longest time that a drive, and an adapter between, take for a reply"},
    c.answer_timeout_s, Range{0.005, 0.5});
}

template <class Pwm, class Visitor>
void visit_pwm_keys(Pwm& c, Visitor& v) {
  v(Key{"pwm.chip", "", "Number of the chip: N of /sys/class/pwm/pwmchipN"}, c.chip, Range{0, 255, 1});
  v(Key{"pwm.left_channel", "", "The left drive's channel of that chip"}, c.left_channel, Range{0, 63, 1});
  v(Key{"pwm.right_channel", "", "The right drive's channel"}, c.right_channel, Range{0, 63, 1});
  v(Key{"pwm.left_direction", "", "-1 where longer pulses turn the left wheel backward"}, c.left_direction,
    Range{-1, 1, 2});
  v(Key{"pwm.right_direction", "", "-1 where longer pulses turn the right wheel backward"}, c.right_direction,
    Range{-1, 1, 2});
  v(Key{"pwm.left_center_us", "us", "Pulse at which the left wheel rests"}, c.left_center_us, Range{800, 2200, 1});
  v(Key{"pwm.right_center_us", "us", "Pulse at which the right wheel rests"}, c.right_center_us,
    Range{800, 2200, 1});
  v(Key{"pwm.span_us", "us", "From that pulse to the one of full speed"}, c.span_us, Range{1, 1000, 1});
  v(Key{"pwm.period_us", "us", "From one pulse to the next"}, c.period_us, Range{2500, 50000, 1});
  v(Key{"pwm.full_speed_mps", "m/s", "Speed of a wheel at the pulse of full speed"}, c.full_speed_mps,
    Range{0.01, 20});
  v(Key{"pwm.slew_mps2", "m/s^2", "Greatest change of a wheel's speed"}, c.slew_mps2, Range{0.01, 100});
  v(Key{"pwm.supervised", "",
        "The vehicle has something that stops its drives when pulses no longer change or this computer has died"},
    c.supervised, Names{kNoYes});
}

template <class Compass, class Visitor>
void visit_compass_keys(Compass& c, Visitor& v) {
  v(Key{"compass.rate_hz", "Hz", "Readings per second"}, c.rate_hz, Range{1, 100});
  v(Key{"compass.declination_deg", "deg", "Direction of magnetic north from true north, positive to the east"},
    c.declination_deg, Range{-180, 180});
  v(Key{"compass.mounting_deg", "deg",
        "Direction in which the compass points from straight ahead, positive to the left"},
    c.mounting_deg, Range{-180, 180});
}

template <class Os5000, class Visitor>
void visit_os5000_keys(Os5000& c, Visitor& v) {
  v(Key{"os5000.port", "", "Serial port; better a name that stays, below /dev/serial/by-id"}, c.port, Text{});
  v(Key{"os5000.baud", "baud", "Speed of the line: 4800, 9600, 19200, 38400, 57600 or 115200"}, c.baud,
    Range{4800, 115200, 1});
  v(Key{"os5000.set_up", "", "Tell the compass its rate and what to send at the start; no: as stored in it"},
    c.set_up, Names{kNoYes});
  v(Key{"os5000.command_end", "", "What ends a command's number (return: carriage return; space)"}, c.command_end,
    Names{kCommandEnds});
  v(Key{"os5000.pitch_sign", "", "-1 where its pitch is positive nose down"}, c.pitch_sign, Range{-1, 1, 2});
  v(Key{"os5000.roll_sign", "", "-1 where its roll is positive right side up"}, c.roll_sign, Range{-1, 1, 2});
}

template <class Iio, class Visitor>
void visit_iio_keys(Iio& c, Visitor& v) {
  v(Key{"iio.name", "", "As the kernel calls the sensor (hmc5883l); empty: the first with a magnetometer"}, c.name,
    Text{});
  v(Key{"iio.accelerometer", "", "The sensor for tilt, none, or empty: the magnetometer's own if it has one"},
    c.accelerometer, Text{});
  v(Key{"iio.axes", "", "Which of the sensor's axes point forward, left and up: -y,x,z, say"}, c.axes, Text{});
  v(Key{"iio.hard_iron_x_gauss", "gauss",
        "What the vehicle adds to the field (`lakshya compass --calibrate`), forward"},
    c.hard_iron_x_gauss, Range{-10, 10});
  v(Key{"iio.hard_iron_y_gauss", "gauss", "The same to the left"}, c.hard_iron_y_gauss, Range{-10, 10});
  v(Key{"iio.hard_iron_z_gauss", "gauss", "The same upward"}, c.hard_iron_z_gauss, Range{-10, 10});
  v(Key{"iio.soft_iron_xx", "", "Matrix that undoes the field's distortion; it is symmetric"}, c.soft_iron_xx,
    Range{0.1, 10});
  v(Key{"iio.soft_iron_xy", "", "The same"}, c.soft_iron_xy, Range{-10, 10});
  v(Key{"iio.soft_iron_xz", "", "The same"}, c.soft_iron_xz, Range{-10, 10});
  v(Key{"iio.soft_iron_yy", "", "The same"}, c.soft_iron_yy, Range{0.1, 10});
  v(Key{"iio.soft_iron_yz", "", "The same"}, c.soft_iron_yz, Range{-10, 10});
  v(Key{"iio.soft_iron_zz", "", "The same"}, c.soft_iron_zz, Range{0.1, 10});
  v(Key{"iio.min_horizontal_gauss", "gauss", "A level field weaker than this is no compass needle's"},
    c.min_horizontal_gauss, Range{0, 10});
  v(Key{"iio.max_horizontal_gauss", "gauss", "Nor a stronger one"}, c.max_horizontal_gauss, Range{0.01, 100});
  v(Key{"iio.saturated_raw", "", "Number of the converter that means saturated; 0: not known"}, c.saturated_raw,
    Range{0, 100'000'000, 1});
}

template <class Odometry, class Visitor>
void visit_odometry_keys(Odometry& c, Visitor& v) {
  v(Key{"odometry.heading_time_s", "s",
        "Time constant with which the compass corrects the wheels' heading at 0.5 m/s straight on"},
    c.heading_time_s, Range{0.01, 100});
  v(Key{"odometry.heading_jump_deg", "deg", "A heading that differs by more from the wheels' is not believed"},
    c.heading_jump_deg, Range{1, 180});
  v(Key{"odometry.jump_hold_s", "s", "Unless it has done so for this long: then the wheels have slipped"},
    c.jump_hold_s, Range{0, 100});
}

template <class Estop, class Visitor>
void visit_estop_keys(Estop& c, Visitor& v) {
  v(Key{"estop.path", "", "file: it begins with 1 when the stop is pressed and with 0 when not"}, c.path, Text{});
  v(Key{"estop.chip", "", "gpio: name, label or path of the chip (pinctrl-bcm2711, say)"}, c.chip, Text{});
  v(Key{"estop.line", "", "gpio: number of the line on that chip; -1: not given"}, c.line, Range{-1, 1023, 1});
  v(Key{"estop.active_low", "",
        "gpio: the switch closes to ground when it is pressed; no: it opens, and a cut wire is seen"},
    c.active_low, Names{kNoYes});
}

template <class Watchdog, class Visitor>
void visit_watchdog_keys(Watchdog& c, Visitor& v) {
  v(Key{"watchdog.path", "", "linux: the watchdog's device"}, c.path, Text{});
  v(Key{"watchdog.timeout_s", "s",
        "linux: it acts so long after this program's last sign of life; hardware may round it"},
    c.timeout_s, Range{1, 3600, 1});
}

template <class Config, class Visitor>
void visit_device_keys(Config& c, Visitor& v) {
  visit_drivers_keys(c.drivers, v);
  visit_folder_keys(c.folder, v);
  visit_v4l2_keys(c.v4l2, v);
  visit_dc1394_keys(c.dc1394, v);
  visit_record_keys(c.record, v);
  visit_quicksilver_keys(c.quicksilver, v);
  visit_pwm_keys(c.pwm, v);
  visit_compass_keys(c.compass, v);
  visit_os5000_keys(c.os5000, v);
  visit_iio_keys(c.iio, v);
  visit_odometry_keys(c.odometry, v);
  visit_estop_keys(c.estop, v);
  visit_watchdog_keys(c.watchdog, v);
}

}  // namespace lakshya
