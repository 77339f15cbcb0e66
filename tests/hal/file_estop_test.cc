#include "hal/estop/file_estop.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "tests/support/count_allocations.h"
#include "tests/support/faulty_system.h"
#include "tests/support/temp_folder.h"

namespace lakshya {
namespace {

class FileEstopTest : public testing::Test {
 protected:
  void write(const std::string& text) { (void)folder_.write("estop", text); }

  TempFolder folder_;
  FaultySystem system_;
  FileEstop estop_{{.path = folder_.path("estop")}, system_};
  bool pressed_ = false;
};

TEST_F(FileEstopTest, ItsFirstByteSaysWhetherItIsPressed) {
  write("0\n");
  ASSERT_EQ(estop_.open(), Status::ok) << estop_.problem();
  pressed_ = true;
  EXPECT_EQ(estop_.read(pressed_), Status::ok);
  EXPECT_FALSE(pressed_);
  write("1");
  EXPECT_EQ(estop_.read(pressed_), Status::ok);
  EXPECT_TRUE(pressed_);
  EXPECT_EQ(system_.open_files(), 0U);
}

TEST_F(FileEstopTest, OneThatIsPressedAtTheStartOpens) {
  write("1\n");
  EXPECT_EQ(estop_.open(), Status::ok) << estop_.problem();
}

TEST_F(FileEstopTest, AFileThatReplacesItCounts) {
  write("0");
  ASSERT_EQ(estop_.open(), Status::ok);
  std::filesystem::rename(folder_.write("new", std::string("1")), folder_.path("estop"));
  EXPECT_EQ(estop_.read(pressed_), Status::ok);
  EXPECT_TRUE(pressed_);
}

TEST_F(FileEstopTest, WhatCannotBeReadIsPressed) {
  write("0");
  ASSERT_EQ(estop_.open(), Status::ok);
  for (const std::string text : {"", "\n", "2", "off", " 0"}) {
    write(text);
    pressed_ = false;
    EXPECT_EQ(estop_.read(pressed_), Status::bad_data) << '"' << text << '"';
    EXPECT_TRUE(pressed_) << '"' << text << '"';
  }
  EXPECT_NE(std::string(estop_.problem()).find("estop: begins with neither"), std::string::npos)
      << estop_.problem();
  std::filesystem::remove(folder_.path("estop"));
  pressed_ = false;
  EXPECT_EQ(estop_.read(pressed_), Status::disconnected);
  EXPECT_TRUE(pressed_);
  EXPECT_NE(std::string(estop_.problem()).find("No such file"), std::string::npos) << estop_.problem();
  std::filesystem::create_directory(folder_.path("estop"));
  EXPECT_EQ(estop_.read(pressed_), Status::disconnected);
  EXPECT_EQ(estop_.counters()[0].value, 5U);
  EXPECT_EQ(estop_.counters()[1].value, 2U);
  EXPECT_EQ(system_.open_files(), 0U);
}

TEST_F(FileEstopTest, AFileThatComesBackIsReadAgain) {
  write("0");
  ASSERT_EQ(estop_.open(), Status::ok);
  system_.unplugged = true;
  EXPECT_EQ(estop_.read(pressed_), Status::disconnected);
  system_.unplugged = false;
  EXPECT_EQ(estop_.read(pressed_), Status::ok);
  EXPECT_FALSE(pressed_);
}

TEST_F(FileEstopTest, NothingIsAllocatedOnceItIsOpen) {
  write("0");
  FileEstop estop({.path = folder_.path("estop")});
  ASSERT_EQ(estop.open(), Status::ok);
  test::allocations = 0;
  EXPECT_EQ(estop.read(pressed_), Status::ok);
  EXPECT_EQ(test::allocations, 0);
  std::filesystem::remove(folder_.path("estop"));
  test::allocations = 0;
  EXPECT_EQ(estop.read(pressed_), Status::disconnected);
  EXPECT_EQ(test::allocations, 0);
}

TEST_F(FileEstopTest, OneThatIsNotOpenIsPressed) {
  EXPECT_EQ(estop_.read(pressed_), Status::disconnected);
  EXPECT_TRUE(pressed_);
  EXPECT_EQ(estop_.open(), Status::disconnected);  // no file
  write("x");
  EXPECT_EQ(estop_.open(), Status::bad_data);
  write("0");
  EXPECT_EQ(estop_.read(pressed_), Status::disconnected);
  EXPECT_EQ(estop_.open(), Status::ok);
  estop_.close();
  estop_.close();
  EXPECT_EQ(estop_.read(pressed_), Status::disconnected);
  FileEstop nowhere({.path = {}}, system_);
  EXPECT_EQ(nowhere.open(), Status::bad_argument);
}

}  // namespace
}  // namespace lakshya
