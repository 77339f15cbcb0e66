// The emergency stop that somebody presses, as this program sees it. It is the second line: what makes a vehicle
// safe is a switch in its drives' power (docs/wiring.md).
#pragma once

#include "hal/device.h"

namespace lakshya {

class EmergencyStop : public Device {
 public:
  // As it is now, with the contact's bounces: latching is the caller's. Does not wait: a control loop calls it 50
  // times a second. A status other than ok says that the input cannot be read, and whoever calls must take it as
  // pressed; `pressed` is true then, for a caller who forgets.
  virtual Status read(bool& pressed) = 0;
};

}  // namespace lakshya
