#include "app/tools/disparity_estimate.h"

#include <algorithm>
#include <sstream>

#include "app/core/arena.h"
#include "app/core/input_error.h"
#include "app/core/matcher.h"
#include "hal/clock/monotonic_clock.h"

namespace lakshya {

DisparityEstimate match_pair(const MatcherConfig& config, const KernelTable& kernels,
                             const Image<std::uint8_t>& left, const Image<std::uint8_t>& right) {
  constexpr double kNoDoffs = 0;  // between the images themselves
  Arena measure;
  (void)Matcher(config, kNoDoffs, left.width(), left.height(), kernels, measure);
  Arena arena(measure.used());
  Matcher matcher(config, kNoDoffs, left.width(), left.height(), kernels, arena);

  const MonotonicClock clock;
  const Nanoseconds start = clock.now();
  ImageView<const std::int16_t> found;
  const Status status = matcher.match(left.view(), right.view(), found);
  const Nanoseconds took = clock.now() - start;
  if (status != Status::ok) {
    throw InputError("matcher " + config.name, std::string("cannot match these images: ") + to_string(status));
  }
  DisparityEstimate estimate{Image<std::int16_t>(left.width(), left.height()), static_cast<double>(took) * 1e-6};
  for (int v = 0; v < found.height; ++v)
    std::copy_n(found.row(v), found.width, estimate.disparity.view().row(v));
  return estimate;
}

std::string parameters_text(const MatcherConfig& c) {
  const auto square = [](int radius) {
    const std::string side = std::to_string(2 * radius + 1);
    return side + "x" + side;
  };
  const bool sgm = c.name == "sgm";
  std::ostringstream out;
  if (c.name == "sad") {
    out << "absolute differences of " << (c.edge == "log" ? "Laplacian-of-Gaussian" : "x-Sobel") << " edges, cap "
        << c.edge_cap;
  } else {
    out << "census 9x7 centre-symmetric (" << kCensusBits << " bits)";
  }
  if (sgm) {
    out << ", " << c.paths << " paths, cost over 3x3, P1 " << c.p1 << ", P2 " << c.p2 << " - " << c.p2_slope
        << " |dI| >= " << c.p2_min;
  } else {
    out << ", window " << square(c.window_radius_px);
  }
  out << ", uniqueness " << (sgm ? c.uniqueness_percent : c.window_uniqueness_percent) << " %, left-right "
      << c.left_right_max_px << " px, texture " << c.texture_threshold << ", support "
      << (sgm ? c.support_min_percent : c.window_support_min_percent) << " % of " << square(c.support_radius_px);
  return out.str();
}

}  // namespace lakshya
