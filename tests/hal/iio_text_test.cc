#include "hal/compass/iio_text.h"

#include <gtest/gtest.h>

#include <string>

namespace lakshya {
namespace {

TEST(IioText, Numbers) {
  double value = 0;
  ASSERT_EQ(parse_iio_number("-123\n", value), Status::ok);
  EXPECT_EQ(value, -123);
  ASSERT_EQ(parse_iio_number("0.000149536", value), Status::ok);
  EXPECT_EQ(value, 0.000149536);
  for (const char* const text : {"", "\n", "-", "12x", "1 2", "nan", "inf", "1e999", "0x10", "+1"})
    EXPECT_EQ(parse_iio_number(text, value), Status::bad_data) << text;
}

TEST(IioText, Matrices) {
  Matrix3 m{};
  ASSERT_EQ(parse_iio_matrix("0, 1, 0; -1, 0, 0.5; 0, 0, 1\n", m), Status::ok);
  EXPECT_EQ(m, (Matrix3{0, 1, 0, -1, 0, 0.5, 0, 0, 1}));
  for (const char* const text : {"", "1", "1, 0, 0; 0, 1, 0; 0, 0", "1, 0, 0; 0, 1, 0; 0, 0, 1, 0",
                                 "1, 0, 0, 0, 1, 0, 0, 0, 1", "1; 0; 0; 0; 1; 0; 0; 0; 1",
                                 "1, 0, 0; 0, x, 0; 0, 0, 1", "1, 0, 0; 0, 1, 0; 0, 0, 1;", ", , ; , , ; , , "}) {
    EXPECT_EQ(parse_iio_matrix(text, m), Status::bad_data) << text;
  }
}

TEST(IioText, Trimmed) {
  EXPECT_EQ(without_blanks(" hmc5883\n"), "hmc5883");
  EXPECT_EQ(without_blanks("a b"), "a b");
  EXPECT_EQ(without_blanks(" \r\n"), "");
  EXPECT_EQ(without_blanks(""), "");
}

}  // namespace
}  // namespace lakshya
