#include "hal/compass/magnetometer_fit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>

namespace lakshya {
namespace {

using Samples = std::span<const Vector3>;

constexpr int kUnknowns = 5;
constexpr int kBins = 72;
constexpr double kBinDeg = 360.0 / kBins;
constexpr int kShortGap = 4;  // bins: less than that is between two samples
constexpr int kMostRounds = 20;

struct Point {
  double x, y;
};

// The corrected sample is `shape` * (sample - centre), with length 1 on the ellipse. `shape` is symmetric.
struct Ellipse {
  Point centre;
  double xx, xy, yy;

  Point corrected(const Vector3& s) const {
    const double x = s[0] - centre.x;
    const double y = s[1] - centre.y;
    return {xx * x + xy * y, xy * x + yy * y};
  }
  double off(const Vector3& s) const {
    const Point p = corrected(s);
    return std::hypot(p.x, p.y) - 1;
  }
};

// The value that a share of all values of a function of the samples does not pass, by bisection: no memory, and 60 rounds are
// enough for every double between `low` and `high` that matters here.
template <class Value>
double quantile(Samples samples, double share, double low, double high, Value value) {
  const double wanted = share * static_cast<double>(samples.size());
  for (int round = 0; round < 60; ++round) {
    const double middle = low + (high - low) / 2;
    const auto below =
        std::count_if(samples.begin(), samples.end(), [&](const Vector3& s) { return value(s) <= middle; });
    (static_cast<double>(below) < wanted ? low : high) = middle;
  }
  return high;
}

// Where nearly all samples lie.
struct Range {
  double low, high;
  double width() const { return high - low; }
  double middle() const { return low + width() / 2; }
  // Outliers reach far out of it, a part of an ellipse that is rarely visited does not.
  bool is_near(double value) const { return value >= low - width() && value <= high + width(); }
};

Range range_of(Samples samples, std::size_t axis) {
  const auto by_axis = [axis](const Vector3& a, const Vector3& b) { return a[axis] < b[axis]; };
  const auto [least, most] = std::minmax_element(samples.begin(), samples.end(), by_axis);
  const auto value = [axis](const Vector3& s) { return s[axis]; };
  return {quantile(samples, 0.02, (*least)[axis], (*most)[axis], value),
          quantile(samples, 0.98, (*least)[axis], (*most)[axis], value)};
}

// Sums of a weighted least-squares problem, and its solution (Cholesky).
class NormalEquations {
 public:
  void add(const std::array<double, kUnknowns>& row, double right, double weight) {
    for (std::size_t i = 0; i < kUnknowns; ++i) {
      for (std::size_t j = 0; j <= i; ++j)
        left_[i][j] += weight * row[i] * row[j];
      right_[i] += weight * row[i] * right;
    }
  }

  // False when the samples do not determine the unknowns.
  bool solve(std::array<double, kUnknowns>& unknowns) {
    constexpr double kLeastPivot = 1e-10;
    for (std::size_t i = 0; i < kUnknowns; ++i) {
      const double diagonal = left_[i][i];
      for (std::size_t j = 0; j <= i; ++j) {
        for (std::size_t k = 0; k < j; ++k)
          left_[i][j] -= left_[i][k] * left_[j][k];
        if (j < i) left_[i][j] /= left_[j][j];
      }
      if (!(left_[i][i] > kLeastPivot * diagonal)) return false;
      left_[i][i] = std::sqrt(left_[i][i]);
    }
    for (std::size_t i = 0; i < kUnknowns; ++i) {
      for (std::size_t k = 0; k < i; ++k)
        right_[i] -= left_[i][k] * right_[k];
      right_[i] /= left_[i][i];
    }
    for (std::size_t i = kUnknowns; i-- > 0;) {
      for (std::size_t k = i + 1; k < kUnknowns; ++k)
        right_[i] -= left_[k][i] * right_[k];
      right_[i] /= left_[i][i];
    }
    unknowns = right_;
    return true;
  }

