// The boards as they are in the repository, and boards with something wrong in them, through packaging/board.py.
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <string>

#include "tests/support/run_command.h"
#include "tests/support/temp_folder.h"

namespace lakshya {
namespace {

class BoardsTest : public testing::Test {
 protected:
  void SetUp() override {
    const char* root = std::getenv("LAKSHYA_ROOT");
    if (root == nullptr) GTEST_SKIP() << "LAKSHYA_ROOT is not set: no boards to look at";
    root_ = root;
  }
  Outcome board(const std::vector<std::string>& arguments) const {
    std::vector<std::string> words{"python3", root_ + "/packaging/board.py"};
    words.insert(words.end(), arguments.begin(), arguments.end());
    return run_command(words);
  }
  std::string file_of(const std::string& name) const { return bytes_of(root_ + "/boards/" + name + "/board.yaml"); }

  // What is said about a board of this content; it must be refused.
  std::string refused(const std::string& content) const {
    const TempFolder folder;
    std::ofstream(folder.path("board.yaml")) << content;
    const Outcome outcome = board({"check", folder.path("board.yaml")});
    EXPECT_EQ(outcome.exit_code, 1) << outcome.out << outcome.err;
    EXPECT_EQ(outcome.out, "");
    const std::size_t at = outcome.err.find("board.yaml");
    return at == std::string::npos ? outcome.err : outcome.err.substr(at);
  }
  std::string refused(const std::string& name, const std::string& from, const std::string& to) const {
    std::string content = file_of(name);
    const std::size_t at = content.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    return refused(content.replace(at, from.size(), to));
  }

