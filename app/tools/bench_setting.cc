#include "app/tools/bench_setting.h"

#include <omp.h>

#include <algorithm>
#include <opencv2/core.hpp>

#include "app/core/input_error.h"
#include "app/core/vehicle_config_file.h"
#include "app/tools/bench_scene.h"
#include "app/tools/bench_subjects.h"
#include "kernels/base/isa.h"

namespace lakshya {
namespace {

constexpr int kLeastSide = 64;
constexpr int kMostSide = 4096;
constexpr const char* kPeerBm = "StereoBM 15x15";
constexpr const char* kPeerSgbm = "StereoSGBM MODE_SGBM";
constexpr const char* kPeerRemap = "remap INTER_LINEAR CV_16SC2";
constexpr const char* kPeerProject = "reprojectImageTo3D + loop";

void check(const BenchSetting& s) {
  const auto side_ok = [](int side) { return kLeastSide <= side && side <= kMostSide; };
  if (!side_ok(s.width) || !side_ok(s.height)) {
    throw InputError("--size", std::to_string(s.width) + "x" + std::to_string(s.height) + " is outside " +
                                   std::to_string(kLeastSide) + " to " + std::to_string(kMostSide) + " px a side");
  }
  if (s.config.matcher.disparities >= s.width) {
    throw InputError("--disparities", std::to_string(s.config.matcher.disparities) + " do not fit in images " +
                                          std::to_string(s.width) + " px wide (ask for fewer)");
  }
  if (s.threads < 1 || s.threads > usable_processors()) {
    throw InputError("--threads", std::to_string(s.threads) + " asked for, but this machine has " +
                                      std::to_string(usable_processors()) +
                                      " processors for this program (more threads would measure their waiting)");
  }
}

class Bench {
 public:
  Bench(const BenchSetting& setting, const std::function<void(const std::string&)>& before)
      : s_(setting),
        before_(before),
        input_(make_bench_input(s_.width, s_.height, s_.config.matcher.disparities, s_.pair)),
        frame_(s_.config, s_.kernels, input_) {
    keep_disparity();
  }

  BenchResult run() {
    stage_row("rectify", Stage::rectify, kPeerRemap, opencv_rectify_task(input_));
    match_rows("sad", {{"sad", kPeerBm, "opencv-bm"}});
    match_rows("census", {{"census", kPeerBm, "opencv-bm"}});
    match_rows("sgm", {{"sgm", kPeerSgbm, "opencv-sgbm"}, {"sgm_vs_bm", kPeerBm, "opencv-bm"}});
    stage_row("ground", Stage::ground, "", {});
    OpencvProjectSubject peer(s_.config, frame_, std::as_const(disparity_).view());
    stage_row("project_and_bin", Stage::project_and_bin, kPeerProject, peer.task());
    frame_row();
    return std::move(result_);
  }

 private:
  struct MatchPeer {
    std::string row;
    const char* peer;
    std::string opencv_name;
  };

  bool wanted(const std::string& row) const {
    return std::find(s_.rows.begin(), s_.rows.end(), row) != s_.rows.end();
  }

  // `make` gives the task; what it needs is only made when it is wanted.
  template <class Make>
  std::optional<double> reference_ms(const Make& make) const {
    if (s_.reference_runs < 1) return {};
    const BenchTask task = make();
    std::vector<double> times;
    times.reserve(static_cast<std::size_t>(s_.reference_runs));
    for (int i = 0; i < s_.reference_runs; ++i)
      times.push_back(task());
    return median(times);
  }

  // The stages around the matcher are timed on the disparity that the whole pipeline finds.
  void keep_disparity() {
    const FrameResult& frame = frame_.run();
    disparity_ = Image<std::int16_t>(s_.width, s_.height);
    for (int v = 0; v < s_.height; ++v)
      std::copy_n(frame.disparity.row(v), s_.width, disparity_.view().row(v));
    const double pixels = static_cast<double>(s_.width) * s_.height;
    const auto share = [&](PixelClass c) { return frame.pixels.by_class[static_cast<std::size_t>(c)] / pixels; };
    std::int64_t found = 0;
    for (int v = 0; v < s_.height; ++v) {
      found += std::count_if(disparity_.view().row(v), disparity_.view().row(v) + s_.width,
                             [](std::int16_t d) { return d >= 0; });
    }
    const MatcherConfig& m = s_.config.matcher;
    result_ = {s_.backend,
               active_isa(),
               s_.width,
               s_.height,
               m.disparities,
               s_.threads,
               m.bands,
               static_cast<double>(found) / pixels,
               share(PixelClass::obstacle),
               share(PixelClass::floor),
               {}};
  }

