// A camera's first good pairs decide whether its images are given to the right eyes (eye_order.h).
#pragma once

#include <memory>

#include "hal/camera/eye_order.h"
#include "hal/device.h"

namespace lakshya {

class EyeCheck {
 public:
  struct Counters {
    Counter corrected{"eyes_corrected"};
    Counter unsure{"eyes_unsure"};  // pairs that did not tell
  };

  // Starts anew; takes its memory when `wanted`, else never looks.
  void open(bool wanted);

  // The cameras may have changed places: looks once more, if it was wanted. What was found holds until a pair tells otherwise.
  // Nothing is allocated.
  void again() { looks_left_ = wanted_ ? kMostLooks : 0; }

  // Looks at the pair as the settings assign it, at most at kMostLooks of them and until one tells. Then swapped() says
  // whether it is the other way round; `problem` names what was corrected, or that nothing could be told. A look takes as long
  // as EyeOrderFinder::look() says, and knows no deadline: it comes on top of that of the capture.
  void look(ImageView<const std::uint8_t> left, ImageView<const std::uint8_t> right, const char* place,
            Problem& problem);

  bool swapped() const { return swapped_; }
  const Counters& counters() const { return counters_; }

  static constexpr int kMostLooks = 5;

 private:
  std::unique_ptr<EyeOrderFinder> finder_;
  bool wanted_ = false;
  int looks_left_ = 0;
  bool swapped_ = false;
  Counters counters_;
};

}  // namespace lakshya
