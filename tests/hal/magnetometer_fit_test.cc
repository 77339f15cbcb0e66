#include "hal/compass/magnetometer_fit.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "tests/support/count_allocations.h"

namespace lakshya {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

// A vehicle that turns: the earth's field of 0.2 gauss level and 0.45 down, distorted and moved.
struct Turn {
  int samples = 400;
  double from_deg = 0;
  double to_deg = 360;
  Vector3 hard_iron{};
  Matrix3 distortion = kIdentity3;
  double noise = 0;     // standard deviation, of the radius
  double outliers = 0;  // share, up to 3 radii away
  unsigned seed = 1;

  static constexpr double kRadius = 0.2;

  Vector3 at(double heading_deg) const {
    const Vector3 earth = {kRadius * std::cos(heading_deg * kDegree), kRadius * std::sin(heading_deg * kDegree),
                           -0.45};
    const Vector3 seen = distortion * earth;
    return {seen[0] + hard_iron[0], seen[1] + hard_iron[1], seen[2] + hard_iron[2]};
  }

  std::vector<Vector3> made() const {
    std::mt19937 random(seed);
    std::normal_distribution<double> normal(0, noise > 0 ? noise * kRadius : 1);
    std::uniform_real_distribution<double> anywhere(-3 * kRadius, 3 * kRadius);
    std::vector<Vector3> out;
    for (int i = 0; i < samples; ++i) {
      Vector3 s = at(from_deg + (to_deg - from_deg) * i / samples);
      const bool is_outlier = static_cast<int>(i * outliers) != static_cast<int>((i + 1) * outliers);
      for (double& v : s)
        v += is_outlier ? anywhere(random) : (noise > 0 ? normal(random) : 0);
      out.push_back(s);
    }
    return out;
  }

