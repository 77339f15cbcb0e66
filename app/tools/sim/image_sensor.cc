#include "app/tools/sim/image_sensor.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "app/core/input_error.h"
#include "app/core/over_bands.h"
#include "app/tools/sim/hash.h"

namespace lakshya::sim {
namespace {

constexpr int kBandRows = 16;
constexpr double kSignalAtHalf = 0.36;  // radiance 0.5 at exposure 1 is 0.18 of saturation: middle grey
constexpr int kGreySteps = 4096;
constexpr int kMeterStep = 4;  // every fourth pixel of every fourth row is metered

void require(bool ok, const char* what) {
  if (!ok) throw InputError("image sensor", std::string(what) + " is outside its range (image_sensor.h)");
}

// Quantiles of the normal distribution, by Newton's method on its integral.
const std::array<float, 4096>& normal_quantiles() {
  static const std::array<float, 4096> table = [] {
    std::array<float, 4096> t{};
    double x = -3.7;
    for (std::size_t i = 0; i < t.size(); ++i) {
      const double p = (static_cast<double>(i) + 0.5) / static_cast<double>(t.size());
      for (int round = 0; round < 12; ++round) {
        const double error = 0.5 * std::erfc(-x * 0.7071067811865476) - p;
        const double density = std::exp(-x * x / 2) * 0.3989422804014327;
        x -= std::clamp(error / density, -0.3, 0.3);
      }
      t[i] = static_cast<float>(x);
    }
    return t;
  }();
  return table;
}

template <class Work>
void for_rows(int height, const Work& work) {
  static_cast<void>(over_bands((height + kBandRows - 1) / kBandRows, [&](int band) {
    for (int v = band * kBandRows; v < std::min(height, (band + 1) * kBandRows); ++v)
      work(v);
    return Status::ok;
  }));
}

// Five taps of a Gauss curve; what five cannot hold (sigma above 1) is little.
std::array<float, 3> lens_taps(double sigma) {
  if (sigma < 0.05) return {1, 0, 0};
  const double a = std::exp(-0.5 / (sigma * sigma));
  const double b = std::exp(-2 / (sigma * sigma));
  const double sum = 1 + 2 * a + 2 * b;
  return {static_cast<float>(1 / sum), static_cast<float>(a / sum), static_cast<float>(b / sum)};
}

// Mean over `length` px about every pixel; the border repeats.
void box_row(const float* in, int width, double length, std::vector<double>& sums, float* out) {
  const auto n = static_cast<std::size_t>(width);
  sums.resize(n + 1);
  for (std::size_t i = 0; i < n; ++i)
    sums[i + 1] = sums[i] + static_cast<double>(in[i]);
  const auto integral = [&](double x) {  // of the row from its left edge to x
    if (x <= 0) return x * static_cast<double>(in[0]);
    if (x >= width) return sums[n] + (x - width) * static_cast<double>(in[n - 1]);
    const auto i = static_cast<std::size_t>(x);
    return sums[i] + (x - static_cast<double>(i)) * static_cast<double>(in[i]);
  };
  for (int u = 0; u < width; ++u)
    out[u] = static_cast<float>((integral(u + 0.5 + length / 2) - integral(u + 0.5 - length / 2)) / length);
}

}  // namespace

std::optional<SunInPicture> sun_in_picture(const CameraPose& pose, const Eigen::Vector3d& to_sun,
                                           double irradiance) {
  constexpr double kLeastCosine = 0.25;  // beyond 75 degrees a hood keeps it away
  const Eigen::Vector3d way = pose.world_from_camera.transpose() * to_sun.normalized();
  if (!(irradiance > 0) || way.z() < kLeastCosine) return std::nullopt;
  return SunInPicture{irradiance, way.x() / way.z(), way.y() / way.z()};
}

ImageSensor::ImageSensor(const ImageSensorSettings& settings, const RayTable& left, const RayTable& right)
    : settings_(settings),
      tables_{&left, &right},
      veiled_(left.width(), left.height()),
      blurred_(left.width(), left.height()) {
  const ImageSensorSettings& s = settings;
  require(s.lens_sigma_px >= 0 && s.lens_sigma_px <= 1.5, "lens_sigma_px");
  require(s.vignetting >= 0 && s.vignetting <= 0.9, "vignetting");
  require(s.gamma > 0 && s.gamma <= 4, "gamma");
  require(s.target_grey >= 1 && s.target_grey <= 254, "target_grey");
  require(s.exposure_step >= 0, "exposure_step");
  require(s.ms_at_one > 0 && s.shortest_ms > 0 && s.longest_ms >= s.shortest_ms, "exposure time");
  require(s.largest_gain >= 1, "largest_gain");
  require(s.noise_grey >= 0 && s.read_noise_share >= 0 && s.read_noise_share <= 1, "noise");
  require(left.width() == right.width() && left.height() == right.height(), "size of the right eye");
  target_signal_ = std::pow(s.target_grey / 255, s.gamma);
  // The curve's slope there takes noise of the signal to noise in grey levels.
  const double slope = 255 / s.gamma * std::pow(target_signal_, 1 / s.gamma - 1);
  const double variance = std::pow(s.noise_grey / slope, 2);
  shot_ = (1 - s.read_noise_share) * variance / target_signal_;
  read_ = std::sqrt(s.read_noise_share * variance);
  grey_.resize(kGreySteps + 1);
  for (std::size_t i = 0; i < grey_.size(); ++i) {
    const double root = static_cast<double>(i) / kGreySteps;
    grey_[i] = static_cast<std::uint8_t>(std::lround(255 * std::pow(root, 2 / s.gamma)));
  }
}

double ImageSensor::exposure_ms() const {
  return std::min(used_ * settings_.ms_at_one, settings_.longest_ms);
}

double ImageSensor::gain() const {
  return used_ > 0 ? std::max(1.0, used_ * settings_.ms_at_one / settings_.longest_ms) : 1;
}

double ImageSensor::metered(ImageView<const float> left, ImageView<const float> right, double exposure) const {
  double sum = 0;
  int count = 0;
  const auto factor = static_cast<float>(exposure * kSignalAtHalf);
  for (const auto& image : {left, right}) {
    for (int v = kMeterStep / 2; v < image.height; v += kMeterStep) {
      for (int u = kMeterStep / 2; u < image.width; u += kMeterStep, ++count)
        sum += static_cast<double>(std::min(1.0F, factor * image.at(u, v)));
    }
  }
  return count > 0 ? std::max(sum / count, 1e-9) : target_signal_;
}

void ImageSensor::adapt(ImageView<const float> left, ImageView<const float> right, bool at_once) {
  const double low = settings_.shortest_ms / settings_.ms_at_one;
  const double high = settings_.longest_ms * settings_.largest_gain / settings_.ms_at_one;
  if (at_once) {
    exposure_ = std::clamp(1.0, low, high);
    for (int round = 0; round < 12; ++round)  // saturated pixels make it a search
      exposure_ = std::clamp(exposure_ * target_signal_ / metered(left, right, exposure_), low, high);
    return;
  }
  const double most = 1 + settings_.exposure_step;
  const double wanted = target_signal_ / metered(left, right, exposure_);
  exposure_ = std::clamp(exposure_ * std::clamp(wanted, 1 / most, most), low, high);
}

void ImageSensor::expose(ImageView<const float> left_radiance, ImageView<const float> right_radiance,
                         const SensorFrame& frame, ImageView<std::uint8_t> left, ImageView<std::uint8_t> right) {
  if (exposure_ <= 0) adapt(left_radiance, right_radiance, true);
  used_ = exposure_;
  eye(left_radiance, *tables_[0], frame.sun_left, false, frame, left);
  eye(right_radiance, *tables_[1], frame.sun_right, true, frame, right);
  adapt(left_radiance, right_radiance, false);
}

void ImageSensor::eye(ImageView<const float> radiance, const RayTable& table,
                      const std::optional<SunInPicture>& sun, bool right, const SensorFrame& frame,
                      ImageView<std::uint8_t> out) {
  if (sun && settings_.veil > 0) {
    add_veil(table, *sun, radiance, veiled_.view());
    radiance = veiled_.view();
  }
  blur(radiance, blurred_.view(), std::abs(frame.yaw_rate) * exposure_ms() * 1e-3 * settings_.focal_px);
  const double side = right ? -0.5 : 0.5;
  const double factor = used_ * kSignalAtHalf * (1 + side * settings_.gain_difference);
  const auto low = [](std::uint64_t x) { return static_cast<std::uint32_t>(x); };
  const std::uint32_t key = hash_of(hash_of(low(settings_.seed), low(settings_.seed >> 32)), low(frame.number),
                                    low(frame.number >> 32) * 2 + (right ? 1 : 0));
  develop(blurred_.view(), static_cast<float>(factor), key, out);
}

// Light scattered in a lens falls with the square of the angle from its source (CIE's glare formula has the same power).
void ImageSensor::add_veil(const RayTable& table, const SunInPicture& sun, ImageView<const float> in,
                           ImageView<float> out) const {
  constexpr float kScattered = 0.004F;
  constexpr float kCore = 0.0006F;  // rad^2
  const auto strength = static_cast<float>(settings_.veil * sun.irradiance) * kScattered;
  const auto sx = static_cast<float>(sun.x);
  const auto sy = static_cast<float>(sun.y);
  for_rows(in.height, [&](int v) {
    const std::ptrdiff_t first = static_cast<std::ptrdiff_t>(v) * table.width();
    for (int u = 0; u < in.width; ++u) {
      const float x = table.x()[first + u] - sx;
      const float y = table.y()[first + u] - sy;
      out.at(u, v) = in.at(u, v) + strength / (x * x + y * y + kCore);
    }
  });
}

void ImageSensor::blur(ImageView<const float> in, ImageView<float> out, double motion_px) const {
  constexpr double kLeastMotion = 0.3;  // px
  const auto [centre, near, far] = lens_taps(settings_.lens_sigma_px);
  const auto weights = std::array<float, 3>{centre, near, far};
  const auto padded = [&](int v, std::vector<float>& row) {  // the column sums of row v, two more on either side
    const auto r = [&](int i) { return in.row(std::clamp(i, 0, in.height - 1)); };
    const float* const p[5] = {r(v - 2), r(v - 1), r(v), r(v + 1), r(v + 2)};
    for (int u = 0; u < in.width; ++u) {
      row[static_cast<std::size_t>(u) + 2] =
          weights[0] * p[2][u] + weights[1] * (p[1][u] + p[3][u]) + weights[2] * (p[0][u] + p[4][u]);
    }
    const std::size_t end = row.size();
    row[0] = row[1] = row[2];
    row[end - 1] = row[end - 2] = row[end - 3];
  };
  static_cast<void>(over_bands((in.height + kBandRows - 1) / kBandRows, [&](int band) {
    std::vector<float> row(static_cast<std::size_t>(in.width) + 4);
    std::vector<float> sharp(static_cast<std::size_t>(in.width));
    std::vector<double> sums;
    for (int v = band * kBandRows; v < std::min(in.height, (band + 1) * kBandRows); ++v) {
      padded(v, row);
      float* const to = motion_px > kLeastMotion ? sharp.data() : out.row(v);
      const float* const p = row.data();
      for (int u = 0; u < in.width; ++u)
        to[u] = weights[0] * p[u + 2] + weights[1] * (p[u + 1] + p[u + 3]) + weights[2] * (p[u] + p[u + 4]);
      if (motion_px > kLeastMotion) box_row(sharp.data(), in.width, motion_px, sums, out.row(v));
    }
    return Status::ok;
  }));
}

void ImageSensor::develop(ImageView<const float> in, float factor, std::uint32_t key,
                          ImageView<std::uint8_t> out) const {
  const std::array<float, 4096>& normal = normal_quantiles();
  const auto shot = static_cast<float>(gain() * shot_);
  const auto read = static_cast<float>(std::pow(gain() * read_, 2));
  const float middle_u = 0.5F * static_cast<float>(in.width - 1);
  const float middle_v = 0.5F * static_cast<float>(in.height - 1);
  const float lost =
      static_cast<float>(settings_.vignetting) / std::max(1.0F, middle_u * middle_u + middle_v * middle_v);
  for_rows(in.height, [&](int v) {
    const float* const from = in.row(v);
    std::uint8_t* const to = out.row(v);
    const float dv = static_cast<float>(v) - middle_v;
    const std::uint32_t row_key = mixed(key + static_cast<std::uint32_t>(v) * 0x9E3779B9U);
    for (int u = 0; u < in.width; ++u) {
      const float du = static_cast<float>(u) - middle_u;
      const float signal = factor * from[u] * (1 - lost * (du * du + dv * dv));
      const std::uint32_t chance = mixed(row_key + static_cast<std::uint32_t>(u)) >> 20;
      // A full pixel takes no more light: noise there stays below the clamp.
      const float lit = std::min(signal, 4.0F) + normal[chance] * std::sqrt(shot * std::min(signal, 1.0F) + read);
      const float root = std::sqrt(std::clamp(lit, 0.0F, 1.0F));
      to[u] = grey_[static_cast<std::size_t>(root * kGreySteps + 0.5F)];
    }
  });
}

}  // namespace lakshya::sim
