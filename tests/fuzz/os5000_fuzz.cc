#include <cmath>
#include <cstdlib>
#include <string>

#include "app/core/input_error.h"
#include "hal/compass/os5000_sentence.h"
#include "tests/fuzz/fuzz.h"

namespace lakshya::fuzz {
namespace {

void require(bool holds) {
  if (!holds) std::abort();
}

bool is_within(double value, double low, double high) {
  return std::isnan(value) || (value >= low && value <= high);
}

// An accepted sentence has a heading, and every angle is one.
bool accepts(std::string_view content) {
  const std::string own(content);  // of its exact size, so that reading past its end is seen
  Os5000Sentence s;
  if (parse_os5000(own, s) != Status::ok) return false;
  require(s.heading_deg >= 0 && s.heading_deg <= 360);
  require(is_within(s.pitch_deg, -90, 90) && is_within(s.roll_deg, -180, 180));
  for (const double value : {s.temperature_c, s.depth, s.field_mg[0], s.acceleration_g[2]})
    require(!std::isinf(value));
  return true;
}

// All lines, with a mark after each.
std::string lines_of(NmeaLines& lines, Bytes bytes) {
  std::string all;
  for (const std::uint8_t byte : bytes) {
    if (!lines.push(byte)) continue;
    require(lines.line().size() <= NmeaLines::kLongest && lines.line().front() == '$');
    all.append(lines.line()).push_back('\n');
  }
  return all;
}

// A line reaches the parser although its checksum is wrong: it would stop nearly everything.
bool accepts_line(const std::string& line) {
  std::string_view content;
  if (nmea_content(line, content) == Status::ok) return accepts(content);
  return accepts(std::string_view(line).substr(1, line.rfind('*') - 1));
}

}  // namespace

void read(Bytes bytes) {
  NmeaLines whole;
  const std::string lines = lines_of(whole, bytes);
  NmeaLines pieces;
  const std::size_t cut = bytes.empty() ? 0 : bytes[0] % bytes.size();
  std::string in_two = lines_of(pieces, bytes.first(cut));
  in_two += lines_of(pieces, bytes.subspan(cut));
  require(lines == in_two && whole.given_up() == pieces.given_up());

  bool accepted = accepts(text_of(bytes));
  for (std::size_t begin = 0; begin < lines.size();) {
    const std::size_t end = lines.find('\n', begin);
    accepted = accepts_line(lines.substr(begin, end - begin)) || accepted;
    begin = end + 1;
  }
  if (!accepted) throw InputError("fuzz", "no sentence with a heading");
}

std::vector<std::string> seeds() {
  return {"$C320.5P0.2R-18.3T19.0*3C\r\n",
          "$C212.4P2.5R-14.0T28.4Mx107977.90My-79422.00Mz173.27Ax0.045Ay-0.245Az0.977*3A\r\n",
          "$OHPR,320.5,0.2,-18.3,19.0,1.5,0,0,0*36\r\n",
          "$HCHDT,320.5,T*2D\r\n",
          "\x1bR10\r$C32$C320.5*69\r\n",
          "C1.0P2.0D3.0"};
}

}  // namespace lakshya::fuzz
