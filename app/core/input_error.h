// What a reader throws when it refuses its input. Start-up and host tools only: nothing in the frame loop throws.
#pragma once

#include <stdexcept>
#include <string>

namespace lakshya {

// Message: "WHERE: WHAT: WHY (what to do)", for example
// "calib.yaml: K1: focal length -700 is not positive (calibrate again or fix the sign)".
class InputError : public std::runtime_error {
 public:
  InputError(const std::string& where, const std::string& what_and_why)
      : std::runtime_error(where + ": " + what_and_why) {}
};

}  // namespace lakshya
