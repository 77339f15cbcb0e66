#include "kernels/slope/slope.h"

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <functional>
#include <optional>

#include "kernels/base/units.h"
#include "kernels/slope/slope_bins.h"

namespace lakshya {
namespace {

bool floor_is_matched(const PruneModel& m, int u, int v) {
  const std::int64_t floor = m.floor.at(u, v);
  return floor > m.min_disparity && floor <= m.max_floor_disparity;
}

struct Place {
  std::int64_t forward_mm = 0;
  std::int64_t left_mm = 0;
  std::int64_t height_mm = 0;
  std::int64_t noise_mm = 0;  // of the height
};

Place place_of(const PruneModel& m, const SlopeBox& box, int residual16) {
  const int u = (box.left + box.right) / 2;
  const int v = (box.top + box.bottom) / 2;
  const auto d16 =
      static_cast<std::int16_t>(std::max<std::int64_t>(slope_sixteenths(m.floor.at(u, v)) + residual16, 1));
  const ObstaclePoint p = reproject_pixel(m, u, v, d16);
  return {p.forward_mm, p.left_mm, p.height_mm, std::int64_t{m.height_mm} * kSlopeNoise / d16};
}

bool can_drive(const SlopeParams& params, const Place& from, const Place& to) {
  const std::int64_t way = std::max<std::int64_t>(to.forward_mm - from.forward_mm, 0);
  const std::int64_t rise = std::abs(to.height_mm - from.height_mm) - from.noise_mm - to.noise_mm;
  return rise * 100 <= way * params.steepest_percent;
}

// Whether ground is too high or too low beside other ground for a drivable slope between them.
bool is_step(const SlopeParams& params, const Place& here, const Place& beside) {
  const std::int64_t way = std::abs(beside.left_mm - here.left_mm);
  const std::int64_t step = std::abs(beside.height_mm - here.height_mm) - std::max(here.noise_mm, beside.noise_mm);
  return step * 100 > way * params.steepest_percent;
}

// One strip's ground, from bin to bin.
class Walk {
 public:
  Walk(const PruneModel& model, const SlopeParams& params, SlopeStrip& slope)
      : model_(&model), params_(&params), slope_(&slope) {
    slope = {};
    at_.fill(-1);
  }

  bool goes_on() const { return goes_on_; }
  bool begins_on_plane() const {
    return walked_ >= kSlopeStartBins && std::abs(places_[0].height_mm) <= params_->tolerance_mm;
  }

  // Of the ground in a bin; null: it was not found there.
  const Place* place(int bin) const {
    const int at = at_[static_cast<std::size_t>(bin)];
    return at < 0 ? nullptr : &places_[static_cast<std::size_t>(at)];
  }

  // Where the ground is higher or lower than the plane, and the next strip's is not as high or low, it has a side.
  void find_sides(const Walk& beside) {
    for (int bin = slope_->first; bin < slope_->end; ++bin) {
      const Place* const here = place(bin);
      const Place* const there = beside.place(bin);
      if (here == nullptr || there == nullptr || std::abs(here->height_mm) <= params_->tolerance_mm) continue;
      if (!is_step(*params_, *here, *there)) continue;
      slope_->edge[static_cast<std::size_t>(bin)] = true;
      slope_->fall[static_cast<std::size_t>(bin)] =
          slope_->fall[static_cast<std::size_t>(bin)] || is_fall(*here, *there);
    }
  }

  void step(int bin, const SlopeBox& box, std::optional<int> residual) {
    const std::optional<Place> place = residual ? std::optional(place_of(*model_, box, *residual)) : std::nullopt;
    if (place && place->forward_mm > params_->reach_mm) {
      stop(true);
    } else if (place && fits(*place)) {
      take(bin, *residual, *place);
    } else if (walked_ == 0 || ++left_out_ > kSlopeLeftOut) {
      ends_low_ = walked_ > 0 && place && place->height_mm < before(1).height_mm;
      falls_ = ends_low_ && is_fall(before(1), *place);
      stop(!place && walked_ > 0 && before(1).forward_mm > params_->drop_reach_mm);
    }
  }

  void end(bool followed) {
    if (walked_ > 0) {
      slope_->forward_mm = static_cast<std::int32_t>(before(1).forward_mm);
      slope_->height_mm = static_cast<std::int32_t>(before(1).height_mm);
    }
    const bool believed = walked_ >= kSlopeStartBins && (followed || comes_from_floor());
    if (!leaves_plane_ || !believed) slope_->first = slope_->end = 0;
    if (!ends_low_) return;
    for (int bin = slope_->first; bin < slope_->end; ++bin) {
      const Place* const here = place(bin);
      if (here == nullptr || before(1).forward_mm - here->forward_mm > kSlopeEdgeMm) continue;
      slope_->edge[static_cast<std::size_t>(bin)] = true;
      slope_->fall[static_cast<std::size_t>(bin)] = falls_;
    }
  }