 private:
  std::array<std::array<double, kUnknowns>, kUnknowns> left_{};  // lower triangle
  std::array<double, kUnknowns> right_{};
};

// In samples' units from p, q, d, e, f of moved and scaled ones. False when they are no ellipse.
bool ellipse_of(const std::array<double, kUnknowns>& found, Point middle, double scale, Ellipse& ellipse) {
  const auto [p, q, d, e, f] = found;
  const double determinant = 1 - p * p - q * q;
  if (!(determinant > 0)) return false;
  // (1 + p, q; q, 1 - p) centre = -(d, e) / 2.
  const Point centre = {-((1 - p) * d - q * e) / (2 * determinant), -((1 + p) * e - q * d) / (2 * determinant)};
  const double level =
      (1 + p) * centre.x * centre.x + 2 * q * centre.x * centre.y + (1 - p) * centre.y * centre.y - f;
  if (!(level > 0)) return false;
  // The root of a symmetric matrix M of 2 x 2 is (M + sqrt(det M)) / sqrt(trace M + 2 sqrt(det M)).
  const double root = std::sqrt(determinant);
  const double norm = std::sqrt(2 + 2 * root) * std::sqrt(level) * scale;
  ellipse = {.centre = {middle.x + scale * centre.x, middle.y + scale * centre.y},
             .xx = (1 + p + root) / norm,
             .xy = q / norm,
             .yy = (1 - p + root) / norm};
  return true;
}

template <class Weight>
bool fit_ellipse(Samples samples, Point middle, double scale, Weight weight, Ellipse& ellipse) {
  NormalEquations equations;
  for (const Vector3& s : samples) {
    const double w = weight(s);
    if (w == 0) continue;
    const double x = (s[0] - middle.x) / scale;
    const double y = (s[1] - middle.y) / scale;
    equations.add({x * x - y * y, 2 * x * y, x, y, 1}, -(x * x + y * y), w);
  }
  std::array<double, kUnknowns> found{};
  return equations.solve(found) && ellipse_of(found, middle, scale, ellipse);
}

// How far a sample may be off before it counts for nothing: 4.685 standard deviations, from the median (Tukey's biweight).
double reach_of(Samples samples, const Ellipse& ellipse) {
  constexpr double kLeast = 1e-9;  // samples without noise
  const auto off = [&](const Vector3& s) { return std::abs(ellipse.off(s)); };
  return std::max(4.685 * 1.4826 * quantile(samples, 0.5, 0, 2, off), kLeast);
}

bool fit_robustly(Samples samples, Ellipse& ellipse, double& reach) {
  const Range forward = range_of(samples, 0);
  const Range left = range_of(samples, 1);
  const Point middle = {forward.middle(), left.middle()};
  const double scale = std::max(forward.width(), left.width()) / 2;
  if (!(scale > 0)) return false;
  const auto near = [&](const Vector3& s) { return forward.is_near(s[0]) && left.is_near(s[1]) ? 1.0 : 0.0; };
  if (!fit_ellipse(samples, middle, scale, near, ellipse)) return false;
  for (int round = 0; round < kMostRounds; ++round) {
    reach = reach_of(samples, ellipse);
    const Ellipse before = ellipse;
    const auto biweight = [&](const Vector3& s) {
      const double part = before.off(s) / reach;
      const double left_over = std::max(1 - part * part, 0.0);
      return left_over * left_over;
    };
    if (!fit_ellipse(samples, middle, scale, biweight, ellipse)) return false;
    const double moved = std::hypot(ellipse.centre.x - before.centre.x, ellipse.centre.y - before.centre.y);
    if (moved < 1e-6 * scale) break;  // less than a thousandth of a degree of heading
  }
  reach = reach_of(samples, ellipse);
  return true;
}

double coverage_deg(const std::array<bool, kBins>& seen) {
  const auto first = static_cast<int>(std::find(seen.begin(), seen.end(), true) - seen.begin());
  if (first == kBins) return 0;
  int missing = 0;
  int gap = 0;
  for (int i = 1; i <= kBins; ++i) {  // round, and back to the first
    if (!seen[static_cast<std::size_t>((first + i) % kBins)]) {
      ++gap;
      continue;
    }
    if (gap >= kShortGap) missing += gap;
    gap = 0;
  }
  return 360 - missing * kBinDeg;
}

// Residual, outliers and coverage.
void judge(Samples samples, const Ellipse& ellipse, double reach, MagnetometerFit& fit) {
  std::array<bool, kBins> seen{};
  double squares = 0;
  double kept = 0;
  for (const Vector3& s : samples) {
    const double off = ellipse.off(s);
    if (!(std::abs(off) < reach)) continue;
    squares += off * off;
    ++kept;
    const Point p = ellipse.corrected(s);
    const double turn = std::atan2(p.y, p.x) / (2 * std::numbers::pi) + 0.5;
    seen[static_cast<std::size_t>(turn * kBins) % kBins] = true;
  }
  fit.outliers = 1 - kept / static_cast<double>(samples.size());
  fit.residual = kept > 0 ? std::sqrt(squares / kept) : 0;
  fit.coverage_deg = coverage_deg(seen);
}

void describe(const Ellipse& e, MagnetometerFit& fit) {
  fit.radius = 1 / std::sqrt(e.xx * e.yy - e.xy * e.xy);
  fit.hard_iron = {e.centre.x, e.centre.y, 0};
  fit.soft_iron = {fit.radius * e.xx, fit.radius * e.xy, 0, fit.radius * e.xy, fit.radius * e.yy, 0, 0, 0, 1};
  const double mean = (e.xx + e.yy) / 2;
  const double difference = std::hypot((e.xx - e.yy) / 2, e.xy);
  fit.axis_ratio = (mean + difference) / (mean - difference);
}

bool are_possible(const MagnetometerFitLimits& l) {
  return l.min_samples >= 20 && l.min_coverage_deg >= 180 && l.min_coverage_deg <= 360 && l.max_residual > 0 &&
         l.max_axis_ratio > 1 && l.max_outliers >= 0 && l.max_outliers <= 0.5;
}

Status refused(MagnetometerRefusal why, MagnetometerFit& fit) {
  fit.refusal = why;
  return Status::bad_data;
}

}  // namespace

Status fit_magnetometer(Samples samples, const MagnetometerFitLimits& limits, MagnetometerFit& fit) {
  fit = {};
  const bool all_finite =
      std::all_of(samples.begin(), samples.end(), [](const Vector3& s) { return std::isfinite(dot(s, s)); });
  if (!are_possible(limits) || !all_finite) return Status::bad_argument;
  if (samples.size() < static_cast<std::size_t>(limits.min_samples)) {
    return refused(MagnetometerRefusal::too_few_samples, fit);
  }
  Ellipse ellipse{};
  double reach = 0;
  if (!fit_robustly(samples, ellipse, reach)) return refused(MagnetometerRefusal::degenerate, fit);
  describe(ellipse, fit);
  judge(samples, ellipse, reach, fit);
  if (!(fit.axis_ratio <= limits.max_axis_ratio)) return refused(MagnetometerRefusal::degenerate, fit);
  if (fit.residual > limits.max_residual || fit.outliers > limits.max_outliers) {
    return refused(MagnetometerRefusal::large_residual, fit);
  }
  if (fit.coverage_deg < limits.min_coverage_deg) return refused(MagnetometerRefusal::little_coverage, fit);
  return Status::ok;
}

}  // namespace lakshya
