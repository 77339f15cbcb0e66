// The part of the list of keys (vehicle_config_keys.h) that is about devices.
#pragma once

#include <array>
#include <string_view>

#include "app/core/config_key.h"

namespace lakshya {

inline constexpr std::array<std::string_view, 3> kCameraDrivers{"none", "folder", "sim"};
inline constexpr std::array<std::string_view, 3> kServoDrivers{"record", "pwm", "sim"};
inline constexpr std::array<std::string_view, 2> kCompassDrivers{"none", "sim"};
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

template <class Record, class Visitor>
void visit_record_keys(Record& c, Visitor& v) {
  v(Key{"record.path", "", "File for the commands, a line \"time_s,left_mps,right_mps\" each; empty: none"}, c.path,
    Text{});
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
        "Direction in which the compass points from straight ahead, positive to the right"},
    c.mounting_deg, Range{-180, 180});
}

template <class Odometry, class Visitor>
void visit_odometry_keys(Odometry& c, Visitor& v) {
  v(Key{"odometry.heading_time_s", "s", "Time constant with which the compass corrects the wheels' heading"},
    c.heading_time_s, Range{0.01, 100});
  v(Key{"odometry.heading_jump_deg", "deg", "A heading that differs by more from the wheels' is not believed"},
    c.heading_jump_deg, Range{1, 180});
  v(Key{"odometry.jump_hold_s", "s", "Unless it has done so for this long: then the wheels have slipped"},
    c.jump_hold_s, Range{0, 100});
}

template <class Config, class Visitor>
void visit_device_keys(Config& c, Visitor& v) {
  visit_drivers_keys(c.drivers, v);
  visit_folder_keys(c.folder, v);
  visit_record_keys(c.record, v);
  visit_pwm_keys(c.pwm, v);
  visit_compass_keys(c.compass, v);
  visit_odometry_keys(c.odometry, v);
}

}  // namespace lakshya
