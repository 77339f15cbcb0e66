#include "hal/camera/eye_check.h"

namespace lakshya {

void EyeCheck::open(bool wanted) {
  wanted_ = wanted;
  swapped_ = false;
  again();
  if (wanted && !finder_) finder_ = std::make_unique<EyeOrderFinder>();
}

void EyeCheck::look(ImageView<const std::uint8_t> left, ImageView<const std::uint8_t> right, const char* place,
                    Problem& problem) {
  if (looks_left_ == 0) return;
  --looks_left_;
  const EyeVotes votes = finder_->look(left, right);
  if (votes.order == EyeOrder::unsure) {
    ++counters_.unsure.value;
    problem.set("%s: which eye is the left one cannot be told (votes %d : %d); %s", place, votes.left_first,
                votes.right_first, swapped_ ? "as it was before" : "as the settings say");
    return;
  }
  looks_left_ = 0;
  swapped_ = votes.order == EyeOrder::right_first;
  if (!swapped_) return;
  ++counters_.corrected.value;
  problem.set("%s: left and right are swapped (votes %d : %d), corrected; change the setting", place,
              votes.left_first, votes.right_first);
}

}  // namespace lakshya
