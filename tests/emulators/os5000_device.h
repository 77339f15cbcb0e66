// An OceanServer OS5000 compass on its line, written from the user's guide: sentences at a rate, from a heading that may turn,
// and the commands ESC R (rate) and ESC X (content). Its line is as slow as a real one, and it is deaf to characters that come
// too fast.
#pragma once

#include <deque>

#include "tests/emulators/line.h"

namespace lakshya::emulator {

class Os5000Device final : public LineDevice {
 public:
  enum class Format { tagged, by_place, true_heading };  // $C, $OHPR, $HCHDT

  // Knobs, to be turned at any time.
  double heading_deg = 0;  // at the first call of say(), clockwise from north, as the device writes it
  double turn_dps = 0;     // degrees per second, clockwise
  double pitch_deg = 0;
  double roll_deg = 0;
  double temperature_c = 25;
  Format format = Format::tagged;
  int baud = 19200;
  int deaf_ms = 50;              // a character that comes sooner after the one before is lost
  int wrong_checksum_every = 0;  // every so many sentences; 0 never
  int garbage_every = 0;         // bytes that mean nothing before every so many sentences
  bool split = false;            // the line pauses in the middle of a sentence, for a third of the period
  bool merge = false;            // two sentences leave at once, as a converter to USB may hand them over
  bool silent = false;

  // What it was told last. 0 is silence, -n one sentence every n seconds.
  int rate_hz = 8;
  int fields = 1 + 2 + 4 + 8;  // heading, pitch, roll, temperature

  int commands_obeyed = 0;
  int characters_lost = 0;

  void hear(std::string_view bytes, std::int64_t now_ns) override;
  std::string say(std::int64_t now_ns) override;

  double heading_at(std::int64_t now_ns) const;

 private:
  struct Byte {
    std::int64_t time_ns;
    char value;
  };

  void hear_character(char c, std::int64_t now_ns);
  void obey();
  std::int64_t period_ns() const;
  std::string sentence(std::int64_t now_ns);
  void send(const std::string& text, std::int64_t now_ns);

  bool runs_ = false;
  std::int64_t start_ns_ = 0;
  std::int64_t next_ns_ = 0;
  std::int64_t line_free_ns_ = 0;
  std::int64_t last_heard_ns_ = 0;
  int said_ = 0;
  std::string held_;
  std::deque<Byte> line_;
  enum class Hears { nothing, letter, number } hears_ = Hears::nothing;
  char letter_ = 0;
  std::string number_;
};

}  // namespace lakshya::emulator
