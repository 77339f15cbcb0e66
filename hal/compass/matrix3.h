// Vectors and matrices of three dimensions, as much as compasses need.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

namespace lakshya {

using Vector3 = std::array<double, 3>;
using Matrix3 = std::array<double, 9>;  // row by row

inline constexpr Matrix3 kIdentity3 = {1, 0, 0, 0, 1, 0, 0, 0, 1};

inline double dot(const Vector3& a, const Vector3& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

inline Vector3 operator-(const Vector3& a, const Vector3& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

inline Vector3 operator*(const Matrix3& m, const Vector3& v) {
  return {m[0] * v[0] + m[1] * v[1] + m[2] * v[2], m[3] * v[0] + m[4] * v[1] + m[5] * v[2],
          m[6] * v[0] + m[7] * v[1] + m[8] * v[2]};
}

inline double determinant(const Matrix3& m) {
  return m[0] * (m[4] * m[8] - m[5] * m[7]) - m[1] * (m[3] * m[8] - m[5] * m[6]) +
         m[2] * (m[3] * m[7] - m[4] * m[6]);
}

// Orthogonal and no mirror, to what three decimals in a device tree can say.
inline bool is_rotation(const Matrix3& m) {
  constexpr double kTolerance = 0.005;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      const double product = m[3 * i] * m[3 * j] + m[3 * i + 1] * m[3 * j + 1] + m[3 * i + 2] * m[3 * j + 2];
      if (!(std::abs(product - (i == j ? 1 : 0)) <= kTolerance)) return false;  // NaN is no rotation either
    }
  }
  return determinant(m) > 0;
}

}  // namespace lakshya