  std::string root_;
};

TEST_F(BoardsTest, EveryBoardIsAsItShouldBe) {
  const Outcome all = board({"check"});
  EXPECT_EQ(all.exit_code, 0) << all.err;
  for (const char* name : {"qemu-arm64", "uefi-x86_64", "rpi4", "rockpi4", "rpi3-32", "jetson-orin", "rk3588"})
    EXPECT_NE(all.out.find(std::string(name) + ": "), std::string::npos) << name;
}

TEST_F(BoardsTest, GivesOneSettingAListAsLines) {
  EXPECT_EQ(board({"get", "rpi4", "triplet"}).out, "aarch64-linux-gnu\n");
  EXPECT_EQ(board({"get", "rpi4", "boot.device_tree"}).out, "broadcom/bcm2711-rpi-4-b.dtb\n");
  EXPECT_EQ(board({"get", "uefi-x86_64", "boot.device_tree"}).out, "\n");
  EXPECT_NE(board({"get", "qemu-arm64", "kernel.modules"}).out.find("ext4\ncrc32c_generic\n"), std::string::npos);
  EXPECT_EQ(board({"get", "rpi4", "nothing.such"}).exit_code, 2);
}

TEST_F(BoardsTest, ABoardThatIsNotThere) {
  const Outcome outcome = board({"check", "rpi9"});
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_NE(outcome.err.find("rpi9"), std::string::npos) << outcome.err;
  EXPECT_NE(outcome.err.find("qemu-arm64"), std::string::npos) << "the boards that there are: " << outcome.err;
}

TEST_F(BoardsTest, RefusesWithLineKeyAndReason) {
  EXPECT_EQ(refused("rpi4", "architecture: arm64", "architecture: riscv64"),
            "board.yaml:4: architecture: 'riscv64' is unknown (known: amd64, arm64, armhf)\n");
  EXPECT_EQ(refused("rpi4", "seconds: 10", "seconds: 600"),
            "board.yaml:25: watchdog.seconds: 600 is not a whole number from 1 to 60\n");
  EXPECT_EQ(refused("rpi4", "pwm_bcm2835", "pwm-bcm2835"),
            "board.yaml:13: kernel.modules: 'pwm-bcm2835' is not a kernel module's name (with _, not -)\n");
  EXPECT_EQ(refused("rpi4", "  loader:", "  lader:").substr(0, 40), "board.yaml:15: boot.lader: unknown key (");
  EXPECT_EQ(refused("rpi4", "  table: mbr ", "  table: mbr\n  table: gpt "),
            "board.yaml:21: image.table: given twice (remove one)\n");
  EXPECT_EQ(refused("rpi4", "deliver: image\n", ""),
            "board.yaml: deliver: missing (docs/boards.md says what it is)\n");
  EXPECT_EQ(refused("rpi4", "  module: bcm2835_wdt\n", ""),
            "board.yaml: watchdog.module: missing (docs/boards.md says what it is)\n");
  EXPECT_EQ(refused("rpi3-32", "-mcpu=cortex-a53 ", "").substr(0, 36), "board.yaml:6: cpu.flags: no -mcpu (3");
}

TEST_F(BoardsTest, RefusesWhatIsNoBoardAtAll) {
  EXPECT_EQ(refused("").substr(0, 34), "board.yaml: the file: empty (board");
  EXPECT_EQ(refused("- a\n- b\n").substr(0, 34), "board.yaml:1: the file: not a map ");
  EXPECT_EQ(refused("title: [\n").substr(0, 27), "board.yaml:2: broken YAML: ");
}

// Before anything is downloaded or written.
TEST_F(BoardsTest, ImagesThatCannotBeBuiltAreRefused) {
  const auto refused_image = [&](std::vector<std::string> words) {
    words.insert(words.begin(), root_ + "/packaging/image/build.py");
    words.insert(words.end(), {"--firmware-program", "none", "--sysroot", "none"});
    const Outcome outcome = run_command(words);
    EXPECT_EQ(outcome.exit_code, 1) << outcome.err;
    return outcome.err;
  };
  EXPECT_EQ(refused_image({"rpi4"}).substr(0, 38), "image: rpi4: boot.loader raspberry-pi:");
  EXPECT_NE(refused_image({"rpi9"}).find("boards/rpi9/board.yaml"), std::string::npos);
  EXPECT_EQ(refused_image({"qemu-arm64", "--update-key", "/none.sec"}).substr(0, 43),
            "image: --update-key: /none.sec: not there (");
  EXPECT_EQ(refused_image({"qemu-arm64", "--overlay", "/none"}), "image: --overlay: /none: no folder\n");
  EXPECT_EQ(refused_image({"qemu-arm64", "--version", "new"}),
            "image: --version: new is not numbers with dots between\n");
}

TEST_F(BoardsTest, WhatMustNotBeOverwrittenIsNot) {
  const TempFolder folder;
  std::ofstream(folder.path("lakshya-1-toy.img.zst")) << "";
  std::ofstream(folder.path("lakshya-1-toy.bmap"))
      << "<bmap><ImageSize>4096</ImageSize><BlockSize>4096</BlockSize><BlockMap><Range "
         "chksum='x'>0</Range></BlockMap></bmap>";
  const auto refused_disk = [&](std::vector<std::string> words) {
    words.insert(words.begin(), {root_ + "/packaging/image/flash.py", "toy", "--images", folder.path("")});
    const Outcome outcome = run_command(words);
    EXPECT_EQ(outcome.exit_code, 1) << outcome.err;
    return outcome.err;
  };
  EXPECT_EQ(refused_disk({"/dev/no-such-disk"}), "flash: /dev/no-such-disk: no such device (lsblk lists them)\n");
  EXPECT_EQ(refused_disk({"/dev/null", "--yes"}), "flash: /dev/null: neither a disk nor a file\n");
  std::ofstream(folder.path("mine")) << "precious";
  EXPECT_NE(
      refused_disk({folder.path("mine"), "--yes", "--inject", folder.path("none.yaml")}).find("none.yaml: no file"),
      std::string::npos);
  EXPECT_EQ(bytes_of(folder.path("mine")), "precious");
}

}  // namespace
}  // namespace lakshya
