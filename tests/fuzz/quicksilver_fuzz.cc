#include <cstdlib>

#include "hal/servo/quicksilver_protocol.h"
#include "tests/fuzz/fuzz.h"

namespace lakshya::fuzz {
namespace {

using quicksilver::LineCollector;
using quicksilver::Reply;

void require(bool holds) {
  if (!holds) std::abort();
}

std::vector<std::string> lines_of(LineCollector& collector, Bytes bytes) {
  std::vector<std::string> lines;
  while (collector.take(bytes))
    lines.emplace_back(collector.line());
  require(bytes.empty());
  return lines;
}

void check(const std::string& line) {
  Reply reply;
  if (quicksilver::parse_reply(line, reply) != Status::ok) return;
  require(reply.address >= 0 && reply.address <= 255);
  require(reply.command >= 0 && reply.command <= 65535 && reply.nak_code >= 0 && reply.nak_code <= 65535);
  if (reply.kind == Reply::Kind::data) require(reply.word_count >= 1 && reply.word_count <= reply.words.size());
  std::int32_t value = 0;
  if (quicksilver::register_value(reply, value) == Status::ok) require(reply.word_count == 2);
  // What follows a reply on its line makes it none.
  require(quicksilver::parse_reply(line + "x", reply) != Status::ok);
}

}  // namespace

// The first byte says where the rest is cut in two.
void read(Bytes bytes) {
  if (bytes.empty()) return;
  const Bytes stream = bytes.subspan(1);
  const std::size_t cut = stream.empty() ? 0 : bytes[0] % stream.size();

  LineCollector whole;
  const std::vector<std::string> lines = lines_of(whole, stream);
  LineCollector pieces;
  std::vector<std::string> from_pieces = lines_of(pieces, stream.first(cut));
  const std::vector<std::string> second = lines_of(pieces, stream.subspan(cut));
  from_pieces.insert(from_pieces.end(), second.begin(), second.end());
  require(from_pieces == lines);

  for (const std::string& line : lines) {
    require(line.size() <= LineCollector::kLongest);
    check(line);
  }
}

std::vector<std::string> seeds() {
  return {"\x05* 10\r# 10 000C 0005 06A3\r", "\x01! 11 000F 0002\r", "\x02# 10 0000 2000\r* 11 \r", "\x09zz* 10\r"};
}

}  // namespace lakshya::fuzz
