// The fourth thread's work: control's newest command to the drives, their travel back. A serial line takes longer than a turn of
// the control loop for both (hal/servo/quicksilver.h has the figures); control does not wait for it.
#pragma once

#include "app/loop/messages.h"
#include "hal/clock.h"
#include "hal/servo.h"

namespace lakshya {

class Driving {
 public:
  // All of them outlive it; the servo is open.
  Driving(Servo& servo, Clock& clock, Exchange& exchange) : servo_(&servo), clock_(&clock), exchange_(&exchange) {}

  // One exchange with the drives: the newest command, or the last one again, which keeps drives from stopping by themselves; then
  // their travel, unless a command has come meanwhile that must not wait. Tells control how it went.
  void step();

 private:
  void command();
  void read_travel();

  Servo* servo_;
  Clock* clock_;
  Exchange* exchange_;
  DriveNote note_;
};

}  // namespace lakshya
