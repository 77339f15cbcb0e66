#include "hal/compass/iio_compass.h"

#include <fcntl.h>
#include <gtest/gtest.h>

#include <cerrno>
#include <cmath>
#include <filesystem>
#include <functional>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "tests/support/count_allocations.h"
#include "tests/support/manual_clock.h"
#include "tests/support/temp_folder.h"

namespace lakshya {
namespace {

constexpr double kDegree = std::numbers::pi / 180;
constexpr double kPi = std::numbers::pi;

// The kernel's calls, until a test says what a reading answers instead.
class InterruptedCalls final : public SystemCalls {
 public:
  int open(const char* path, int flags) override {
    const int fd = unplugged ? -ENOENT : linux_system_calls().open(path, flags);
    opened += fd >= 0 ? 1 : 0;
    return fd;
  }
  int close(int fd) override {
    ++closed;
    return linux_system_calls().close(fd);
  }
  int ioctl(int fd, unsigned long request, void* argument) override {
    return linux_system_calls().ioctl(fd, request, argument);
  }
  void* mmap(int /*fd*/, std::size_t /*bytes*/, std::int64_t /*offset*/) override { return nullptr; }
  void munmap(void* /*memory*/, std::size_t /*bytes*/) override {}
  long read_at_start(int fd, std::span<char> buffer) override {
    ++reads;
    if (before_read) before_read();
    return error != 0 ? -error : linux_system_calls().read_at_start(fd, buffer);
  }
  long write_at_start(int fd, std::span<const char> bytes) override {
    return linux_system_calls().write_at_start(fd, bytes);
  }

  std::function<void()> before_read;
  int error = 0;
  int opened = 0;
  int closed = 0;
  int reads = 0;
  bool unplugged = false;
};

class IioCompassTest : public testing::Test {
 protected:
  // A magnetometer of 1000 counts a gauss as device1; device0 is a sensor of light.
  IioCompassTest() {
    attribute("iio:device0/name", "tsl2563");
    attribute("iio:device0/in_illuminance_raw", "12");
    attribute("iio:device1/name", "hmc5883");
    attribute("iio:device1/in_magn_scale", "0.001");
    field(200, 0, -450);
  }

  void attribute(const std::string& path, const std::string& text) {
    std::filesystem::create_directories(std::filesystem::path(folder_.path(path)).parent_path());
    (void)folder_.write(path, text + "\n");
  }

  void triad(const std::string& what, int x, int y, int z) {
    attribute(what + "_x_raw", std::to_string(x));
    attribute(what + "_y_raw", std::to_string(y));
    attribute(what + "_z_raw", std::to_string(z));
  }
  void field(int x, int y, int z) { triad("iio:device1/in_magn", x, y, z); }
  // Of 100 counts a m/s^2.
  void acceleration(const std::string& device, int x, int y, int z) {
    attribute(device + "/in_accel_x_scale", "0.01");
    attribute(device + "/in_accel_y_scale", "0.01");
    attribute(device + "/in_accel_z_scale", "0.01");
    triad(device + "/in_accel", x, y, z);
  }

  IioCompassSettings settings() const {
    IioCompassSettings s;
    s.root = folder_.path("");
    return s;
  }

  // One reading of a compass with these settings.
  Status read_once(const IioCompassSettings& s) {
    IioCompass compass(s, calls_, clock_);
    EXPECT_EQ(compass.open(), Status::ok) << compass.problem();
    const Status status = compass.read(clock_.now() + kSecond, sample_);
    problem_ = compass.problem();
    return status;
  }

  Status open_once(const IioCompassSettings& s) {
    IioCompass compass(s, calls_, clock_);
    const Status status = compass.open();
    problem_ = compass.problem();
    return status;
  }

  bool says(const std::string& words) const { return problem_.find(words) != std::string::npos; }

