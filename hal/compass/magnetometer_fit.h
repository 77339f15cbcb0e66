// What the vehicle's own iron does to a magnetometer, from samples of a turn on the spot.
//
// The vehicle stands level and turns; the level part of the earth's field then runs round a circle in its axes (forward, left).
// Hard iron (what is magnetized and turns along) moves the circle's centre, soft iron (what is magnetized by the earth) makes it
// an ellipse. The ellipse is fitted by least squares of x^2 + y^2 + p (x^2 - y^2) + 2 q x y + d x + e y + f = 0, which does not
// depend on how the axes are turned, in coordinates moved and scaled to about 1; then again with weights that take samples far
// off out (Tukey's biweight), until nothing moves.
//
// What a turn on the spot cannot show: the offset and scale along the up axis, so hard_iron[2] is 0 and the matrix leaves the up
// axis alone; and a rotation of the whole field, which is left to mounting_deg. On a slope the error of what is not known shows
// with the slope's sine.
#pragma once

#include <cstdint>
#include <span>

#include "hal/compass/matrix3.h"
#include "kernels/base/status.h"

namespace lakshya {

struct MagnetometerFitLimits {
  int min_samples = 100;          // at least 20
  double min_coverage_deg = 270;  // 180 to 360
  double max_residual = 0.05;     // above 0, of the radius
  double max_axis_ratio = 2;      // above 1, long axis to short one: more is a motor or a mistake, not soft iron
  double max_outliers = 0.1;      // 0 to 0.5, share of the samples
};

enum class MagnetometerRefusal : std::uint8_t {
  none,
  too_few_samples,
  degenerate,       // no ellipse: it did not turn, or something near it moved; or longer than max_axis_ratio allows
  little_coverage,  // not turned far enough
  large_residual,   // no clean ellipse: max_residual or max_outliers is passed
};

constexpr const char* to_string(MagnetometerRefusal refusal) {
  switch (refusal) {
    case MagnetometerRefusal::none:
      return "none";
    case MagnetometerRefusal::too_few_samples:
      return "too few samples";
    case MagnetometerRefusal::degenerate:
      return "the samples lie on no ellipse";
    case MagnetometerRefusal::little_coverage:
      return "too little of a full turn";
    case MagnetometerRefusal::large_residual:
      return "the samples lie too far from the ellipse";
  }
  return "unknown";
}

// For IioCompassSettings: soft_iron * (field - hard_iron) runs on a circle.
struct MagnetometerFit {
  Vector3 hard_iron{};             // the unit of the samples
  Matrix3 soft_iron = kIdentity3;  // symmetric, determinant 1
  double radius = 0;               // of the circle, the unit of the samples: the earth's level field, nearly
  double axis_ratio = 0;           // of the ellipse, 1 or more
  double residual = 0;             // root mean square of |corrected| / radius - 1, without outliers
  double outliers = 0;             // share of the samples
  double coverage_deg = 0;         // directions seen, in steps of 5 degrees; gaps below 20 degrees count as seen
  MagnetometerRefusal refusal = MagnetometerRefusal::none;
};

// `samples` in axes forward, left, up (FieldSample::field_gauss), in any order; a vehicle that stood still for a part of them
// does no harm. bad_argument: impossible limits, or a sample that is not finite; bad_data: `refusal` says why, the numbers of
// `fit` are what was found until then. Allocates nothing.
Status fit_magnetometer(std::span<const Vector3> samples, const MagnetometerFitLimits& limits,
                        MagnetometerFit& fit);

}  // namespace lakshya