  // The largest error of a direction after correction.
  double worst_deg(const MagnetometerFit& fit) const {
    double worst = 0;
    for (int deg = 0; deg < 360; ++deg) {
      const Vector3 c = fit.soft_iron * (at(deg) - fit.hard_iron);
      worst = std::max(worst, std::abs(std::remainder(std::atan2(c[1], c[0]) / kDegree - deg, 360.0)));
    }
    return worst;
  }
};

MagnetometerFit fitted(const std::vector<Vector3>& samples, Status expected = Status::ok) {
  MagnetometerFit fit;
  EXPECT_EQ(fit_magnetometer(samples, {}, fit), expected)
      << to_string(fit.refusal) << ": residual " << fit.residual << ", outliers " << fit.outliers << ", coverage "
      << fit.coverage_deg << ", axis ratio " << fit.axis_ratio;
  return fit;
}

// Of symmetric soft iron: 1.2 along 30 degrees, 0.9 across.
Matrix3 soft() {
  const double c = std::cos(30 * kDegree);
  const double s = std::sin(30 * kDegree);
  return {1.2 * c * c + 0.9 * s * s, 0.3 * c * s, 0, 0.3 * c * s, 1.2 * s * s + 0.9 * c * c, 0, 0, 0, 1};
}

TEST(MagnetometerFit, ACircleAtTheOriginIsLeftAlone) {
  const MagnetometerFit fit = fitted(Turn{}.made());
  EXPECT_NEAR(fit.radius, 0.2, 1e-9);
  EXPECT_NEAR(fit.residual, 0, 1e-9);
  EXPECT_NEAR(fit.axis_ratio, 1, 1e-9);
  EXPECT_EQ(fit.coverage_deg, 360);
  EXPECT_EQ(fit.outliers, 0);
  for (std::size_t i = 0; i < 9; ++i)
    EXPECT_NEAR(fit.soft_iron[i], kIdentity3[i], 1e-9);
  for (const double offset : fit.hard_iron)
    EXPECT_NEAR(offset, 0, 1e-9);
}

// Four corners and the middles between them, worked out by hand: the ellipse x^2/9 + y^2/4 = 1 about (10, -20).
TEST(MagnetometerFit, AnEllipseByHand) {
  std::vector<Vector3> samples;
  for (int i = 0; i < 40; ++i) {
    const double a = i * 9 * kDegree;
    samples.push_back({10 + 3 * std::cos(a), -20 + 2 * std::sin(a), 5});
  }
  MagnetometerFit fit;
  ASSERT_EQ(fit_magnetometer(samples, {.min_samples = 40}, fit), Status::ok) << to_string(fit.refusal);
  const double radius = std::sqrt(6.0);
  EXPECT_NEAR(fit.radius, radius, 1e-9);
  EXPECT_NEAR(fit.axis_ratio, 1.5, 1e-9);
  EXPECT_NEAR(fit.hard_iron[0], 10, 1e-9);
  EXPECT_NEAR(fit.hard_iron[1], -20, 1e-9);
  EXPECT_EQ(fit.hard_iron[2], 0);
  const Matrix3 expected = {radius / 3, 0, 0, 0, radius / 2, 0, 0, 0, 1};
  for (std::size_t i = 0; i < 9; ++i)
    EXPECT_NEAR(fit.soft_iron[i], expected[i], 1e-9) << i;
  EXPECT_NEAR(determinant(fit.soft_iron), 1, 1e-9);
}

TEST(MagnetometerFit, AnOffsetOfFiveRadiiAndSoftIronAreUndone) {
  const Turn turn = {.hard_iron = {0.8, -0.6, 0.3}, .distortion = soft()};  // 1 gauss
  const MagnetometerFit fit = fitted(turn.made());
  EXPECT_NEAR(fit.hard_iron[0], 0.8, 1e-9);
  EXPECT_NEAR(fit.hard_iron[1], -0.6, 1e-9);
  EXPECT_EQ(fit.hard_iron[2], 0) << "the up axis cannot be seen in a turn";
  EXPECT_NEAR(fit.axis_ratio, 1.2 / 0.9, 1e-9);
  EXPECT_LT(turn.worst_deg(fit), 1e-6);
}

TEST(MagnetometerFit, NoiseIsAveraged) {
  double worst = 0;
  for (unsigned seed = 0; seed < 50; ++seed) {
    const Turn turn = {.hard_iron = {0.8, -0.6, 0.3}, .distortion = soft(), .noise = 0.02, .seed = seed};
    const MagnetometerFit fit = fitted(turn.made());
    EXPECT_NEAR(fit.residual, 0.02, 0.004);
    EXPECT_LT(fit.outliers, 0.02);
    worst = std::max(worst, turn.worst_deg(fit));
  }
  RecordProperty("worst_deg", std::to_string(worst));
  EXPECT_LT(worst, 0.6);
}

TEST(MagnetometerFit, OutliersAreTakenOut) {
  double worst = 0;
  for (unsigned seed = 0; seed < 50; ++seed) {
    const Turn turn = {
        .hard_iron = {0.8, -0.6, 0.3}, .distortion = soft(), .noise = 0.02, .outliers = 0.06, .seed = seed};
    const MagnetometerFit fit = fitted(turn.made());
    EXPECT_GT(fit.outliers, 0.03);
    worst = std::max(worst, turn.worst_deg(fit));
  }
  RecordProperty("worst_deg", std::to_string(worst));
  EXPECT_LT(worst, 0.6);
}

TEST(MagnetometerFit, StandingStillForALongTimeDoesNoHarm) {
  const Turn turn = {.hard_iron = {0.8, -0.6, 0}, .distortion = soft(), .noise = 0.02};
  std::vector<Vector3> samples = turn.made();
  const std::vector<Vector3> still = Turn{.samples = 1200,
                                          .to_deg = 0,
                                          .hard_iron = turn.hard_iron,
                                          .distortion = turn.distortion,
                                          .noise = 0.02,
                                          .seed = 9}
                                         .made();
  samples.insert(samples.end(), still.begin(), still.end());
  EXPECT_LT(turn.worst_deg(fitted(samples)), 1);
}

TEST(MagnetometerFit, ThreeQuartersOfATurnAreEnough) {
  double worst = 0;
  for (unsigned seed = 0; seed < 50; ++seed) {
    const Turn turn = {.from_deg = 20,
                       .to_deg = 305,
                       .hard_iron = {0.3, 0.1, 0},
                       .distortion = soft(),
                       .noise = 0.01,
                       .seed = seed};
    const MagnetometerFit fit = fitted(turn.made());
    EXPECT_NEAR(fit.coverage_deg, 285, 15);
    worst = std::max(worst, turn.worst_deg(fit));
  }
  RecordProperty("worst_deg", std::to_string(worst));
  EXPECT_LT(worst, 1);
}

TEST(MagnetometerFit, LessIsRefusedWhateverTheNoise) {
  for (const double to : {2.0, 20.0, 60.0, 120.0, 180.0, 220.0, 250.0}) {
    for (const double noise : {0.0, 0.001, 0.01, 0.03, 0.1}) {
      for (unsigned seed = 0; seed < 6; ++seed) {
        const Turn turn = {.to_deg = to, .hard_iron = {0.8, -0.6, 0}, .noise = noise, .seed = seed};
        const MagnetometerFit fit = fitted(turn.made(), Status::bad_data);
        EXPECT_NE(fit.refusal, MagnetometerRefusal::none);
        EXPECT_NE(fit.refusal, MagnetometerRefusal::too_few_samples);
      }
    }
  }
  EXPECT_EQ(fitted(Turn{.to_deg = 200}.made(), Status::bad_data).refusal, MagnetometerRefusal::little_coverage);
}

TEST(MagnetometerFit, GapsInTheMiddleCount) {
  std::vector<Vector3> samples;
  for (const double from : {0.0, 120.0, 240.0}) {
    for (const Vector3& s : Turn{.samples = 100, .from_deg = from, .to_deg = from + 75}.made())
      samples.push_back(s);
  }
  const MagnetometerFit fit = fitted(samples, Status::bad_data);
  EXPECT_EQ(fit.refusal, MagnetometerRefusal::little_coverage);
  EXPECT_NEAR(fit.coverage_deg, 225, 10);
}

TEST(MagnetometerFit, WhatIsNoEllipseIsRefused) {
  const auto refusal_of = [](const std::vector<Vector3>& samples) {
    return fitted(samples, Status::bad_data).refusal;
  };
  EXPECT_EQ(refusal_of({}), MagnetometerRefusal::too_few_samples);
  EXPECT_EQ(refusal_of(Turn{.samples = 99}.made()), MagnetometerRefusal::too_few_samples);
  EXPECT_EQ(refusal_of(std::vector<Vector3>(200, {0.1, 0.2, 0.3})), MagnetometerRefusal::degenerate);
  EXPECT_EQ(refusal_of(std::vector<Vector3>(200)), MagnetometerRefusal::degenerate);
  std::vector<Vector3> line(200);
  for (std::size_t i = 0; i < line.size(); ++i)
    line[i] = {0.001 * static_cast<double>(i), 0.002 * static_cast<double>(i), 0};
  EXPECT_EQ(refusal_of(line), MagnetometerRefusal::degenerate);
  EXPECT_EQ(refusal_of(Turn{.distortion = {1, 0, 0, 0, 0.4, 0, 0, 0, 1}}.made()), MagnetometerRefusal::degenerate);
  EXPECT_EQ(refusal_of(Turn{.noise = 0.08}.made()), MagnetometerRefusal::large_residual);
  EXPECT_EQ(refusal_of(Turn{.noise = 0.01, .outliers = 0.2}.made()), MagnetometerRefusal::large_residual);
}

TEST(MagnetometerFit, ImpossibleLimitsAndNumbersAreRefused) {
  std::vector<Vector3> samples = Turn{}.made();
  MagnetometerFit fit;
  for (const MagnetometerFitLimits& limits :
       {MagnetometerFitLimits{.min_samples = 19}, MagnetometerFitLimits{.min_coverage_deg = 170},
        MagnetometerFitLimits{.min_coverage_deg = 361}, MagnetometerFitLimits{.max_residual = 0},
        MagnetometerFitLimits{.max_axis_ratio = 1}, MagnetometerFitLimits{.max_outliers = 0.6},
        MagnetometerFitLimits{.max_residual = std::nan("")}}) {
    EXPECT_EQ(fit_magnetometer(samples, limits, fit), Status::bad_argument);
  }
  samples[7][2] = std::nan("");
  EXPECT_EQ(fit_magnetometer(samples, {}, fit), Status::bad_argument);
}

TEST(MagnetometerFit, AllocatesNothing) {
  const std::vector<Vector3> samples = Turn{.noise = 0.02, .outliers = 0.05}.made();
  MagnetometerFit fit;
  const int before = test::allocations;
  const Status status = fit_magnetometer(samples, {}, fit);
  EXPECT_EQ(test::allocations, before);
  EXPECT_EQ(status, Status::ok);
}

}  // namespace
}  // namespace lakshya
