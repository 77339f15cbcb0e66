#include "app/core/file_bytes.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <filesystem>
#include <functional>
#include <iterator>

#include "app/core/input_error.h"
#include "tests/support/temp_folder.h"

namespace lakshya {
namespace {

namespace fs = std::filesystem;
using namespace std::string_literals;

void expect_refusal(const std::function<void()>& action, const std::string& path, const std::string& reason) {
  try {
    action();
    FAIL() << "accepted: " << path;
  } catch (const InputError& e) {
    EXPECT_EQ(std::string(e.what()).find(path + ": file: "), 0U) << e.what();
    EXPECT_NE(std::string(e.what()).find(reason), std::string::npos) << e.what();
  }
}

void expect_read_refusal(const std::string& path, std::size_t max_bytes, const std::string& reason) {
  expect_refusal([&] { read_file(path, max_bytes); }, path, reason);
  expect_refusal([&] { read_text(path, max_bytes); }, path, reason);
}

TEST(FileBytes, ReadsEveryByteAsItIs) {
  const TempFolder folder;
  const std::string path = folder.write("bytes", "a\0\r\n\xff"s);
  EXPECT_EQ(read_file(path, 5), (std::vector<std::uint8_t>{'a', 0, '\r', '\n', 0xff}));
  EXPECT_EQ(read_text(path, 5), "a\0\r\n\xff"s);
}

TEST(FileBytes, RefusesWhatIsNotAFullRegularFile) {
  const TempFolder folder;
  expect_read_refusal(folder.path("none"), 9, "does not exist");
  expect_read_refusal(folder.path("none/below"), 9, "does not exist");
  expect_read_refusal(folder.path(""), 9, "is a directory");
  expect_read_refusal(folder.write("empty", ""s), 9, "is empty");
  expect_read_refusal(folder.write("long", "0123456789"s), 9, "has 10 bytes, more than the 9");
  expect_read_refusal(folder.write("file", "x"s) + "/below", 9, "does not exist");
}

TEST(FileBytes, RefusesPipesWithoutWaitingForThem) {
  const TempFolder folder;
  const std::string path = folder.path("pipe");
  ASSERT_EQ(mkfifo(path.c_str(), 0600), 0);
  expect_read_refusal(path, 9, "not a regular file");
}

TEST(FileBytes, RefusesAFileThatMayNotBeRead) {
  const TempFolder folder;
  const std::string path = folder.write("secret", "x"s);
  fs::permissions(path, fs::perms::none);
  if (std::ifstream(path).good()) GTEST_SKIP() << "this user may read every file";
  expect_read_refusal(path, 9, "cannot be opened");
}

TEST(FileBytes, SizeIsJudgedBeforeMemoryIsTaken) {
  const TempFolder folder;
  const std::string path = folder.write("sparse", "x"s);
  std::error_code error;
  fs::resize_file(path, std::uintmax_t{1} << 40, error);
  if (error) GTEST_SKIP() << "no sparse file of 1 TiB here: " << error.message();
  expect_read_refusal(path, 1000, "more than the 1000");
}

TEST(FileBytes, WritesAndReplaces) {
  const TempFolder folder;
  const std::string path = folder.path("out");
  for (const std::string& content : {"first, long"s, "\0\n"s, ""s}) {
    write_file_atomically(path, content);
    std::ifstream in(path, std::ios::binary);
    EXPECT_EQ(std::string(std::istreambuf_iterator<char>(in), {}), content);
    EXPECT_FALSE(fs::exists(path + ".part"));
  }
}

TEST(FileBytes, FailedWriteLeavesNothingBehind) {
  const TempFolder folder;
  const std::string below = folder.path("none/out");
  expect_refusal([&] { write_file_atomically(below, "x"); }, below, "cannot be created");

  const std::string taken = folder.path("taken");
  fs::create_directory(taken);
  expect_refusal([&] { write_file_atomically(taken, "x"); }, taken, "cannot be written");
  EXPECT_FALSE(fs::exists(taken + ".part"));
}

TEST(FileBytes, FullDiskKeepsTheOldFile) {
  if (!fs::exists("/dev/full")) GTEST_SKIP() << "no /dev/full to stand for a full disk";
  const TempFolder folder;
  const std::string path = folder.write("out", "old"s);
  fs::create_symlink("/dev/full", path + ".part");
  expect_refusal([&] { write_file_atomically(path, "new"); }, path, "cannot be written");
  EXPECT_EQ(read_text(path, 9), "old");
  EXPECT_FALSE(fs::exists(fs::symlink_status(path + ".part")));
}

}  // namespace
}  // namespace lakshya
