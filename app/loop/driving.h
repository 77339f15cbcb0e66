// The fourth thread's work: control's newest command to the drives, their travel back. A serial line takes longer than a turn of
// the control loop for both (hal/servo/quicksilver.h has the figures); control does not wait for it.
#pragma once

#include <limits>

#include "app/loop/messages.h"
#include "hal/clock.h"
#include "hal/servo.h"

namespace lakshya {

class Driving {
 public:
  // All of them outlive it; the servo is open.
  Driving(Servo& servo, Clock& clock, Exchange& exchange) : servo_(&servo), clock_(&clock), exchange_(&exchange) {}

  // One exchange with the drives: the newest command, or the last one again, which keeps drives from stopping by themselves; then
  // their travel, unless a command has come meanwhile that must not wait. Tells control how it went. None of it takes longer than
  // until `limit`: on the virtual clock the next control turn, which in threads waits for nobody either.
  void step(Nanoseconds limit = std::numeric_limits<Nanoseconds>::max());

 private:
  void command(Nanoseconds limit);
  void read_travel(Nanoseconds limit);

  Servo* servo_;
  Clock* clock_;
  Exchange* exchange_;
  DriveNote note_;
};

}  // namespace lakshya