  void stage_row(const char* name, Stage stage, const char* peer, const BenchTask& peer_task) {
    if (!wanted(name)) return;
    before_(name);
    const GivenMatch given(std::as_const(disparity_).view());
    const KernelTable ours = GivenMatch::without_matching(s_.kernels);
    const KernelTable reference = GivenMatch::without_matching(kReferenceKernels);
    PipelineSubject subject(s_.config, ours, input_);
    std::vector<BenchTask> tasks{subject.stage_task(stage)};
    if (peer_task) tasks.push_back(peer_task);
    const std::vector<double> ms = interleaved_medians(tasks, s_.rounds);
    std::optional<PipelineSubject> slow;
    const auto slow_task = [&] { return slow.emplace(s_.config, reference, input_).stage_task(stage); };
    BenchRow row{name, ms[0], reference_ms(slow_task), peer, {}};
    if (peer_task) row.peer_ms = ms[1];
    result_.rows.push_back(row);
  }

  void match_rows(const char* matcher, std::vector<MatchPeer> peers) {
    std::erase_if(peers, [&](const MatchPeer& p) { return !wanted(p.row); });
    if (peers.empty()) return;
    before_(matcher);
    MatcherConfig config = s_.config.matcher;
    config.name = matcher;
    MatchSubject subject(config, s_.kernels, input_);
    std::vector<BenchTask> tasks{subject.task()};
    for (const MatchPeer& p : peers)
      tasks.push_back(opencv_match_task(p.opencv_name, config, input_));
    const std::vector<double> ms = interleaved_medians(tasks, s_.rounds);
    std::optional<MatchSubject> slow;
    const std::optional<double> reference =
        reference_ms([&] { return slow.emplace(config, kReferenceKernels, input_).task(); });
    for (std::size_t i = 0; i < peers.size(); ++i)
      result_.rows.push_back({peers[i].row, ms[0], reference, peers[i].peer, ms[i + 1]});
  }

  void frame_row() {
    if (!wanted("frame")) return;
    before_("frame");
    const std::vector<double> ms = interleaved_medians(
        {frame_.frame_task(), opencv_match_task("opencv-bm", s_.config.matcher, input_)}, s_.rounds);
    std::optional<PipelineSubject> slow;
    const auto slow_task = [&] { return slow.emplace(s_.config, kReferenceKernels, input_).frame_task(); };
    const std::string peer = std::string(kPeerBm) + ", disparity alone";
    result_.rows.push_back({"frame", ms[0], reference_ms(slow_task), peer, ms[1]});
  }

  const BenchSetting& s_;
  const std::function<void(const std::string&)>& before_;
  BenchInput input_;
  PipelineSubject frame_;
  Image<std::int16_t> disparity_;
  BenchResult result_;
};

}  // namespace

VehicleConfig bench_config(int disparities, const std::vector<std::string>& sets) {
  std::vector<std::string> all{"matcher.disparities=" + std::to_string(disparities),
                               "camera.height_m=" + std::to_string(kBenchCameraHeightM),
                               "camera.pitch_deg=" + std::to_string(kBenchCameraPitchDeg)};
  all.insert(all.end(), sets.begin(), sets.end());
  return load_vehicle_config("", "", all);
}

int usable_processors() {
  return omp_get_num_procs();
}

BenchResult run_bench(const BenchSetting& setting, const std::function<void(const std::string&)>& before) {
  check(setting);
  omp_set_num_threads(setting.threads);
  cv::setNumThreads(setting.threads);
  BenchSetting s = setting;
  s.config.matcher.bands = std::max(s.config.matcher.bands, s.threads);  // fewer would leave threads idle
  if (s.threads > 1) s.rounds.rest_ms = kOpenMpRestMs;
  return Bench(s, before).run();
}

}  // namespace lakshya
