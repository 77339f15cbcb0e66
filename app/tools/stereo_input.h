// Where a command's stereo pair comes from: two images, two folders of images, or a recorded sequence.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "app/core/calibration.h"
#include "app/core/frame_folder.h"
#include "app/core/image.h"

namespace CLI {
class App;
}

namespace lakshya {

struct StereoInputOptions {
  std::string left;
  std::string right;
  std::string sequence;
  std::optional<int> frame;
  std::vector<std::string> calibration;
  std::vector<int> cameras;
};

// --left, --right, --sequence, --frame, --calib, --cameras
void add_stereo_input_options(CLI::App& command, StereoInputOptions& options);

struct StereoInput {
  Image<std::uint8_t> left;
  Image<std::uint8_t> right;
  std::string left_path;
  std::string right_path;
  std::optional<std::int64_t> timestamp_ns;  // where the recording says
  StereoCalibration calibration;
};

// Both images have one size, which is the calibration's. Throws InputError for what cannot be read or does not go
// together, CLI::ParseError where the options do not say which pair.
StereoInput read_stereo_input(const StereoInputOptions& options, double opencv_unit_m);

// One pair after the other, for commands that want many: of a folder or sequence the frames in turn, from --frame (or the
// first) on and after the last again from the first; of two images the same pair again and again.
class StereoFrames {
 public:
  // Throws as read_stereo_input() does.
  StereoFrames(const StereoInputOptions& options, double opencv_unit_m);

  bool is_single() const { return !frames_; }
  StereoInput read(int n) const;

 private:
  std::string left_, right_;
  std::optional<FrameFolder> frames_;
  int first_;
  StereoCalibration calibration_;
};

}  // namespace lakshya
