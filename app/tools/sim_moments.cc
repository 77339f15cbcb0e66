#include "app/tools/sim_moments.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "app/nav/sectors.h"
#include "app/tools/picture_canvas.h"
#include "app/tools/sim_film_picture.h"

namespace lakshya {
namespace {

constexpr std::size_t kMostSpread = 16;
constexpr std::size_t kMostSamples = 100'000;  // an hour and more
constexpr double kSettled = 2;                 // s; before, nothing is a moment of interest but the beginning

std::string decision_text(const PlanNote& plan) {
  return plan.blocked ? "no way open" : "steers " + degrees_text(plan.direction);
}

}  // namespace

SimMoments::Kept SimMoments::keep(const FrameResult& frame, const PlanNote& plan, double time_s,
                                  const char* why) const {
  std::string text = decision_text(plan);
  if (*why != 0) text = std::string(why) + ", " + text;
  return {samples_.size() - 1, {time_s, tinted_picture(frame, has_camera_), std::move(text)}};
}

// When the list is full every second one goes, and only every second comes from then on.
void SimMoments::spread(Kept kept) {
  if (spread_.size() == kMostSpread) {
    for (std::size_t i = 1; 2 * i < spread_.size(); ++i)
      spread_[i] = std::move(spread_[2 * i]);
    spread_.resize(kMostSpread / 2);
    step_ *= 2;
    if (kept.frame % step_ != 0) return;
  }
  spread_.push_back(std::move(kept));
}

void SimMoments::on_frame(const FrameResult& frame, const PlanNote& plan, const sim::Shot& shot) {
  const double time_s = shot.time_s;
  if (samples_.size() >= kMostSamples) return;
  samples_.push_back({time_s, plan.blocked ? 0 : plan.clear_m, plan.nearest_m, plan.blocked, state_});
  const std::size_t number = samples_.size() - 1;
  if (number % step_ == 0) spread(keep(frame, plan, time_s, number == 0 ? "begin" : ""));
  last_ = keep(frame, plan, time_s, "end");
  if (time_s < kSettled) return;
  if (plan.nearest_m >= 0 && (nearest_m_ < 0 || plan.nearest_m < nearest_m_)) {
    nearest_m_ = plan.nearest_m;
    nearest_ = keep(frame, plan, time_s, "nearest obstacle");
  }
  if (plan.blocked && !std::exchange(was_blocked_, true)) blocked_ = keep(frame, plan, time_s, "");
}

DriveRecord SimMoments::record() const {
  DriveRecord record{samples_, {}};
  if (samples_.empty()) return record;
  std::vector<const Kept*> chosen;
  const auto choose = [&](const Kept& kept) {
    const bool is_there =
        std::ranges::any_of(chosen, [&](const Kept* other) { return other->frame == kept.frame; });
    if (!is_there && chosen.size() < kMoments) chosen.push_back(&kept);
  };
  choose(spread_.front());
  choose(last_);
  if (nearest_m_ >= 0) choose(nearest_);
  if (was_blocked_) choose(blocked_);
  // Then always the one that is farthest in time from all that are chosen.
  while (chosen.size() < kMoments) {
    const auto gap = [&](const Kept& kept) {
      double least = HUGE_VAL;
      for (const Kept* other : chosen)
        least = std::min(least, std::abs(other->moment.time_s - kept.moment.time_s));
      return least;
    };
    const auto best = std::ranges::max_element(spread_, {}, gap);
    if (gap(*best) <= 0) break;
    choose(*best);
  }
  std::ranges::sort(chosen, {}, [](const Kept* kept) { return kept->frame; });
  for (const Kept* kept : chosen)
    record.moments.push_back(kept->moment);
  return record;
}

}  // namespace lakshya