  TempFolder folder_;
  InterruptedCalls calls_;
  ManualClock clock_;
  HeadingSample sample_;
  std::string problem_;
};

TEST_F(IioCompassTest, LevelHeadings) {
  ASSERT_EQ(read_once(settings()), Status::ok) << problem_;
  EXPECT_NEAR(sample_.yaw, kPi / 2, 1e-12) << "north ahead";
  EXPECT_TRUE(std::isnan(sample_.pitch));
  EXPECT_TRUE(std::isnan(sample_.roll));
  field(0, 200, -450);
  ASSERT_EQ(read_once(settings()), Status::ok);
  EXPECT_NEAR(sample_.yaw, 0, 1e-12) << "north to the left: it looks east";
  field(0, -200, -450);
  ASSERT_EQ(read_once(settings()), Status::ok);
  EXPECT_NEAR(sample_.yaw, kPi, 1e-12) << "west";
  EXPECT_EQ(calls_.opened, calls_.closed);
}

TEST_F(IioCompassTest, DeclinationAndMounting) {
  IioCompassSettings s = settings();
  s.declination_deg = 10;
  s.mounting_deg = 30;
  // The device looks to magnetic north, which is 10 degrees east of true north; the vehicle looks 30 degrees right of that.
  ASSERT_EQ(read_once(s), Status::ok) << problem_;
  EXPECT_NEAR(sample_.yaw, (90 - 10 - 30) * kDegree, 1e-12);
}

TEST_F(IioCompassTest, TheTiltIsTakenOut) {
  // Nose 30 degrees up, looking north, field 0.2 north and 0.45 down: worked out by hand.
  const double p = 30 * kDegree;
  field(static_cast<int>(std::lround(1e3 * (0.2 * std::cos(p) - 0.45 * std::sin(p)))), 0,
        static_cast<int>(std::lround(1e3 * (-0.2 * std::sin(p) - 0.45 * std::cos(p)))));
  ASSERT_EQ(read_once(settings()), Status::ok);
  EXPECT_NEAR(std::abs(sample_.yaw), kPi / 2, 0.01) << "without an accelerometer it may be turned round";
  EXPECT_LT(sample_.yaw, 0);
  acceleration("iio:device1", 491, 0, 849);
  ASSERT_EQ(read_once(settings()), Status::ok) << problem_;
  EXPECT_NEAR(sample_.yaw, kPi / 2, 0.01);
  EXPECT_NEAR(sample_.pitch, p, 0.002);
  EXPECT_NEAR(sample_.roll, 0, 1e-9);
  // The accelerometer may be left out, or be another device.
  IioCompassSettings s = settings();
  s.accelerometer = "none";
  ASSERT_EQ(read_once(s), Status::ok);
  EXPECT_TRUE(std::isnan(sample_.pitch));
  attribute("iio:device7/name", "adxl345");
  acceleration("iio:device7", 0, 694, 694);
  s.accelerometer = "adxl345";
  ASSERT_EQ(read_once(s), Status::ok) << problem_;
  EXPECT_NEAR(sample_.pitch, 0, 1e-9);
  EXPECT_NEAR(sample_.roll, kPi / 4, 1e-9) << "right side down";
  std::filesystem::remove(folder_.path("iio:device7/in_accel_y_raw"));
  EXPECT_EQ(open_once(s), Status::unsupported);
  EXPECT_TRUE(says("in_accel_y_raw")) << problem_;
  s.accelerometer = "bma180";
  EXPECT_EQ(open_once(s), Status::disconnected);
  EXPECT_TRUE(says("no bma180")) << problem_;
}

TEST_F(IioCompassTest, MountingTurnsTiltToo) {
  acceleration("iio:device1", 491, 0, 849);
  IioCompassSettings s = settings();
  s.mounting_deg =
      90;  // the device looks to the vehicle's left, and its nose is up: the vehicle's right side is down
  ASSERT_EQ(read_once(s), Status::ok) << problem_;
  EXPECT_NEAR(sample_.pitch, 0, 1e-9);
  EXPECT_NEAR(sample_.roll, std::atan2(491, 849), 1e-9);
}

TEST_F(IioCompassTest, MountMatricesAndAxes) {
  // x right, y ahead: a screen's axes, from a chip that is turned by a quarter.
  attribute("iio:device1/in_mount_matrix", "0, -1, 0; 1, 0, 0; 0, 0, 1");
  IioCompassSettings s = settings();
  s.axes = {0, 1, 0, -1, 0, 0, 0, 0, 1};
  ASSERT_EQ(read_once(s), Status::ok) << problem_;
  EXPECT_NEAR(sample_.yaw, kPi / 2, 1e-12) << "chip x is the screen's y, ahead";
  s.axes = kIdentity3;
  ASSERT_EQ(read_once(s), Status::ok);
  EXPECT_NEAR(sample_.yaw, 0, 1e-12);
  attribute("iio:device1/in_magn_mount_matrix", "1, 0, 0; 0, 1, 0; 0, 0, 1");
  ASSERT_EQ(read_once(s), Status::ok);
  EXPECT_NEAR(sample_.yaw, kPi / 2, 1e-12) << "the channel's own matrix comes first";
  attribute("iio:device1/in_magn_mount_matrix", "1, 0, 0; 0, 1, 0; 0, 0, -1");
  EXPECT_EQ(open_once(s), Status::unsupported);
  EXPECT_TRUE(says("in_magn_mount_matrix: is no rotation")) << problem_;
}

TEST_F(IioCompassTest, HardAndSoftIronAreTakenOff) {
  IioCompassSettings s = settings();
  s.hard_iron = {0.5, -0.3, 0};
  s.soft_iron = {2, 0, 0, 0, 1, 0, 0, 0, 1};
  field(500 + 50, -300 + 100, -450);
  ASSERT_EQ(read_once(s), Status::ok) << problem_;
  EXPECT_NEAR(sample_.yaw, kPi / 4, 1e-12);
}

TEST_F(IioCompassTest, TheFieldForACalibrationIsNotCorrected) {
  IioCompassSettings s = settings();
  s.hard_iron = {0.5, -0.3, 0};
  s.soft_iron = {2, 0, 0, 0, 1, 0, 0, 0, 1};
  s.mounting_deg = 45;
  s.axes = {0, 1, 0, -1, 0, 0, 0, 0, 1};
  field(900, 100, -450);
  IioCompass compass(s, calls_, clock_);
  ASSERT_EQ(compass.open(), Status::ok) << compass.problem();
  FieldSample got;
  ASSERT_EQ(compass.read_field(clock_.now(), got), Status::ok);
  EXPECT_NEAR(got.field_gauss[0], 0.1, 1e-12);
  EXPECT_NEAR(got.field_gauss[1], -0.9, 1e-12);
  EXPECT_NEAR(got.field_gauss[2], -0.45, 1e-12);
  EXPECT_TRUE(std::isnan(got.acceleration[0]));
}

TEST_F(IioCompassTest, KeepsItsRateAndTheDeadline) {
  IioCompassSettings s = settings();
  s.rate_hz = 20;
  IioCompass compass(s, calls_, clock_);
  ASSERT_EQ(compass.open(), Status::ok) << compass.problem();
  const Nanoseconds start = clock_.now();
  for (int i = 0; i < 4; ++i) {
    ASSERT_EQ(compass.read(start + kSecond, sample_), Status::ok);
    EXPECT_EQ(sample_.time, start + i * (kSecond / 20));
  }
  const int reads = calls_.reads;
  EXPECT_EQ(compass.read(clock_.now() + 49 * kMillisecond, sample_), Status::timeout);
  EXPECT_EQ(clock_.now(), start + 199 * kMillisecond);
  EXPECT_EQ(calls_.reads, reads) << "nothing was measured";
  EXPECT_STREQ(compass.counters()[2].name, "timeouts");
  EXPECT_EQ(compass.counters()[2].value, 1U);
  clock_.advance(kSecond);
  ASSERT_EQ(compass.read(clock_.now(), sample_), Status::ok) << "late, but one sample is due";
  EXPECT_EQ(compass.read(clock_.now(), sample_), Status::timeout);
}

TEST_F(IioCompassTest, TheTimeIsTheMiddleOfTheMagnetometersReadings) {
  acceleration("iio:device1", 0, 0, 981);
  IioCompass compass(settings(), calls_, clock_);
  ASSERT_EQ(compass.open(), Status::ok) << compass.problem();
  calls_.before_read = [this] { clock_.advance(2 * kMillisecond); };
  const Nanoseconds start = clock_.now();
  ASSERT_EQ(compass.read(start + kSecond, sample_), Status::ok);
  EXPECT_EQ(clock_.now(), start + 12 * kMillisecond);
  EXPECT_EQ(sample_.time, start + 3 * kMillisecond);
}

TEST_F(IioCompassTest, WhatIsNoNeedlesFieldIsBadData) {
  const auto refused = [this](const IioCompassSettings& s, const char* words) {
    EXPECT_EQ(read_once(s), Status::bad_data) << words;
    EXPECT_TRUE(says(words)) << problem_;
  };
  field(0, 0, 0);
  refused(settings(), "horizontal field");
  field(0, 0, -450);
  refused(settings(), "horizontal field");
  field(-4096, 100, -450);  // what an HMC5883L says when it overflows
  refused(settings(), "horizontal field");
  acceleration("iio:device1", 0, 0, 981);
  IioCompassSettings s = settings();
  s.saturated_raw = 2000;
  s.hard_iron = {2, 0, 0};
  field(1999, 200, -450);
  EXPECT_EQ(read_once(s), Status::ok) << problem_;
  field(2000, 200, -450);
  EXPECT_EQ(open_once(s), Status::bad_data);
  EXPECT_TRUE(says("saturated")) << problem_;
}

TEST_F(IioCompassTest, ABadReadingIsCountedAndTheNextMayBeGood) {
  acceleration("iio:device1", 0, 0, 981);
  IioCompass compass(settings(), calls_, clock_);
  ASSERT_EQ(compass.open(), Status::ok) << compass.problem();
  const auto read = [&] { return compass.read(clock_.now() + kSecond, sample_); };
  triad("iio:device1/in_accel", 0, 0, 400);
  EXPECT_EQ(read(), Status::bad_data);
  EXPECT_NE(std::string(compass.problem()).find("acceleration"), std::string::npos) << compass.problem();
  triad("iio:device1/in_accel", 0, 0, 981);
  attribute("iio:device1/in_magn_y_raw", "1x");
  EXPECT_EQ(read(), Status::bad_data);
  EXPECT_NE(std::string(compass.problem()).find("in_magn_y_raw: no number"), std::string::npos)
      << compass.problem();
  attribute("iio:device1/in_magn_y_raw", "");
  EXPECT_EQ(read(), Status::bad_data);
  attribute("iio:device1/in_magn_y_raw", "0");
  calls_.error = EBUSY;
  EXPECT_EQ(read(), Status::bad_data);
  EXPECT_NE(std::string(compass.problem()).find("busy"), std::string::npos) << compass.problem();
  calls_.error = 0;
  EXPECT_EQ(read(), Status::ok);
  EXPECT_EQ(compass.counters()[0].value, 3U) << compass.counters()[0].name;
  EXPECT_EQ(compass.counters()[1].value, 1U) << compass.counters()[1].name;
  EXPECT_EQ(compass.counters()[3].value, 0U) << compass.counters()[3].name;
}

TEST_F(IioCompassTest, AnUnpluggedDeviceIsFoundAgainUnderAnotherNumber) {
  IioCompassSettings s = settings();
  s.rate_hz = 100;
  IioCompass compass(s, calls_, clock_);
  ASSERT_EQ(compass.open(), Status::ok) << compass.problem();
  const auto read = [&](int ms) { return compass.read(clock_.now() + ms * kMillisecond, sample_); };
  ASSERT_EQ(read(100), Status::ok);
  calls_.error = ENODEV;
  calls_.unplugged = true;
  EXPECT_EQ(read(100), Status::disconnected);
  const Nanoseconds gone = clock_.now();
  EXPECT_EQ(calls_.opened, calls_.closed);
  const int opened = calls_.opened;
  EXPECT_EQ(read(150), Status::disconnected);
  EXPECT_EQ(clock_.now(), gone + 150 * kMillisecond);
  EXPECT_EQ(read(150), Status::disconnected);
  EXPECT_EQ(clock_.now(), gone + 200 * kMillisecond);
  EXPECT_EQ(calls_.opened, opened);

  std::filesystem::rename(folder_.path("iio:device1"), folder_.path("iio:device4"));
  calls_.error = 0;
  calls_.unplugged = false;
  EXPECT_EQ(read(100), Status::disconnected) << "not looked for yet";
  ASSERT_EQ(read(300), Status::ok) << compass.problem();
  EXPECT_EQ(clock_.now(), gone + 400 * kMillisecond);
  EXPECT_EQ(compass.counters()[3].value, 1U) << compass.counters()[3].name;
  compass.close();
  EXPECT_EQ(calls_.opened, calls_.closed);
  EXPECT_EQ(read(100), Status::disconnected);
  EXPECT_STREQ(compass.problem(), "magnetometer: is not open");
}

TEST_F(IioCompassTest, ReadAllocatesNothing) {
  acceleration("iio:device1", 0, 0, 981);
  IioCompass compass(settings(), calls_, clock_);
  ASSERT_EQ(compass.open(), Status::ok) << compass.problem();
  const int before = test::allocations;
  EXPECT_EQ(compass.read(clock_.now() + kSecond, sample_), Status::ok);
  calls_.error = EIO;
  EXPECT_EQ(compass.read(clock_.now() + kSecond, sample_), Status::bad_data);
  calls_.error = ENXIO;
  EXPECT_EQ(compass.read(clock_.now() + kSecond, sample_), Status::disconnected);
  EXPECT_EQ(compass.read(clock_.now() + kSecond, sample_), Status::disconnected);
  calls_.error = 0;
  EXPECT_EQ(compass.read(clock_.now() + kSecond, sample_), Status::ok);
  EXPECT_EQ(test::allocations, before);
}

TEST_F(IioCompassTest, FindsADeviceByNameAndSaysWhatIsMissing) {
  attribute("iio:device3/name", "ak8963");
  attribute("iio:device3/in_magn_scale", "0.0015");
  IioCompassSettings s = settings();
  s.name = "ak8963";
  EXPECT_EQ(open_once(s), Status::unsupported);
  EXPECT_TRUE(says("iio:device3/in_magn_x_raw")) << problem_;
  triad("iio:device3/in_magn", 0, 100, 0);
  ASSERT_EQ(read_once(s), Status::ok) << problem_;
  EXPECT_NEAR(sample_.yaw, 0, 1e-12);
  for (const char* const scale : {"0", "x", ""}) {
    attribute("iio:device3/in_magn_scale", scale);
    EXPECT_EQ(open_once(s), Status::unsupported) << scale;
    EXPECT_TRUE(says("no scale")) << problem_;
  }
  s.name = "lis3mdl";
  EXPECT_EQ(open_once(s), Status::disconnected);
  EXPECT_TRUE(says("no lis3mdl")) << problem_;
  s.name = "";
  s.root = folder_.path("nowhere");
  EXPECT_EQ(open_once(s), Status::disconnected);
  EXPECT_TRUE(says("no magnetometer")) << problem_;
}

TEST_F(IioCompassTest, ImpossibleSettingsAreRefused) {
  const double none = std::nan("");
  const std::vector<std::pair<std::function<void(IioCompassSettings&)>, std::string>> cases = {
      {[](auto& s) { s.root = std::string(129, 'x'); }, "root"},
      {[](auto& s) { s.rate_hz = 0; }, "rate_hz"},
      {[](auto& s) { s.rate_hz = 101; }, "rate_hz"},
      {[=](auto& s) { s.rate_hz = none; }, "rate_hz"},
      {[](auto& s) { s.axes[0] = -1; }, "axes"},
      {[=](auto& s) { s.hard_iron[2] = none; }, "hard_iron"},
      {[](auto& s) { s.soft_iron = {}; }, "soft_iron"},
      {[=](auto& s) { s.soft_iron[1] = none; }, "soft_iron"},
      {[](auto& s) { s.declination_deg = -181; }, "declination_deg"},
      {[](auto& s) { s.mounting_deg = 181; }, "mounting_deg"},
      {[](auto& s) { s.min_horizontal_gauss = 0; }, "min_horizontal_gauss"},
      {[](auto& s) { s.max_horizontal_gauss = 0.01; }, "max_horizontal_gauss"},
      {[](auto& s) { s.saturated_raw = -1; }, "saturated_raw"},
  };
  for (const auto& [spoil, words] : cases) {
    IioCompassSettings s = settings();
    spoil(s);
    EXPECT_EQ(open_once(s), Status::bad_argument) << words;
    EXPECT_TRUE(says(words)) << problem_;
  }
  EXPECT_EQ(calls_.opened, 0);
}

}  // namespace
}  // namespace lakshya
