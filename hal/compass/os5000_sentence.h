// What an OceanServer OS5000 compass says: lines of text between '$' and the end of the line, with a checksum.
//
//   $C320.5P0.2R-18.3T19.0*3C              by tag: a letter, or a capital and a small one, and its number
//   $OHPR,320.5,0.2,-18.3,19.0,1.5,...*hh  by place: heading, pitch, roll, temperature, depth
//   $HCHDT,320.5,T*hh                      NMEA 0183: heading from true north
//
// Source: OS5000 series user's guide, output sentence formats 1, 2 and 4. Its format 8 has no name to be recognised by and is
// not read.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string_view>

#include "kernels/base/status.h"

namespace lakshya {

// As the device wrote it; NaN is what the sentence did not say.
struct Os5000Sentence {
  static constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

  double heading_deg = kNone;  // 0..360, clockwise from north
  bool heading_is_true =
      false;  // from true north; else from magnetic north (unless the device was given a declination)
  double pitch_deg = kNone;      // -90..90
  double roll_deg = kNone;       // -180..180
  double temperature_c = kNone;  // of the board
  double depth = kNone;          // of models with a pressure sensor; the device's settings choose the unit
  std::array<double, 3> field_mg = {kNone, kNone, kNone};        // magnetic field, milligauss, the device's axes
  std::array<double, 3> acceleration_g = {kNone, kNone, kNone};  // in g, the device's axes
};

// `content` is what lies between '$' and '*' of a line without its end. bad_data: no such form, or the two hexadecimal digits
// after '*' are not the exclusive or of the content's bytes.
Status nmea_content(std::string_view line, std::string_view& content);

// bad_data: unknown, torn, a tag twice, no heading, or an angle outside its range; `sentence` is then not to be used. Tags that
// are not listed above are read and forgotten (a firmware may have more).
Status parse_os5000(std::string_view content, Os5000Sentence& sentence);

// Cuts a stream of bytes into lines, in fixed memory. What comes before a '$' is skipped; a '$' begins anew wherever it stands.
class NmeaLines {
 public:
  // The longest line of the device, with every tag, has some 140 characters.
  static constexpr std::size_t kLongest = 192;

  // True when this byte ended a line; line() holds it, without its end, until the next call.
  bool push(std::uint8_t byte);
  std::string_view line() const { return {text_.data(), size_}; }

  // Lines that were begun and given up: too long, or cut by the next '$'.
  std::uint64_t given_up() const { return given_up_; }

  // Forgets a line that was begun.
  void clear() { state_ = State::skipping; }

 private:
  enum class State : std::uint8_t { skipping, reading, complete };

  State state_ = State::skipping;
  std::size_t size_ = 0;
  std::uint64_t given_up_ = 0;
  std::array<char, kLongest> text_{};
};

}  // namespace lakshya
