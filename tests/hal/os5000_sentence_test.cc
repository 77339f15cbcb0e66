#include "hal/compass/os5000_sentence.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

namespace lakshya {
namespace {

// Both steps, as the driver takes them.
Status read_line(const std::string& line, Os5000Sentence& sentence) {
  std::string_view content;
  const Status status = nmea_content(line, content);
  return status == Status::ok ? parse_os5000(content, sentence) : status;
}

Status parse(const std::string& content) {
  Os5000Sentence sentence;
  return parse_os5000(content, sentence);
}

std::vector<std::string> lines_of(NmeaLines& lines, const std::string& bytes) {
  std::vector<std::string> found;
  for (const char c : bytes) {
    if (lines.push(static_cast<std::uint8_t>(c))) found.emplace_back(lines.line());
  }
  return found;
}

// The two sentences and their checksums are examples of the user's guide.
TEST(Os5000Sentence, ReadsTheGuidesShortExample) {
  Os5000Sentence s;
  ASSERT_EQ(read_line("$C320.5P0.2R-18.3T19.0*3C", s), Status::ok);
  EXPECT_EQ(s.heading_deg, 320.5);
  EXPECT_FALSE(s.heading_is_true);
  EXPECT_EQ(s.pitch_deg, 0.2);
  EXPECT_EQ(s.roll_deg, -18.3);
  EXPECT_EQ(s.temperature_c, 19.0);
  EXPECT_TRUE(std::isnan(s.depth));
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_TRUE(std::isnan(s.field_mg[i]));
    EXPECT_TRUE(std::isnan(s.acceleration_g[i]));
  }
}

TEST(Os5000Sentence, ReadsTheGuidesLongExample) {
  Os5000Sentence s;
  ASSERT_EQ(read_line("$C212.4P2.5R-14.0T28.4Mx107977.90My-79422.00Mz173.27Ax0.045Ay-0.245Az0.977*3A", s),
            Status::ok);
  EXPECT_EQ(s.heading_deg, 212.4);
  EXPECT_EQ(s.field_mg, (std::array<double, 3>{107977.90, -79422.00, 173.27}));
  EXPECT_EQ(s.acceleration_g, (std::array<double, 3>{0.045, -0.245, 0.977}));
}

TEST(Os5000Sentence, TagsComeInAnyOrderAndUnknownOnesAreForgotten) {
  Os5000Sentence s;
  ASSERT_EQ(parse_os5000("R-1.5M271.53D21.01Gx-3C0.0A0.998P2", s), Status::ok);
  EXPECT_EQ(s.heading_deg, 0.0);
  EXPECT_EQ(s.pitch_deg, 2.0);
  EXPECT_EQ(s.roll_deg, -1.5);
  EXPECT_EQ(s.depth, 21.01);
  EXPECT_TRUE(std::isnan(s.temperature_c));
}

TEST(Os5000Sentence, ReadsValuesByPlace) {
  Os5000Sentence s;
  ASSERT_EQ(read_line("$OHPR,320.5,0.2,-18.3,19.0,1.5,0,0,0*36", s), Status::ok);
  EXPECT_EQ(s.heading_deg, 320.5);
  EXPECT_FALSE(s.heading_is_true);
  EXPECT_EQ(s.pitch_deg, 0.2);
  EXPECT_EQ(s.roll_deg, -18.3);
  EXPECT_EQ(s.temperature_c, 19.0);
  EXPECT_EQ(s.depth, 1.5);
  ASSERT_EQ(parse_os5000("OHPR,7.5,,3", s), Status::ok);
  EXPECT_EQ(s.heading_deg, 7.5);
  EXPECT_TRUE(std::isnan(s.pitch_deg));
  EXPECT_EQ(s.roll_deg, 3.0);
  EXPECT_TRUE(std::isnan(s.temperature_c));
}

TEST(Os5000Sentence, ReadsTrueHeading) {
  Os5000Sentence s;
  ASSERT_EQ(read_line("$HCHDT,320.5,T*2d", s), Status::ok);  // NMEA writes capitals; small digits are read, too
  EXPECT_EQ(s.heading_deg, 320.5);
  EXPECT_TRUE(s.heading_is_true);
  EXPECT_TRUE(std::isnan(s.pitch_deg));
  ASSERT_EQ(parse_os5000("C1.0", s), Status::ok);
  EXPECT_FALSE(s.heading_is_true) << "left over from the sentence before";
}

TEST(Os5000Sentence, EveryWrongByteIsFoundByTheChecksum) {
  const std::string good = "$C320.5P0.2R-18.3T19.0*3C";
  Os5000Sentence s;
  for (std::size_t i = 0; i < good.size(); ++i) {
    for (int bit = 0; bit < 8; ++bit) {
      std::string line = good;
      line[i] = static_cast<char>(line[i] ^ (1 << bit));
      if (i == good.size() - 1 && line[i] == 'c') continue;  // the same digit
      EXPECT_EQ(read_line(line, s), Status::bad_data) << line;
    }
  }
}

TEST(Os5000Sentence, EveryCutOfALineIsRefused) {
  const std::string good = "$C320.5P0.2R-18.3T19.0*3C";
  Os5000Sentence s;
  for (std::size_t size = 0; size < good.size(); ++size) {
    EXPECT_EQ(read_line(good.substr(0, size), s), Status::bad_data) << size;
    EXPECT_EQ(read_line(good.substr(good.size() - size), s), Status::bad_data) << size;
  }
}

TEST(Os5000Sentence, WithoutHeadingItIsNoSentence) {
  EXPECT_EQ(parse("P0.2R-18.3"), Status::bad_data);
  EXPECT_EQ(parse("OHPR,,0.2,-18.3,19.0"), Status::bad_data);
  EXPECT_EQ(parse("OHPR,"), Status::bad_data);
  EXPECT_EQ(parse("HCHDT,,T"), Status::bad_data);
  EXPECT_EQ(parse(""), Status::bad_data);
}

TEST(Os5000Sentence, WhatTheGuideDoesNotSayIsRefused) {
  for (const char* const content :
       {"C",          "C-",       "C.",        "C1.2.3",     "C--1",      "C1e2",  "Cinf",      "Cnan",
        "C0x1",       "C 1",      "C+1",       "c1.0",       "1.0",       "C1.0P", "C1.0,P2",   "C1.0C1.0",
        "C1.0P1P1",   "C1.0Mxx1", "GPGGA,1,2", "OHPR,1.0,x", "OHPR,1.0 ", "OHPR",  "HCHDT,1.0", "HCHDT,1.0,M",
        "HCHDT,1.0T", "C360.1",   "C-0.1",     "C1P90.1",    "C1R-180.1"}) {
    EXPECT_EQ(parse(content), Status::bad_data) << content;
  }
  EXPECT_EQ(parse("C1" + std::string(400, '0')), Status::bad_data);
  EXPECT_EQ(parse("C360.0P-90.0R180.0"), Status::ok);
}

TEST(NmeaLines, SplitAndMergedLinesComeOutWhole) {
  NmeaLines lines;
  EXPECT_EQ(lines_of(lines, "noise\r\n$C1"), std::vector<std::string>{});
  EXPECT_EQ(lines_of(lines, ".0*5\r\n$C2*12\r\n$"), (std::vector<std::string>{"$C1.0*5", "$C2*12"}));
  EXPECT_EQ(lines_of(lines, "C3\n"), std::vector<std::string>{"$C3"});
  EXPECT_EQ(lines.given_up(), 0U);
}

TEST(NmeaLines, ADollarBeginsAnewAndClearForgets) {
  NmeaLines lines;
  EXPECT_EQ(lines_of(lines, "$C1.0P$C2*12\r\n"), std::vector<std::string>{"$C2*12"});
  EXPECT_EQ(lines.given_up(), 1U);
  EXPECT_EQ(lines_of(lines, "$C3"), std::vector<std::string>{});
  lines.clear();
  EXPECT_EQ(lines_of(lines, "*13\r\n$C4\r\n"), std::vector<std::string>{"$C4"});
}

TEST(NmeaLines, WhatIsTooLongIsSkippedToTheNextDollar) {
  NmeaLines lines;
  const std::string longest = "$" + std::string(NmeaLines::kLongest - 1, 'x');
  EXPECT_EQ(lines_of(lines, longest + "\r\n"), std::vector<std::string>{longest});
  EXPECT_EQ(lines_of(lines, longest + "x\r\n"), std::vector<std::string>{});
  EXPECT_EQ(lines.given_up(), 1U);
  EXPECT_EQ(lines_of(lines, longest + "x$C1\r"), std::vector<std::string>{"$C1"});
  EXPECT_EQ(lines.given_up(), 2U);
}

}  // namespace
}  // namespace lakshya
