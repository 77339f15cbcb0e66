#include "app/tools/stereo_input.h"

#include <spdlog/spdlog.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <system_error>
#include <utility>

#include "app/core/calibration_file.h"
#include "app/core/image_file.h"
#include "app/core/input_error.h"

namespace lakshya {
namespace {

using Options = StereoInputOptions;

struct PairPaths {
  std::string left;
  std::string right;
  std::optional<std::int64_t> timestamp_ns;
};

std::optional<CameraNumbers> asked_cameras(const Options& o) {
  if (o.cameras.size() != 2) return {};
  return CameraNumbers{o.cameras[0], o.cameras[1]};
}

bool is_folder(const std::string& path) {
  std::error_code ignored;
  return std::filesystem::is_directory(path, ignored);
}

PairPaths paths_of(const FrameFolder& frames, int n) {
  return {frames.left(n), frames.right(n), frames.timestamp_ns(n)};
}

PairPaths frame_of(const FrameFolder& frames, const Options& o) {
  if (!o.frame) {
    throw InputError(o.sequence.empty() ? o.left : o.sequence, "frame: holds " + std::to_string(frames.count()) +
                                                                   " frames (choose one with --frame 0 to " +
                                                                   std::to_string(frames.count() - 1) + ")");
  }
  PairPaths paths = paths_of(frames, *o.frame);
  spdlog::info("frame {} of {}: {}", *o.frame, frames.count(), paths.left);
  return paths;
}

FrameFolder with_warning(FrameFolder frames) {
  if (!frames.skipped().empty()) {
    spdlog::warn("{} frames lack their partner; the first: {}", frames.skipped().size(), frames.skipped().front());
  }
  return frames;
}

// Empty where the options name two images.
std::optional<FrameFolder> open_frames(const Options& o) {
  if (!o.sequence.empty()) return with_warning(FrameFolder::open_sequence(o.sequence, asked_cameras(o)));
  if (o.left.empty()) throw CLI::RequiredError("A stereo pair (--left --right --calib, or --sequence --frame)");
  if (is_folder(o.left) && is_folder(o.right)) return with_warning(FrameFolder::open_pair(o.left, o.right));
  if (is_folder(o.left) || is_folder(o.right)) {
    throw InputError(is_folder(o.left) ? o.left : o.right,
                     "image: is a folder, but the other side is not (give two images or two folders)");
  }
  if (o.frame) throw InputError(o.left, "frame: not a folder of frames (leave --frame out, or give folders)");
  return {};
}

// The images' folders say which of KITTI's cameras they are, unless the options do.
StereoCalibration read_calibration_of(const Options& o, const PairPaths& paths, double opencv_unit_m) {
  CalibrationRequest request{o.calibration, opencv_unit_m, camera_numbers_of(paths.left, paths.right)};
  if (request.paths.empty()) request.paths = {o.sequence};
  if (const auto cameras = asked_cameras(o)) request.cameras = *cameras;
  return read_calibration(request);
}

std::string size_text(const Image<std::uint8_t>& image) {
  return std::to_string(image.width()) + "x" + std::to_string(image.height());
}

StereoInput read_pair(const PairPaths& paths, const StereoCalibration& calibration) {
  StereoInput input;
  input.calibration = calibration;
  input.left = read_gray(paths.left);
  input.right = read_gray(paths.right);
  input.left_path = paths.left;
  input.right_path = paths.right;
  input.timestamp_ns = paths.timestamp_ns;
  require_image_size(input.calibration, input.left.width(), input.left.height(), paths.left);
  require_image_size(input.calibration, input.right.width(), input.right.height(), paths.right);
  if (!same_size(input.left.view(), input.right.view())) {
    throw InputError(paths.right, "size " + size_text(input.right) + " differs from the left image's " +
                                      size_text(input.left) + " (give both images of one pair)");
  }
  return input;
}

}  // namespace

void add_stereo_input_options(CLI::App& command, StereoInputOptions& o) {
  CLI::Option* left = command.add_option("--left", o.left,
                                         "Left image: PNG, PGM, PPM or JPEG, 8 bits, grey or colour; or a folder");
  CLI::Option* right =
      command.add_option("--right", o.right, "Right image of the same size; or a folder of as many images");
  command
      .add_option("--sequence", o.sequence,
                  "Folder of a KITTI odometry or EuRoC sequence, or one with left and right")
      ->excludes(left)
      ->excludes(right);
  command.add_option("--frame", o.frame, "Which frame of the folders, from 0")->check(CLI::NonNegativeNumber);
  CLI::Option* calib =
      command
          .add_option("--calib", o.calibration,
                      "Calibration file (OpenCV, Middlebury, KITTI), two files, left and right (EuRoC, "
                      "ROS), or a folder; default: the sequence's own")
          ->expected(1, 2);
  command
      .add_option("--cameras", o.cameras,
                  "KITTI's cameras: 0,1 grey, 2,3 colour; default: as the images' folders say, else 0,1")
      ->delimiter(',')
      ->expected(2)
      ->check(CLI::Range(0, 3));
  left->needs(right)->needs(calib);
  right->needs(left);
}

StereoInput read_stereo_input(const StereoInputOptions& o, double opencv_unit_m) {
  const std::optional<FrameFolder> frames = open_frames(o);
  const PairPaths paths = frames ? frame_of(*frames, o) : PairPaths{o.left, o.right, {}};
  return read_pair(paths, read_calibration_of(o, paths, opencv_unit_m));
}

StereoFrames::StereoFrames(const StereoInputOptions& o, double opencv_unit_m)
    : left_(o.left), right_(o.right), frames_(open_frames(o)), first_(o.frame.value_or(0)) {
  const PairPaths paths = frames_ ? paths_of(*frames_, first_) : PairPaths{o.left, o.right, {}};
  calibration_ = read_calibration_of(o, paths, opencv_unit_m);
}

StereoInput StereoFrames::read(int n) const {
  if (!frames_) return read_pair({left_, right_, {}}, calibration_);
  return read_pair(paths_of(*frames_, (first_ + n) % frames_->count()), calibration_);
}

}  // namespace lakshya
