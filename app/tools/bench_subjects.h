// Private to bench_*.cc: what is measured, ours and OpenCV's, ready to run.
#pragma once

#include <memory>
#include <opencv2/core.hpp>
#include <string>

#include "app/core/arena.h"
#include "app/core/pipeline.h"
#include "app/tools/bench_input.h"
#include "app/tools/bench_measure.h"
#include "app/tools/opencv_projection.h"

namespace lakshya {

// Tasks that refer to these objects must not outlive them, nor the input and the kernel table.

// A whole matcher on the rectified pair, memory taken beforehand.
class MatchSubject {
 public:
  MatchSubject(const MatcherConfig& config, const KernelTable& kernels, const BenchInput& input);
  BenchTask task();

 private:
  const BenchInput& input_;
  Arena arena_;
  std::unique_ptr<Matcher> matcher_;
};

// One of opencv_matcher_names() on the rectified pair; it keeps its buffers from run to run.
BenchTask opencv_match_task(const std::string& name, const MatcherConfig& config, const BenchInput& input);

// Raw pair to steering command. While a GivenMatch lives, pipelines whose table came from it have its disparity instead of
// a matcher's, so that the other stages can be timed without waiting for the matcher.
class PipelineSubject {
 public:
  PipelineSubject(const VehicleConfig& config, const KernelTable& kernels, const BenchInput& input);
  BenchTask frame_task();
  BenchTask stage_task(Stage stage);
  const FrameResult& run();
  const Pipeline& pipeline() const { return pipeline_; }

 private:
  const BenchInput& input_;
  Pipeline pipeline_;
  FrameResult result_;
};

// One at a time: kernels are plain functions and have no other place to find the image.
class GivenMatch {
 public:
  explicit GivenMatch(ImageView<const std::int16_t> disparity);
  ~GivenMatch();
  GivenMatch(const GivenMatch&) = delete;
  GivenMatch& operator=(const GivenMatch&) = delete;
  static KernelTable without_matching(KernelTable kernels);
};

// cv::remap of both raw images through the same maps in OpenCV's fixed point (CV_16SC2: 1/32 px).
BenchTask opencv_rectify_task(const BenchInput& input);

// The same tests and binning in a loop over the cloud of cv::reprojectImageTo3D.
class OpencvProjectSubject {
 public:
  OpencvProjectSubject(const VehicleConfig& config, const PipelineSubject& frame,
                       ImageView<const std::int16_t> disparity);
  BenchTask task();

 private:
  void take_grid(Arena& arena);
  const PruneModel& model_;
  ImageView<const std::int16_t> disparity_;
  GridGeometry geometry_;
  OpencvProjection projection_;
  Arena arena_;
  NavGrid grid_;
};

}  // namespace lakshya
