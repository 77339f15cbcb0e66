#include "hal/compass/attitude.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

namespace lakshya {
namespace {

using Matrix = std::array<std::array<double, 3>, 3>;

Matrix times(const Matrix& a, const Matrix& b) {
  Matrix out{};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      for (std::size_t k = 0; k < 3; ++k)
        out[i][j] += a[i][k] * b[k][j];
    }
  }
  return out;
}

Matrix about_x(double a) {
  return {{{1, 0, 0}, {0, std::cos(a), -std::sin(a)}, {0, std::sin(a), std::cos(a)}}};
}
Matrix about_y(double a) {
  return {{{std::cos(a), 0, std::sin(a)}, {0, 1, 0}, {-std::sin(a), 0, std::cos(a)}}};
}
Matrix about_z(double a) {
  return {{{std::cos(a), -std::sin(a), 0}, {std::sin(a), std::cos(a), 0}, {0, 0, 1}}};
}

// From body axes (forward, left, up) to the world's (east, north, up).
Matrix rotation_of(const HeadingSample& s) {
  return times(about_z(s.yaw), times(about_y(-s.pitch), about_x(s.roll)));
}

// The device turned by the mounting from the vehicle, written with matrices.
TEST(Attitude, AgreesWithRotationMatrices) {
  for (const double yaw : {-3.0, -0.4, 0.0, 2.1}) {
    for (const double pitch : {-1.2, -0.3, 0.0, 0.7}) {
      for (const double roll : {-2.5, -0.2, 0.0, 0.9}) {
        for (const double mounting : {-3.1, -0.5, 0.0, 0.1, 1.5707963}) {
          const Matrix vehicle = rotation_of({.yaw = yaw, .pitch = pitch, .roll = roll});
          const Matrix device = times(vehicle, about_z(mounting));
          // The device's own angles, read off its matrix.
          const HeadingSample measured = {.yaw = std::atan2(device[1][0], device[0][0]),
                                          .pitch = std::asin(device[2][0]),
                                          .roll = std::atan2(device[2][1], device[2][2]),
                                          .time = 7};
          const HeadingSample back = seen_from_vehicle(measured, mounting);
          EXPECT_NEAR(wrapped_angle(back.yaw - yaw), 0, 1e-9);
          EXPECT_NEAR(back.pitch, pitch, 1e-9);
          EXPECT_NEAR(back.roll, roll, 1e-9);
          EXPECT_EQ(back.time, 7);
        }
      }
    }
  }
}

TEST(Attitude, WithoutTiltOnlyYawIsTurned) {
  const double none = std::nan("");
  const HeadingSample back = seen_from_vehicle({.yaw = 3.0, .pitch = none, .roll = 0.1}, -1.0);
  EXPECT_NEAR(back.yaw, 4.0 - 2 * std::numbers::pi, 1e-12);
  EXPECT_TRUE(std::isnan(back.pitch));
  EXPECT_TRUE(std::isnan(back.roll));
}

TEST(Attitude, OfVectorsInTheFourDirections) {
  const Vector3 up = {0, 0, 2};
  double horizontal = 0;
  // The field points north and 60 degrees down. North ahead, to the left, behind, to the right: heading 0, 90, 180, 270.
  const double down = -std::sqrt(3.0);
  EXPECT_NEAR(attitude_of({1, 0, down}, up, horizontal).yaw, std::numbers::pi / 2, 1e-12);
  EXPECT_NEAR(horizontal, 1, 1e-12);
  EXPECT_NEAR(attitude_of({0, 1, down}, up, horizontal).yaw, 0, 1e-12);
  EXPECT_NEAR(attitude_of({-1, 0, down}, up, horizontal).yaw, -std::numbers::pi / 2, 1e-12);
  EXPECT_NEAR(attitude_of({0, -1, down}, up, horizontal).yaw, std::numbers::pi, 1e-12);
  // Nose up: the forward axis points up. Right side down: the left axis does.
  EXPECT_NEAR(attitude_of({1, 0, 0}, {1, 0, 1}, horizontal).pitch, std::numbers::pi / 4, 1e-12);
  EXPECT_NEAR(attitude_of({1, 0, 0}, {0, 1, 1}, horizontal).roll, std::numbers::pi / 4, 1e-12);
}

TEST(Attitude, OfVectorsAgreesWithRotationMatrices) {
  const Vector3 north_and_down = {0, 0.2, -0.45};  // east, north, up
  for (const double yaw : {-3.0, -0.4, 0.0, 2.1}) {
    for (const double pitch : {-1.2, -0.3, 0.0, 0.7}) {
      for (const double roll : {-2.5, -0.2, 0.0, 0.9}) {
        const Matrix body = rotation_of({.yaw = yaw, .pitch = pitch, .roll = roll});
        Vector3 field{};
        Vector3 up{};
        for (std::size_t i = 0; i < 3; ++i) {
          up[i] = 9.81 * body[2][i];
          for (std::size_t j = 0; j < 3; ++j)
            field[i] += body[j][i] * north_and_down[j];
        }
        double horizontal = 0;
        const HeadingSample s = attitude_of(field, up, horizontal);
        EXPECT_NEAR(wrapped_angle(s.yaw - yaw), 0, 1e-9);
        EXPECT_NEAR(s.pitch, pitch, 1e-9);
        EXPECT_NEAR(s.roll, roll, 1e-9);
        EXPECT_NEAR(horizontal, 0.2, 1e-12);
      }
    }
  }
}

TEST(Matrix3, KnowsARotation) {
  EXPECT_TRUE(is_rotation(kIdentity3));
  EXPECT_TRUE(is_rotation({1, 0, 0, 0, 0.866, 0.5, 0, -0.5, 0.866})) << "the kernel's example";
  EXPECT_FALSE(is_rotation({1, 0, 0, 0, 1, 0, 0, 0, -1})) << "a mirror";
  EXPECT_FALSE(is_rotation({1, 0.1, 0, 0, 1, 0, 0, 0, 1}));
  EXPECT_FALSE(is_rotation({}));
  EXPECT_FALSE(is_rotation({1, 0, 0, 0, 1, 0, 0, 0, std::nan("")}));
  EXPECT_EQ(determinant({2, 0, 1, 0, 3, 0, 0, 0, 4}), 24);
}

}  // namespace
}  // namespace lakshya
