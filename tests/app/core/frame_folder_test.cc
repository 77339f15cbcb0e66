// Which files are frame n of a recorded sequence, and when it was taken.
#include "app/core/frame_folder.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "tests/support/data_path.h"
#include "tests/support/image_checks.h"
#include "tests/support/temp_folder.h"

namespace lakshya {
namespace {

namespace fs = std::filesystem;
using Names = std::vector<std::string>;

class FrameFolderTest : public ::testing::Test {
 protected:
  std::string path(const std::string& name) const { return folder_.path(name); }

  // Files are never opened here: any bytes do.
  void write(const std::string& folder, const Names& names) const {
    fs::create_directories(path(folder));
    for (const std::string& name : names)
      folder_.write((fs::path(folder) / name).string(), std::string("x"));
  }
  void write_text(const std::string& name, const std::string& text) const {
    fs::create_directories(fs::path(path(name)).parent_path());
    folder_.write(name, text);
  }

  // The left and right names of all frames: "3.png|3.png".
  Names pairs(const FrameFolder& frames) const {
    Names out;
    for (int n = 0; n < frames.count(); ++n)
      out.push_back(name(frames.left(n)) + "|" + name(frames.right(n)));
    return out;
  }
  static std::string name(const std::string& file) { return fs::path(file).filename().string(); }

  FrameFolder sequence(std::optional<CameraNumbers> cameras = {}) const {
    return FrameFolder::open_sequence(path("seq"), cameras);
  }
  // The reason; the refusal must name this file or folder.
  std::string refused(const std::string& where, std::optional<CameraNumbers> cameras = {}) const {
    return refusal(path(where), [&](const std::string&) { sequence(cameras); });
  }
  std::string pair_refused(const std::string& where) const {
    return refusal(path(where), [&](const std::string&) { FrameFolder::open_pair(path("l"), path("r")); });
  }

