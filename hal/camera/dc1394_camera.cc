#include "hal/camera/dc1394_camera.h"

#ifdef LAKSHYA_HAVE_DC1394

#include <dc1394/dc1394.h>
#include <dc1394/log.h>

#include <ctime>

namespace lakshya {
namespace {

constexpr dc1394video_mode_t kMode = DC1394_VIDEO_MODE_FORMAT7_3;

class Dc1394Camera final : public IidcCamera {
 public:
  // The library prints what its functions answer anyway, also while a camera is only looked for again.
  Dc1394Camera() {
    (void)dc1394_log_register_handler(DC1394_LOG_ERROR, nullptr, nullptr);
    (void)dc1394_log_register_handler(DC1394_LOG_WARNING, nullptr, nullptr);
  }
  ~Dc1394Camera() override { stop_all(); }
  Dc1394Camera(const Dc1394Camera&) = delete;
  Dc1394Camera& operator=(const Dc1394Camera&) = delete;

  Status start(const IidcRequest& request, Problem& problem) override;
  void stop() override { stop_all(); }
  int fd() const override { return camera_ != nullptr ? dc1394_capture_get_fileno(camera_) : -1; }
  Status fetch(IidcFrame& frame) override;

 private:
  Status find(std::uint64_t guid, Problem& problem);
  Status fail(Status status, dc1394error_t error, const char* doing, Problem& problem);
  void stop_all();

  dc1394_t* library_ = nullptr;
  dc1394camera_t* camera_ = nullptr;
  bool capturing_ = false;
  dc1394video_frame_t* held_ = nullptr;
};

Status Dc1394Camera::fail(Status status, dc1394error_t error, const char* doing, Problem& problem) {
  problem.set("IEEE 1394: %s: %s", doing, dc1394_error_get_string(error));
  stop_all();
  return status;
}

Status Dc1394Camera::find(std::uint64_t guid, Problem& problem) {
  library_ = dc1394_new();
  if (library_ == nullptr) {
    problem.set("IEEE 1394: no bus, or no permission");
    return Status::disconnected;
  }
  if (guid == 0) {
    dc1394camera_list_t* list = nullptr;
    const dc1394error_t error = dc1394_camera_enumerate(library_, &list);
    if (error != DC1394_SUCCESS) return fail(Status::disconnected, error, "cameras cannot be listed", problem);
    if (list->num > 0) guid = list->ids[0].guid;
    dc1394_camera_free_list(list);
  }
  if (guid != 0) camera_ = dc1394_camera_new(library_, guid);
  if (camera_ == nullptr) {
    if (guid == 0) {
      problem.set("IEEE 1394: no camera on the bus");
    } else {
      problem.set("IEEE 1394: no camera %016llx", static_cast<unsigned long long>(guid));
    }
    stop_all();
    return Status::disconnected;
  }
  return Status::ok;
}

Status Dc1394Camera::start(const IidcRequest& request, Problem& problem) {
  stop_all();
  const Status found = find(request.guid, problem);
  if (found != Status::ok) return found;
  // The legacy mode and its 400 Mbit/s are what every one of these cameras has; a Bumblebee XB3 has 800 too.
  const bool fast = camera_->bmode_capable == DC1394_TRUE &&
                    dc1394_video_set_operation_mode(camera_, DC1394_OPERATION_MODE_1394B) == DC1394_SUCCESS;
  dc1394error_t error = dc1394_video_set_iso_speed(camera_, fast ? DC1394_ISO_SPEED_800 : DC1394_ISO_SPEED_400);
  if (error != DC1394_SUCCESS) return fail(Status::refused, error, "bus speed", problem);
  error = dc1394_video_set_mode(camera_, kMode);
  if (error != DC1394_SUCCESS) return fail(Status::unsupported, error, "Format7 mode 3", problem);
  const std::int32_t packet = request.packet_bytes > 0 ? request.packet_bytes : DC1394_USE_RECOMMENDED;
  error = dc1394_format7_set_roi(camera_, kMode, DC1394_COLOR_CODING_RAW16, packet, 0, 0, request.width,
                                 request.height);
  if (error != DC1394_SUCCESS) {  // grey heads call it MONO16
    error = dc1394_format7_set_roi(camera_, kMode, DC1394_COLOR_CODING_MONO16, packet, 0, 0, request.width,
                                   request.height);
  }
  if (error != DC1394_SUCCESS) return fail(Status::unsupported, error, "size, or 16 bits per pixel", problem);
  error = dc1394_capture_setup(camera_, static_cast<std::uint32_t>(request.buffers), DC1394_CAPTURE_FLAGS_DEFAULT);
  if (error != DC1394_SUCCESS) return fail(Status::refused, error, "capture", problem);
  capturing_ = true;
  error = dc1394_video_set_transmission(camera_, DC1394_ON);
  if (error != DC1394_SUCCESS) return fail(Status::refused, error, "does not start", problem);
  return Status::ok;
}

void Dc1394Camera::stop_all() {
  held_ = nullptr;  // its memory goes with the capture
  if (capturing_) {
    (void)dc1394_video_set_transmission(camera_, DC1394_OFF);
    (void)dc1394_capture_stop(camera_);
    capturing_ = false;
  }
  if (camera_ != nullptr) dc1394_camera_free(camera_);
  camera_ = nullptr;
  if (library_ != nullptr) dc1394_free(library_);
  library_ = nullptr;
}

// The library stamps with the time of day, in microseconds.
Nanoseconds age_of(std::uint64_t stamp_us) {
  timespec now{};
  clock_gettime(CLOCK_REALTIME, &now);
  return Nanoseconds{now.tv_sec} * kSecond + now.tv_nsec - static_cast<Nanoseconds>(stamp_us) * 1000;
}

Status Dc1394Camera::fetch(IidcFrame& frame) {
  if (!capturing_) return Status::disconnected;
  dc1394video_frame_t* next = nullptr;
  // The last one is given back only when there is a next one: it is what the caller has, as long as there is none.
  if (dc1394_capture_dequeue(camera_, DC1394_CAPTURE_POLICY_POLL, &next) != DC1394_SUCCESS)
    return Status::disconnected;
  if (next == nullptr) return Status::timeout;
  if (held_ != nullptr && dc1394_capture_enqueue(camera_, held_) != DC1394_SUCCESS) return Status::disconnected;
  held_ = next;
  frame.bytes = {next->image, next->image_bytes};
  frame.width = static_cast<int>(next->size[0]);
  frame.height = static_cast<int>(next->size[1]);
  frame.bytes_per_line = next->stride != 0 ? next->stride : std::size_t{2} * next->size[0];
  frame.age = age_of(next->timestamp);
  frame.torn = dc1394_capture_is_frame_corrupt(camera_, next) == DC1394_TRUE;
  return Status::ok;
}

}  // namespace

std::unique_ptr<IidcCamera> make_dc1394_camera() {
  return std::make_unique<Dc1394Camera>();
}

}  // namespace lakshya

#else

namespace lakshya {
namespace {

class NoDc1394 final : public IidcCamera {
 public:
  Status start(const IidcRequest& /*request*/, Problem& problem) override {
    problem.set("IEEE 1394: built without libdc1394");
    return Status::unsupported;
  }
  void stop() override {}
  int fd() const override { return -1; }
  Status fetch(IidcFrame& /*frame*/) override { return Status::disconnected; }
};

}  // namespace

std::unique_ptr<IidcCamera> make_dc1394_camera() {
  return std::make_unique<NoDc1394>();
}

}  // namespace lakshya

#endif
