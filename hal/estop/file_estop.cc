#include "hal/estop/file_estop.h"

#include <fcntl.h>

#include <cstring>
#include <utility>

namespace lakshya {
namespace {

enum CounterIndex : std::size_t { kBadReadings, kDisconnections };

}  // namespace

FileEstop::FileEstop(FileEstopSettings settings, SystemCalls& system)
    : settings_(std::move(settings)), system_(&system) {}

Status FileEstop::open() {
  close();
  if (settings_.path.empty()) {
    problem_.set("emergency stop: no path of a file");
    return Status::bad_argument;
  }
  is_open_ = true;
  bool pressed = true;
  const Status status = read(pressed);
  is_open_ = status == Status::ok;
  return status;
}

Status FileEstop::read(bool& pressed) {
  pressed = true;
  if (!is_open_) return Status::disconnected;
  char first = '\0';
  long got = system_->open(settings_.path.c_str(), O_RDONLY);
  if (got >= 0) {
    const int fd = static_cast<int>(got);
    got = system_->read_at_start(fd, {&first, 1});
    (void)system_->close(fd);
  }
  if (got < 0) {
    ++counters_[kDisconnections].value;
    problem_.set("%s: %s", settings_.path.c_str(), strerrordesc_np(static_cast<int>(-got)));
    return Status::disconnected;
  }
  if (got == 0 || (first != '0' && first != '1')) {
    ++counters_[kBadReadings].value;
    problem_.set("%s: begins with neither 0 nor 1", settings_.path.c_str());
    return Status::bad_data;
  }
  pressed = first == '1';
  return Status::ok;
}

}  // namespace lakshya
