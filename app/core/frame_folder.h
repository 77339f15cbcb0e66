// Recorded stereo frames as data sets keep them: which two image files are frame n, and when it was taken. Start-up
// and host tools only; the images themselves are not opened here.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/core/calibration_file.h"

namespace lakshya {

class FrameFolder {
 public:
  // A folder that holds a sequence, recognised by its folders:
  //  - KITTI odometry: image_0 and image_1 (grey), else image_2 and image_3 (colour); `cameras` asks for others.
  //  - left and right.
  //  - EuRoC: cam0 and cam1, also below mav0. The images lie in data/ or beside it. Frames are paired by time: of
  //    data.csv, or of the file names where there is no list; a frame without its partner is left out, see skipped().
  // The first two are paired as open_pair() does; times come from the file times.txt (KITTI: seconds, one per line)
  // where there is one: an image named by a number k has the time of line k, counted from 0, any other that of its
  // place in the folder.
  // Throws InputError: no such folders, more than one of these layouts, no frames, or lists that are damaged.
  static FrameFolder open_sequence(const std::string& folder, std::optional<CameraNumbers> cameras = {});

  // Two folders of images, each in order of their names (numbers inside names count as numbers). Throws InputError
  // when the counts differ, and when names show that an image is missing: some numbers are in both folders, but not
  // at the same places.
  static FrameFolder open_pair(const std::string& left_folder, const std::string& right_folder);

  // One frame: these two images.
  static FrameFolder single_pair(const std::string& left_image, const std::string& right_image);

  int count() const { return static_cast<int>(frames_.size()); }

  // Frame n, counted from 0. Throws InputError, with the count, for n outside 0..count()-1.
  const std::string& left(int n) const { return at(n).left; }
  const std::string& right(int n) const { return at(n).right; }
  // Nanoseconds of the recording's clock; empty where the folder does not say.
  std::optional<std::int64_t> timestamp_ns(int n) const { return at(n).time_ns; }

  // One sentence for each frame that was left out.
  const std::vector<std::string>& skipped() const { return skipped_; }

 private:
  struct Frame {
    std::string left;
    std::string right;
    std::optional<std::int64_t> time_ns;
  };

  explicit FrameFolder(std::string name) : name_(std::move(name)) {}
  const Frame& at(int n) const;
  void add_pairs_by_time(const std::string& left_folder, const std::string& right_folder);
  void add_times(const std::string& path);

  std::string name_;  // for messages
  std::vector<Frame> frames_;
  std::vector<std::string> skipped_;
};

// The cameras of a KITTI calibration that took two images, by the names of their folders: image_0 .. image_3 (also
// image_00 .. image_03); 0 and 1 for any other names.
CameraNumbers camera_numbers_of(const std::string& left_path, const std::string& right_path);

}  // namespace lakshya
