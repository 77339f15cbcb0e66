// The fifth thread's work: headings from the compass to control, which must not wait for a serial line or a bus.
#pragma once

#include "app/loop/messages.h"
#include "hal/clock.h"
#include "hal/compass.h"

namespace lakshya {

class Sensing {
 public:
  // Both outlive it; the compass is open.
  Sensing(Compass& compass, Exchange& exchange) : compass_(&compass), exchange_(&exchange) {}

  // Waits for a heading until `deadline` and hands over what came; nothing is handed over where nothing did.
  Status step(Nanoseconds deadline) {
    HeadingNote note;
    note.status = compass_->read(deadline, note.sample);
    if (note.status != Status::timeout) (void)exchange_->headings.push(note);
    return note.status;
  }

 private:
  Compass* compass_;
  Exchange* exchange_;
};

}  // namespace lakshya
