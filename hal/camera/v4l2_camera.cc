#include "hal/camera/v4l2_camera.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <utility>

namespace lakshya {
namespace {

constexpr int kMostPartners = 8;  // frames looked at for one pair, after the first two
constexpr int kMostWidth = kV4l2MostSide / 2;
constexpr double kMostFps = 1000;
constexpr double kMostSkewMs = 1000;

V4l2NodeSettings node_settings(const V4l2Settings& settings, int index) {
  const bool two = !settings.right_device.empty();
  V4l2NodeSettings node;
  node.path = index == 0 ? settings.device : settings.right_device;
  node.format = settings.format;
  // Impossible ones are refused by open().
  node.width = two ? settings.width : 2 * std::clamp(settings.width, 0, kMostWidth);
  node.height = settings.height;
  node.controls = {settings.fps, settings.exposure_us, settings.gain};
  node.buffers = settings.buffers;
  return node;
}

}  // namespace

V4l2Camera::V4l2Camera(V4l2Settings settings, Clock& clock, SystemCalls& calls)
    : settings_(std::move(settings)),
      clock_(&clock),
      nodes_{V4l2Node{node_settings(settings_, 0), calls, clock, node_counters_, problem_},
             V4l2Node{node_settings(settings_, 1), calls, clock, node_counters_, problem_}} {}

V4l2Camera::~V4l2Camera() {
  V4l2Camera::close();
}

std::span<const Counter> V4l2Camera::counters() const {
  const V4l2NodeCounters& n = node_counters_;
  const EyeCheck::Counters& e = eyes_.counters();
  shown_ = {n.disconnections, n.dropped, n.lost,   n.torn,   n.small,     n.io_errors, n.unstamped,
            n.not_taken,      unpaired_, damaged_, decoded_, e.corrected, e.unsure};
  return shown_;
}

// ---- open and close

Status V4l2Camera::check_settings() {
  const V4l2Settings& s = settings_;
  const char* wrong = nullptr;
  if (s.device.empty() || s.device == s.right_device) wrong = "device and right_device must be two names";
  if (s.width < kV4l2LeastSide || s.width > kMostWidth || s.height < kV4l2LeastSide || s.height > kV4l2MostSide) {
    wrong = "width or height out of range";
  }
  if (s.format == V4l2Format::yuyv && s.width % 2 != 0) wrong = "YUYV needs an even width";
  if (s.fps != 0 && !(s.fps >= 1 && s.fps <= kMostFps)) wrong = "fps out of range";
  if (!(s.skew_ms >= 0 && s.skew_ms <= kMostSkewMs)) wrong = "skew_ms out of range";
  if (s.buffers < kLeastV4l2Buffers || s.buffers > kMostV4l2Buffers) wrong = "buffers out of range";
  if (wrong == nullptr) return Status::ok;
  problem_.set("%s: %s", s.device.c_str(), wrong);
  return Status::bad_argument;
}

Status V4l2Camera::open() {
  close();
  problem_.clear();
  Status status = check_settings();
  if (status != Status::ok) return status;
  eyes_.open(settings_.check_eyes);
  status = open_nodes();
  if (status != Status::ok) return status;
  const std::size_t pixels = settings_.format == V4l2Format::grey
                                 ? 0
                                 : static_cast<std::size_t>(nodes_[0].picture().width) *
                                       static_cast<std::size_t>(nodes_[0].picture().height);
  for (int i = 0; i < nodes(); ++i)
    memory_[static_cast<std::size_t>(i)].assign(pixels, 0);
  wanted_ = true;
  return Status::ok;
}

Status V4l2Camera::open_nodes() {
  Status status = nodes_[0].open();
  if (status == Status::ok && two()) status = nodes_[1].open();
  if (status != Status::ok) close_nodes();
  if (status != Status::ok || !two()) return status;
  const int unequal =
      compare_lights(nodes_[0].light(), nodes_[0].path(), nodes_[1].light(), nodes_[1].path(), problem_);
  node_counters_.not_taken.value += static_cast<std::uint64_t>(unequal);
  return Status::ok;
}

void V4l2Camera::close_nodes() {
  for (V4l2Node& node : nodes_)
    node.close();
}

void V4l2Camera::close() {
  close_nodes();
  wanted_ = false;
}

// ---- capture

Status V4l2Camera::look_again(Nanoseconds deadline) {
  if (nodes_[0].is_open()) return Status::ok;
  if (!wanted_) {
    problem_.set("%s: is not open", settings_.device.c_str());
    return Status::disconnected;
  }
  if (!retry_.wait(*clock_, deadline)) return Status::disconnected;
  if (open_nodes() != Status::ok) return Status::disconnected;
  if (two()) eyes_.again();  // the kernel numbers its nodes in the order in which they come
  return Status::ok;
}

Status V4l2Camera::pair(Nanoseconds deadline) {
  const auto skew = static_cast<Nanoseconds>(std::lround(settings_.skew_ms * static_cast<double>(kMillisecond)));
  for (std::size_t i : {0U, 1U}) {
    const Status status = nodes_[i].newest(deadline, filled_[i]);
    if (status != Status::ok) return status;
  }
  Nanoseconds apart = 0;
  for (int tried = 0; tried <= kMostPartners; ++tried) {
    apart = filled_[1].time - filled_[0].time;
    if (std::abs(apart) <= skew) return Status::ok;
    const std::size_t older = apart > 0 ? 0 : 1;
    ++unpaired_.value;
    if (tried == kMostPartners) break;
    const Status status = nodes_[older].newest(deadline, filled_[older]);
    if (status != Status::ok) return status;
  }
  problem_.set("%s, %s: frames %.1f ms apart, at most %g are a pair", nodes_[0].path(), nodes_[1].path(),
               static_cast<double>(apart) / static_cast<double>(kMillisecond), settings_.skew_ms);
  return Status::bad_data;
}

Status V4l2Camera::make_views(StereoFrame& frame) {
  std::array<ImageView<const std::uint8_t>, 2> grey;
  for (std::size_t i = 0; i < static_cast<std::size_t>(nodes()); ++i) {
    const V4l2Picture& picture = nodes_[i].picture();
    const bool jpeg = picture.format == V4l2Format::mjpg;
    if (jpeg) ++decoded_.value;
    const Status status =
        grey_picture(picture, filled_[i].used, {memory_[i].data(), picture.width, picture.height}, grey[i]);
    if (status == Status::ok) continue;
    if (jpeg) ++damaged_.value;
    problem_.set("%s: a picture of %zu bytes is damaged", nodes_[i].path(), filled_[i].used.size());
    return status;
  }
  if (!two()) grey = {half(grey[0], 0), half(grey[0], 1)};
  const std::size_t left = settings_.swap ? 1 : 0;
  eyes_.look(grey[left], grey[1 - left], settings_.device.c_str(), problem_);
  const std::size_t first = eyes_.swapped() ? 1 - left : left;
  frame.left = grey[first];
  frame.right = grey[1 - first];
  frame.left_time = filled_[two() ? first : 0].time;
  frame.right_time = filled_[two() ? 1 - first : 0].time;
  frame.sequence = filled_[0].sequence;
  return Status::ok;
}

Status V4l2Camera::capture(Nanoseconds deadline, StereoFrame& frame) {
  Status status = look_again(deadline);
  if (status == Status::ok) status = two() ? pair(deadline) : nodes_[0].newest(deadline, filled_[0]);
  if (status == Status::disconnected) close_nodes();  // of two, the other one would stream for nobody
  return status == Status::ok ? make_views(frame) : status;
}

}  // namespace lakshya