  TempFolder folder_;
};

TEST_F(FrameFolderTest, PairOfFoldersInNaturalOrder) {
  write("l", {"frame10.png", "frame2.PNG", "frame001.jpg", ".hidden.png", "notes.txt", "x.jpeg"});
  write("r", {"right2.png", "right10.pgm", "right1.ppm", "y.JPG", "Thumbs.db"});
  fs::create_directory(path("l/3.png"));
  const FrameFolder frames = FrameFolder::open_pair(path("l"), path("r"));
  EXPECT_EQ(pairs(frames),
            (Names{"frame001.jpg|right1.ppm", "frame2.PNG|right2.png", "frame10.png|right10.pgm", "x.jpeg|y.JPG"}));
  EXPECT_EQ(frames.left(1), path("l/frame2.PNG"));
  EXPECT_FALSE(frames.timestamp_ns(0).has_value());
  EXPECT_TRUE(frames.skipped().empty());
}

TEST_F(FrameFolderTest, PairRefusals) {
  EXPECT_CONTAINS(pair_refused("l"), "folder: cannot be read: ");
  write("l", {});
  EXPECT_CONTAINS(pair_refused("r"), "folder: cannot be read: ");
  write("r", {});
  EXPECT_CONTAINS(pair_refused("l"), "images: none in this folder");
  write("l", {"000000.png", "000001.png"});
  EXPECT_CONTAINS(pair_refused("r"), "images: 0 here, but 2 in " + path("l"));
  write("r", {"000000.png", "000002.png"});
  EXPECT_CONTAINS(pair_refused("r"), "frame 1: 000002.png is not the partner of 000001.png");
}

TEST_F(FrameFolderTest, NumbersThatAreNeverSharedArePairedInOrder) {
  write("l", {"cam0_1.png", "cam0_2.png"});
  write("r", {"cam1_1.png", "cam1_3.png"});
  EXPECT_EQ(FrameFolder::open_pair(path("l"), path("r")).count(), 2);
}

TEST_F(FrameFolderTest, FrameOutOfRangeSaysHowManyThereAre) {
  write("l", {"0.png", "1.png"});
  write("r", {"0.png", "1.png"});
  const FrameFolder frames = FrameFolder::open_pair(path("l"), path("r"));
  for (const int n : {-1, 2, 1 << 30}) {
    EXPECT_CONTAINS(refusal(path("l"), [&](const std::string&) { (void)frames.left(n); }),
                    "frame " + std::to_string(n) + ": there are 2 frames, 0 to 1");
    EXPECT_THROW((void)frames.right(n), InputError);
    EXPECT_THROW((void)frames.timestamp_ns(n), InputError);
  }
}

TEST_F(FrameFolderTest, KittiGreyBeforeColour) {
  write("seq/image_2", {"000000.png"});
  write("seq/image_3", {"000000.png"});
  EXPECT_EQ(sequence().left(0), path("seq/image_2/000000.png"));
  write("seq/image_0", {"000000.png", "000001.png"});
  EXPECT_EQ(sequence().right(0), path("seq/image_3/000000.png"));
  write("seq/image_1", {"000000.png", "000001.png"});
  EXPECT_EQ(sequence().count(), 2);
  EXPECT_EQ(sequence().left(0), path("seq/image_0/000000.png"));
  EXPECT_EQ(sequence(CameraNumbers{2, 3}).left(0), path("seq/image_2/000000.png"));
}

TEST_F(FrameFolderTest, KittiTimesAreFoundByTheImagesNumber) {
  write("seq/left", {"000001.png", "000003.png"});
  write("seq/right", {"000001.png", "000003.png"});
  EXPECT_FALSE(sequence().timestamp_ns(0).has_value());
  write_text("seq/times.txt", "0.000000e+00\n1.036224e-01\n2.072000e-01\n3.108e-01\n");
  EXPECT_EQ(sequence().timestamp_ns(0), 103622400);
  EXPECT_EQ(sequence().timestamp_ns(1), 310800000);
}

TEST_F(FrameFolderTest, OtherNamesHaveTheTimeOfTheirPlace) {
  write("seq/left", {"l1.png", "l3.png"});
  write("seq/right", {"r1.png", "r3.png"});
  write_text("seq/times.txt", "5\r\n5\r\n\r\n");
  EXPECT_EQ(sequence().timestamp_ns(1), 5000000000);
}

TEST_F(FrameFolderTest, TimesRefusals) {
  write("seq/left", {"0.png", "1.png"});
  write("seq/right", {"0.png", "1.png"});
  const std::vector<std::pair<std::string, std::string>> cases{
      {"1.0\n", "times: 1 lines, but 1.png would need line 2"},
      {"1.0\n0.5\n", "line 2: earlier than the line before it"},
      {"-1\n0\n", "line 1: -1 is not a time in seconds"},
      {"0\n1e300\n", "line 2: 1e+300 is not a time in seconds"},
      {"0\nnan\n", "line 2: 'nan' is not a finite number"},
      {"0\none\n", "line 2: 'one' is not a number"},
      {"", "file: is empty"}};
  for (const auto& [text, reason] : cases) {
    write_text("seq/times.txt", text);
    EXPECT_CONTAINS(refused("seq/times.txt"), reason);
  }
}

TEST_F(FrameFolderTest, EurocPairsByTheTimesOfItsLists) {
  const std::string head = "#timestamp [ns],filename\r\n";
  write("seq/mav0/cam0/data", {"a.png", "b.png", "c.png", "e.png"});
  write("seq/mav0/cam1/data", {"a.png", "c.png", "d.png"});
  write_text("seq/mav0/cam0/data.csv", head + "100,a.png\r\n200,b.png\r\n300,c.png\r\n500,e.png\r\n");
  write_text("seq/mav0/cam1/data.csv", head + "100,a.png\r\n300, c.png\r\n400,d.png\r\n500,e.png\r\n600,f.png\r\n");
  const FrameFolder frames = sequence();
  EXPECT_EQ(pairs(frames), (Names{"a.png|a.png", "c.png|c.png"}));
  EXPECT_EQ(frames.left(1), path("seq/mav0/cam0/data/c.png"));
  EXPECT_EQ(frames.timestamp_ns(1), 300);
  EXPECT_EQ(frames.skipped(),
            (Names{"frame at 200 ns left out: no right image", "frame at 400 ns left out: no left image",
                   "frame at 500 ns left out: " + path("seq/mav0/cam1/data/e.png") + " does not exist",
                   "frame at 600 ns left out: no left image"}));
}

TEST_F(FrameFolderTest, EurocPairsByNameWithoutLists) {
  write("seq/cam0", {"1403715273262142976.jpg", "1403715278362142976.jpg", "9.jpg"});
  write("seq/cam1", {"1403715278362142976.jpg", "1403715273262142976.jpg"});
  const FrameFolder frames = sequence();
  EXPECT_EQ(frames.count(), 2);
  EXPECT_EQ(frames.timestamp_ns(0), 1403715273262142976);
  EXPECT_EQ(frames.skipped(), Names{"frame at 9 ns left out: no right image"});
}

TEST_F(FrameFolderTest, EurocRefusals) {
  write("seq/cam0", {"1.png"});
  write("seq/cam1", {"2.png"});
  EXPECT_CONTAINS(refused("seq"), "frames: none of 1 left and 1 right images have their partner, frame at 1 ns");
  write("seq/cam1", {"left.png"});
  EXPECT_CONTAINS(refused("seq/cam1/left.png"), "file name: 'left' is not a time");
  const std::vector<std::pair<std::string, std::string>> cases{
      {"1 1.png\n", "line 1: '1 1.png' has no comma"},
      {"#\n-1,1.png\n", "line 2: '-1' is not a time"},
      {"1.5,1.png\n", "line 1: '1.5' is not a time"},
      {"99999999999999999999,1.png\n", "is not a time"},
      {"1,../1.png\n", "line 1: '../1.png' is not the name of a file"},
      {"1,/etc/passwd\n", "is not the name of a file"},
      {"1,..\n", "is not the name of a file"},
      {"1,\n", "line 1: '' is not the name of a file"},
      {"2,1.png\n1,1.png\n", "time 1: not later than the one before it"},
      {"1,1.png\n1,1.png\n", "time 1: not later than the one before it"},
      {"", "file: is empty"}};
  for (const auto& [text, reason] : cases) {
    write_text("seq/cam0/data.csv", text);
    EXPECT_CONTAINS(refused("seq/cam0/data.csv"), reason);
  }
  write_text("seq/cam0/data.csv", "# nothing\n");
  fs::remove(path("seq/cam1/left.png"));
  EXPECT_CONTAINS(refused("seq"), "frames: none of 0 left and 1 right images");
}

TEST_F(FrameFolderTest, LayoutsThatAreNone) {
  EXPECT_CONTAINS(refused("seq"), "sequence: is not a folder");
  write("seq", {"0.png"});
  const std::string none = refused("seq");
  EXPECT_CONTAINS(none,
                  "sequence: holds none of the folders looked for: image_0 and image_1, image_2 and image_3, "
                  "left and right, mav0/cam0 and mav0/cam1, cam0 and cam1 (name");
  write("seq/image_1", {"0.png"});
  EXPECT_CONTAINS(refused("seq"), "cam0 and cam1; image_1 is there, image_0 is not (name");
  EXPECT_CONTAINS(refused("seq", CameraNumbers{2, 3}), "looked for: image_2 and image_3, left and right");
  write("seq/left", {"0.png"});
  write("seq/right", {"0.png"});
  EXPECT_EQ(sequence().count(), 1);
  write("seq/cam0", {"0.png"});
  write("seq/cam1", {"0.png"});
  EXPECT_CONTAINS(refused("seq"), "sequence: both " + path("seq/left") + " and " + path("seq/cam0") + " are there");
}

TEST(CameraNumbersOf, FoldersSayWhichCameras) {
  const auto is = [](const std::string& left, const std::string& right, int l, int r) {
    const CameraNumbers numbers = camera_numbers_of(left, right);
    EXPECT_EQ(numbers.left, l) << left;
    EXPECT_EQ(numbers.right, r) << right;
  };
  is("seq/image_2/0.png", "seq/image_3/0.png", 2, 3);
  is("image_02/0.png", "image_03/0.png", 2, 3);
  is("image_1/0.png", "image_0/0.png", 1, 0);
  is("image_2/0.png", "right/0.png", 0, 1);
  is("image_4/0.png", "image_5/0.png", 0, 1);
  is("0.png", "", 0, 1);
}

TEST(FrameFolderData, KittiOdometry06) {
  const std::string folder = test::data_path("kitti_odometry_06");
  if (folder.empty()) GTEST_SKIP() << "no kitti_odometry_06 under LAKSHYA_DATA";
  const FrameFolder frames = FrameFolder::open_sequence(folder);
  EXPECT_EQ(frames.count(), 51);
  EXPECT_EQ(frames.left(50), folder + "/left/000050.png");
  EXPECT_EQ(frames.right(7), folder + "/right/000007.png");
  EXPECT_TRUE(frames.skipped().empty());
}

TEST(FrameFolderData, Kitti2012) {
  const std::string folder = test::data_path("kitti2012");
  if (folder.empty()) GTEST_SKIP() << "no kitti2012 under LAKSHYA_DATA";
  const FrameFolder frames = FrameFolder::open_pair(folder + "/left", folder + "/right");
  EXPECT_EQ(frames.count(), 6);
  EXPECT_EQ(frames.right(3), folder + "/right/000043_10.png");
}

TEST(FrameFolderData, Euroc) {
  const std::string folder = test::data_path("euroc_v1_01_part_a");
  if (folder.empty()) GTEST_SKIP() << "no euroc_v1_01_part_a under LAKSHYA_DATA";
  const FrameFolder frames = FrameFolder::open_sequence(folder);
  EXPECT_EQ(frames.count(), 44);
  EXPECT_EQ(frames.timestamp_ns(0), 1403715273262142976);
  EXPECT_EQ(frames.right(0), folder + "/cam1/1403715273262142976.jpg");
  EXPECT_TRUE(frames.skipped().empty());
}

}  // namespace
}  // namespace lakshya
