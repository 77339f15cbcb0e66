// OceanServer OS5000 compasses (OS5000-S, -US, -T and relatives) on a serial port. The device corrects for tilt and for iron
// near it by itself (its own calibration, command C of the user's guide) and sends sentences at a rate of its own.
//
// Commands are ESC, a letter, a decimal number and an end; the device needs time between characters: 100 ms are kept. The
// guide ends a number with a space, published drivers with a carriage return: a setting. Two commands are sent at the start:
// R, sentences per second, and X, what they contain: 7 = 1 heading + 2 pitch + 4 roll. The form of sentence is left as it is
// stored in the device; all that hal/compass/os5000_sentence.h lists are understood. The device keeps what it was told.
//
// Where the guide is silent: pitch is taken to be positive nose up, roll positive right side down, as in north-east-down axes;
// pitch_sign and roll_sign turn that round.
#pragma once

#include <array>

#include "hal/clock.h"
#include "hal/compass.h"
#include "hal/compass/os5000_sentence.h"
#include "hal/retry.h"
#include "hal/serial_port.h"

namespace lakshya {

struct Os5000Settings {
  bool set_up = true;                    // false: send no command, rate and content stay as stored in the device
  bool commands_end_with_space = false;  // else with a carriage return
  int rate_hz = 10;                      // 1 to 40 sentences a second; with set_up false, the least that is stored
  int baud = 19200;            // the port's, 1200 to 230400: how long a byte takes; 19200 is the factory's
  double declination_deg = 0;  // -180 to 180, true less magnetic north, east positive; 0 if the device has its own
  double mounting_deg = 0;     // -180 to 180, the device's forward axis from the vehicle's, left positive
  int pitch_sign = 1;          // 1 or -1
  int roll_sign = 1;           // 1 or -1
};

class Os5000 final : public Compass {
 public:
  // `port` (8 data bits, no parity, 1 stop bit) and `clock` outlive the compass. The port is opened and closed from here.
  Os5000(const Os5000Settings& settings, SerialPort& port, Clock& clock);
  ~Os5000() override;
  Os5000(const Os5000&) = delete;
  Os5000& operator=(const Os5000&) = delete;

  // Sends the commands, which takes 0.8 or 0.9 s (8 or 9 characters), then waits for a sentence for at most 1 s and two
  // periods. timeout: none came, or the port takes no bytes; bad_data: only damaged ones came, or ones without heading; what
  // SerialPort::open() says.
  Status open() override;
  void close() override;
  std::span<const Counter> counters() const override { return counters_; }

  // bad_data: until `deadline` only damaged sentences came. The time is when the sentence's first byte began to be sent, if
  // the bytes that one read of the port gives came one close after the other; what the device does before that (its filter)
  // is not known. A sentence that waited in the port is stamped as if it had come just now, too late by at most one period, or
  // by the time since the call before where that is less. Time never steps back.
  //
  // After more than 1 s without a call what waits in the port is forgotten, because nobody knows how old it is: the call then
  // waits for a new sentence, and is a timeout where none comes before `deadline`.
  //
  // A port that has gone is looked for again by the next calls, every 200 ms; the commands are then sent while sentences come
  // in already.
  Status read(Nanoseconds deadline, HeadingSample& sample) override;

 private:
  Status check_settings();
  void write_commands();
  void begin();
  Status send_next(Nanoseconds deadline);
  Status send_all();
  Status receive(Nanoseconds deadline);
  void take(std::span<const std::uint8_t> bytes, Nanoseconds arrival);
  void take_line(std::string_view line);
  bool look_again(Nanoseconds deadline);
  Status lose();

  const Os5000Settings settings_;
  SerialPort* port_;
  Clock* clock_;
  bool is_open_ = false;
  Nanoseconds listened_ = 0;  // when the last call ended

  std::array<char, 16> commands_{};
  std::size_t commands_size_ = 0;
  std::size_t sent_ = 0;
  Nanoseconds next_character_ = 0;
  Retry retry_;

  std::array<std::uint8_t, 256> buffer_{};
  NmeaLines lines_;
  Nanoseconds line_time_ = 0;
  HeadingSample newest_;
  bool has_newest_ = false;  // in this call
  bool has_damage_ = false;  // in this call

  // A line that was cut or is too long is a bad sentence.
  Counter counters_[4] = {{"bad_checksums"}, {"bad_sentences"}, {"timeouts"}, {"disconnections"}};
};

}  // namespace lakshya
