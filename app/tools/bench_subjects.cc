#include "app/tools/bench_subjects.h"

#include <Eigen/LU>
#include <algorithm>
#include <opencv2/imgproc.hpp>

#include "app/core/geometry.h"
#include "app/core/input_error.h"
#include "app/core/matcher.h"
#include "app/tools/opencv_matchers.h"
#include "kernels/grid_bin/grid_bin.h"

namespace lakshya {
namespace {

void require_ok(Status status, const char* what) {
  if (status != Status::ok) throw InputError("bench", std::string(what) + " cannot run: " + to_string(status));
}

ImageView<const std::int16_t>& given() {
  static ImageView<const std::int16_t> image;
  return image;
}

// Deduced from the table's entry, whatever its parameters are.
template <class... Arguments>
Status skip(Arguments... /*unused*/) {
  return Status::ok;
}

Status copy_given(ImageView<const std::int16_t> /*matched*/, const SupportParams& /*params*/, Rows rows,
                  ImageView<std::int16_t> out) {
  if (!same_size(given(), out)) return Status::size_mismatch;
  for (int v = rows.begin; v < rows.end; ++v)
    std::copy_n(given().row(v), out.width, out.row(v));
  return Status::ok;
}

constexpr double kNoDoffs = 0;

}  // namespace

MatchSubject::MatchSubject(const MatcherConfig& config, const KernelTable& kernels, const BenchInput& input)
    : input_(input) {
  const int width = input.left.width();
  const int height = input.left.height();
  Arena measure;
  (void)Matcher(config, kNoDoffs, width, height, kernels, measure);
  arena_ = Arena(measure.used());
  matcher_ = std::make_unique<Matcher>(config, kNoDoffs, width, height, kernels, arena_);
}

BenchTask MatchSubject::task() {
  return timed_task([this] {
    ImageView<const std::int16_t> found;
    require_ok(matcher_->match(input_.left.view(), input_.right.view(), found), "the matcher");
  });
}

BenchTask opencv_match_task(const std::string& name, const MatcherConfig& config, const BenchInput& input) {
  const auto matcher = make_opencv_matcher(name, config.disparities, config.min_disparity);
  return timed_task([matcher, &input, found = cv::Mat()]() mutable {
    matcher->compute(opencv_view(input.left), opencv_view(input.right), found);
  });
}

PipelineSubject::PipelineSubject(const VehicleConfig& config, const KernelTable& kernels, const BenchInput& input)
    : input_(input),
      pipeline_(config, input.calibration, input.raw_left.width(), input.raw_left.height(), kernels,
                bench_clock()) {}

const FrameResult& PipelineSubject::run() {
  require_ok(pipeline_.process(input_.raw_left.view(), input_.raw_right.view(), PlanInput{}, result_),
             "the pipeline");
  return result_;
}

BenchTask PipelineSubject::frame_task() {
  return timed_task([this] { (void)run(); });
}

BenchTask PipelineSubject::stage_task(Stage stage) {
  return [this, stage] { return static_cast<double>(run().times.took[static_cast<std::size_t>(stage)]) * 1e-6; };
}

GivenMatch::GivenMatch(ImageView<const std::int16_t> disparity) {
  given() = disparity;
}

GivenMatch::~GivenMatch() {
  given() = {};
}

KernelTable GivenMatch::without_matching(KernelTable kernels) {
  kernels.census = skip;
  kernels.texture = skip;
  kernels.edge_sobel = skip;
  kernels.edge_log = skip;
  kernels.sgm = skip;
  kernels.census_block = skip;
  kernels.sad_block = skip;
  kernels.support = copy_given;
  return kernels;
}

BenchTask opencv_rectify_task(const BenchInput& input) {
  struct RemapSide {
    cv::Mat raw, map_xy, map_fraction, out;
  };
  const StereoCalibration& rig = input.calibration;
  const Rectification r = rectify_stereo(rig, input.raw_left.width(), input.raw_left.height());
  const auto side = [](const Image<std::uint8_t>& raw, const CameraModel& camera, const Eigen::Matrix3d& R,
                       const Eigen::Matrix<double, 3, 4>& P) {
    const Eigen::Matrix3d R_inverse = R.inverse();
    cv::Mat xy(raw.height(), raw.width(), CV_32FC2);
    for (int v = 0; v < raw.height(); ++v) {
      for (int u = 0; u < raw.width(); ++u) {
        const Eigen::Vector2d at = raw_pixel(camera, R_inverse, P, u, v);
        xy.at<cv::Vec2f>(v, u) = {static_cast<float>(at.x()), static_cast<float>(at.y())};
      }
    }
    RemapSide s{opencv_view(raw), {}, {}, {}};
    cv::convertMaps(xy, {}, s.map_xy, s.map_fraction, CV_16SC2);
    return s;
  };
  std::vector<RemapSide> sides{side(input.raw_left, rig.left, r.R1, r.P1),
                               side(input.raw_right, rig.right, r.R2, r.P2)};
  return timed_task([sides = std::move(sides)]() mutable {
    for (RemapSide& s : sides)
      cv::remap(s.raw, s.out, s.map_xy, s.map_fraction, cv::INTER_LINEAR, cv::BORDER_CONSTANT);
  });
}

OpencvProjectSubject::OpencvProjectSubject(const VehicleConfig& config, const PipelineSubject& frame,
                                           ImageView<const std::int16_t> disparity)
    : model_(frame.pipeline().prune_model()),
      disparity_(disparity),
      geometry_(grid_geometry(config.grid)),
      projection_(make_opencv_projection(prune_geometry(config, frame.pipeline().camera()))) {
  Arena measure;
  take_grid(measure);
  arena_ = Arena(measure.used());
  take_grid(arena_);
}

void OpencvProjectSubject::take_grid(Arena& arena) {
  const int cols = geometry_.cols;
  const int rows = geometry_.rows;
  grid_ = {geometry_,
           arena.take_image<std::uint32_t>(cols, rows),
           arena.take_image<std::int64_t>(cols, rows),
           arena.take_image<std::uint32_t>(cols, rows),
           arena.take_image<std::uint32_t>(cols, rows),
           arena.take_image<std::uint8_t>(cols, rows)};
}

BenchTask OpencvProjectSubject::task() {
  return timed_task([this] {
    require_ok(clear_grid(grid_), "the map");
    project_and_bin_opencv(disparity_, projection_, model_, grid_);
  });
}

}  // namespace lakshya
