// An emergency stop switch on a line of a GPIO chip.
//
// The wiring to choose: a switch that opens when it is pressed (normally closed), between the line and ground, and
// a resistor from the line to the supply (pull-up). Released, the switch holds the line low; pressed, with a wire
// cut or a plug pulled, the resistor draws it high: pressed is high, `active_low` is false. A switch that closes
// when it is pressed needs `active_low`, and nothing tells its cut wire from a switch that nobody presses. What
// the first does not see is the line's wire touching ground.
#pragma once

#include "hal/estop.h"
#include "hal/estop/gpio_line.h"

namespace lakshya {

struct GpioEstopSettings {
  std::string chip = "gpiochip0";  // or its label, or a path
  int line = -1;                   // offset on that chip, from 0
  bool active_low = false;         // the line is low when the switch is pressed
  // Asks for the chip's own resistor. It is weak, and some chips have none and do not say so: long wires want one
  // of their own, of some kiloohms.
  bool pull_up = true;
};

// A line that cannot be read stays taken and is tried again by every read(), but the chip is not looked for again:
// requesting a line allocates, and a chip that goes away under way is a fault that wants open() and somebody who
// looks at it.
class GpioEstop final : public EmergencyStop {
 public:
  // `line` outlives it.
  GpioEstop(GpioEstopSettings settings, GpioLine& line);
  ~GpioEstop() override;
  GpioEstop(const GpioEstop&) = delete;
  GpioEstop& operator=(const GpioEstop&) = delete;

  // Takes the line and reads it once. disconnected: no such chip, or no permission; bad_argument: no such line;
  // refused: somebody else has the line; unsupported: built without libgpiod.
  Status open() override;
  void close() override;
  // disconnections (readings without an answer)
  std::span<const Counter> counters() const override { return counters_; }

  Status read(bool& pressed) override;

 private:
  const GpioEstopSettings settings_;
  GpioLine* line_;
  bool is_open_ = false;
  Counter counters_[1] = {{"disconnections"}};
};

}  // namespace lakshya
