#include "hal/servo/quicksilver_protocol.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace lakshya::quicksilver {
namespace {

std::string text_of(const CommandText& command) {
  return {command.bytes().begin(), command.bytes().end()};
}

std::span<const std::uint8_t> bytes_of(const std::string& text) {
  return {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()};
}

constexpr std::int32_t kLowest = std::numeric_limits<std::int32_t>::min();

TEST(QuickSilverProtocol, CommandsAreDecimal) {
  EXPECT_EQ(text_of({16, Command::read_register, {1}}), "@16 12 1\r");
  EXPECT_EQ(text_of({17, Command::write_register, {30, -107374182}}), "@17 11 30 -107374182\r");
  EXPECT_EQ(text_of({16, Command::velocity, {38655, 107374182, 0, 0}}), "@16 15 38655 107374182 0 0\r");
  EXPECT_EQ(text_of({16, Command::stop, {0}}), "@16 3 0\r");
  EXPECT_EQ(text_of({16, Command::halt, {}}), "@16 2\r");
  EXPECT_EQ(text_of({254, Command::velocity, {kLowest, kLowest, kLowest, kLowest}}),
            "@254 15 -2147483648 -2147483648 -2147483648 -2147483648\r");
}

TEST(QuickSilverProtocol, RepliesAreHexadecimal) {
  Reply reply;
  ASSERT_EQ(parse_reply("* 10", reply), Status::ok);
  EXPECT_EQ(reply.kind, Reply::Kind::done);
  EXPECT_EQ(reply.address, 16);

  // The maker's example: position 329379 of drive 16.
  ASSERT_EQ(parse_reply("# 10 000C 0005 06A3", reply), Status::ok);
  EXPECT_EQ(reply.kind, Reply::Kind::data);
  EXPECT_EQ(reply.address, 16);
  EXPECT_EQ(reply.command, 12);
  std::int32_t value = 0;
  ASSERT_EQ(register_value(reply, value), Status::ok);
  EXPECT_EQ(value, 329379);

  ASSERT_EQ(parse_reply("# fe c ffff fffe  ", reply), Status::ok);
  EXPECT_EQ(reply.address, 254);
  ASSERT_EQ(register_value(reply, value), Status::ok);
  EXPECT_EQ(value, -2);
  ASSERT_EQ(parse_reply("# 10 000C 8000 0000", reply), Status::ok);
  ASSERT_EQ(register_value(reply, value), Status::ok);
  EXPECT_EQ(value, kLowest);

  ASSERT_EQ(parse_reply("!  11 000F 000A", reply), Status::ok);
  EXPECT_EQ(reply.kind, Reply::Kind::nak);
  EXPECT_EQ(reply.address, 17);
  EXPECT_EQ(reply.command, 15);
  EXPECT_EQ(reply.nak_code, 10);
}

TEST(QuickSilverProtocol, DamagedRepliesAreRefused) {
  Reply reply;
  for (const char* line : {"",
                           "*",
                           "* ",
                           "*10",
                           " * 10",
                           "* 1G",
                           "* 10 0",
                           "* 100",
                           "* -1",
                           "* +1",
                           "* 0x1",
                           "10",
                           "@16 12 1",
                           "#",
                           "# 10",
                           "# 10 000C",
                           "# 10 000C 0005 06A3 ?",
                           "# 10 000C 00005",
                           "# 10 000C 0005\n06A3",
                           "# 10 000C 0005 06A3\n",
                           "# 10 00C0C 0005",
                           "# 10 1 1 2 3 4 5 6 7 8 9",
                           "!",
                           "! 10",
                           "! 10 000C",
                           "! 10 000C 0002 0",
                           "! 10 000C 2x",
                           "?* 10",
                           "* 10* 10"}) {
    EXPECT_EQ(parse_reply(line, reply), Status::bad_data) << line;
  }
  EXPECT_EQ(parse_reply(std::string_view("* 1\0", 4), reply), Status::bad_data);
  EXPECT_EQ(parse_reply("# 10 1 1 2 3 4 5 6 7 8", reply), Status::ok);
  EXPECT_EQ(reply.word_count, 8U);
}

TEST(QuickSilverProtocol, OnlyTwoWordsAreARegister) {
  std::int32_t value = 7;
  for (const char* line : {"* 10", "! 10 000C 0002", "# 10 000C 0005", "# 10 000C 0005 0006 0007"}) {
    Reply reply;
    ASSERT_EQ(parse_reply(line, reply), Status::ok) << line;
    EXPECT_EQ(register_value(reply, value), Status::bad_data) << line;
  }
  EXPECT_EQ(value, 7);
}

TEST(QuickSilverProtocol, NaksHaveNames) {
  EXPECT_STREQ(nak_name(1), "bad command");
  EXPECT_STREQ(nak_name(2), "busy");
  EXPECT_STREQ(nak_name(5), "bad format");
  EXPECT_STREQ(nak_name(6), "buffer full");
  EXPECT_STREQ(nak_name(7), "bad address");
  EXPECT_STREQ(nak_name(8), "bad response packet request");
  EXPECT_STREQ(nak_name(9), "locked out");
  EXPECT_STREQ(nak_name(10), "bad checksum");
  EXPECT_STREQ(nak_name(3), "unknown");
}

std::vector<std::string> lines_in(LineCollector& collector, const std::string& text) {
  std::vector<std::string> lines;
  auto rest = bytes_of(text);
  while (collector.take(rest))
    lines.emplace_back(collector.line());
  return lines;
}

TEST(QuickSilverProtocol, LinesAreCutAtCarriageReturnsWhereverThePiecesEnd) {
  using Lines = std::vector<std::string>;
  LineCollector collector;
  EXPECT_EQ(lines_in(collector, "* 10\r# 1"), Lines{"* 10"});
  EXPECT_EQ(lines_in(collector, ""), Lines{});
  EXPECT_EQ(lines_in(collector, "1 0\r\r! x"), (Lines{"# 11 0", ""}));
  collector.clear();
  EXPECT_EQ(lines_in(collector, "* 11\r"), Lines{"* 11"});
}

TEST(QuickSilverProtocol, ALineThatIsTooLongIsThrownAwayAndTheNextOneIsNot) {
  using Lines = std::vector<std::string>;
  LineCollector collector;
  const std::string longest(LineCollector::kLongest, 'x');
  EXPECT_EQ(lines_in(collector, longest + "\r"), Lines{longest});
  EXPECT_EQ(lines_in(collector, longest + "x"), Lines{});
  EXPECT_EQ(lines_in(collector, "y\r* 10\r"), (Lines{"", "* 10"}));
}

TEST(QuickSilverProtocol, UnitsAreTheMakers) {
  std::int32_t units = 0;
  ASSERT_EQ(velocity_units(200, units), Status::ok);
  EXPECT_EQ(units, 107374182);  // 200 x 536870.912
  ASSERT_EQ(velocity_units(-1, units), Status::ok);
  EXPECT_EQ(units, -536871);
  ASSERT_EQ(velocity_units(3999.999999, units), Status::ok);
  ASSERT_EQ(acceleration_units(10, units), Status::ok);
  EXPECT_EQ(units, 38655);
}

TEST(QuickSilverProtocol, WhatDoesNotFitIntoUnitsIsRefused) {
  std::int32_t units = 7;
  for (const double rpm : {4000.0, -4000.0, 1e300, std::nan(""), std::numeric_limits<double>::infinity()})
    EXPECT_EQ(velocity_units(rpm, units), Status::bad_argument) << rpm;
  for (const double acceleration : {0.0, -1.0, 1e-4, 277778.0, std::nan("")})
    EXPECT_EQ(acceleration_units(acceleration, units), Status::bad_argument) << acceleration;
  EXPECT_EQ(units, 7);
}

TEST(QuickSilverProtocol, DistancesAreRightAcrossTheWrap) {
  constexpr std::int32_t kHighest = std::numeric_limits<std::int32_t>::max();
  EXPECT_EQ(counts_between(5, 12), 7);
  EXPECT_EQ(counts_between(kHighest - 1, kLowest + 2), 4);
  EXPECT_EQ(counts_between(kLowest, kHighest), -1);
}

}  // namespace
}  // namespace lakshya::quicksilver