 private:
  const Place& before(int n) const { return places_[static_cast<std::size_t>(walked_ - n)]; }

  bool is_fall(const Place& here, const Place& there) const {
    const std::int64_t fall = here.height_mm - there.height_mm - std::max(here.noise_mm, there.noise_mm);
    return fall > kSlopeFallMm && here.forward_mm <= params_->drop_reach_mm;
  }

  bool fits(const Place& place) const {
    for (const int n : {1, 2, 4}) {
      if (walked_ >= n && !can_drive(*params_, before(n), place)) return false;
    }
    return true;
  }

  void take(int bin, int residual, const Place& place) {
    places_[static_cast<std::size_t>(walked_)] = place;
    if (walked_ == 0) slope_->end = slope_->first = bin + 1;
    const int last = walked_ == 0 ? residual : slope_->residual16[static_cast<std::size_t>(slope_->first)];
    for (int b = bin; b < slope_->first; ++b)
      slope_->residual16[static_cast<std::size_t>(b)] =
          static_cast<std::int16_t>(b == bin ? residual : (residual + last) / 2);
    slope_->first = bin;
    at_[static_cast<std::size_t>(bin)] = static_cast<std::int8_t>(walked_);
    ++walked_;
    left_out_ = 0;
    leaves_plane_ = leaves_plane_ || std::abs(place.height_mm) > params_->tolerance_mm;
  }

  void stop(bool ground_goes_on) {
    goes_on_ = false;
    slope_->goes_on = ground_goes_on;
  }

  // Whether ground that begins away from the mount's plane comes from it: seen back, it meets the plane before it is below the vehicle.
  // The lowest bins may show the edge of a kerb below.
  bool comes_from_floor() const {
    if (std::abs(places_[0].height_mm) <= params_->tolerance_mm) return true;
    if (walked_ < kSlopeEdgeBins + kSlopeStartBins) return false;
    const Place& first = places_[kSlopeEdgeBins];
    const Place& later = places_[static_cast<std::size_t>(std::min(walked_ - 1, kSlopeEdgeBins + kSlopeRunBins))];
    const std::int64_t height = std::abs(first.height_mm);
    const std::int64_t rise = (first.height_mm > 0 ? 1 : -1) * (later.height_mm - first.height_mm);
    return (height - params_->tolerance_mm) * (later.forward_mm - first.forward_mm) <= rise * first.forward_mm;
  }

  const PruneModel* model_;
  const SlopeParams* params_;
  SlopeStrip* slope_;
  std::array<Place, kSlopeBins> places_{};
  std::array<std::int8_t, kSlopeBins> at_{};  // which of them is a bin's
  int walked_ = 0;
  int left_out_ = 0;
  bool goes_on_ = true;
  bool ends_low_ = false;  // lower ground follows, too steeply
  bool falls_ = false;     // ... and as high as a side is that is not driven over
  bool leaves_plane_ = false;
};

}  // namespace

Status find_slopes(const PruneModel& model, const SlopeParams& params, ImageView<const std::int16_t> disparity,
                   Slopes& slopes) {
  const bool followed =
      std::count_if(slopes.begin(), slopes.end(), std::mem_fn(&SlopeStrip::found)) >= kSlopeFollowed;
  slopes = {};
  if (!has_slope_boxes(disparity)) return Status::size_mismatch;
  if (params.steepest_percent <= 0) return Status::ok;
  std::array<std::optional<Walk>, kSlopeStrips> walks;
  for (std::size_t i = 0; i < walks.size(); ++i)
    walks[i].emplace(model, params, slopes[i]);
  bool begun = false;
  bool any = true;
  for (int bin = kSlopeBins - 1; bin >= 0 && any; --bin) {
    const SlopeBox middle = slope_box(disparity, kSlopeStrips / 2, bin);
    if (!floor_is_matched(model, middle.left, middle.bottom - 1)) {
      if (begun) break;
      continue;  // too near to be matched
    }
    begun = true;
    const SlopeHistograms strips = slope_histograms(model, disparity, bin);
    any = false;
    for (int s = 0; s < kSlopeStrips; ++s) {
      Walk& walk = *walks[static_cast<std::size_t>(s)];
      if (walk.goes_on()) walk.step(bin, slope_box(disparity, s, bin), slope_residual(strips, s));
      any = any || walk.goes_on();
    }
  }
  const bool on_plane = std::ranges::any_of(walks, [](const auto& walk) { return walk->begins_on_plane(); });
  for (std::optional<Walk>& walk : walks)
    walk->end(followed && !on_plane);
  for (std::size_t s = 0; s + 1 < walks.size(); ++s) {
    walks[s]->find_sides(*walks[s + 1]);
    walks[s + 1]->find_sides(*walks[s]);
  }
  return Status::ok;
}

}  // namespace lakshya
