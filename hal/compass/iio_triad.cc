#include "hal/compass/iio_triad.h"

#include <fcntl.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <iterator>

#include "hal/compass/iio_text.h"

namespace lakshya {
namespace {

using Path = std::array<char, 320>;

Path joined(const char* folder, const char* name) {
  Path path{};
  std::snprintf(path.data(), path.size(), "%s/%s", folder, name);
  return path;
}

bool is_gone(int error) {
  return error == ENODEV || error == ENXIO || error == EREMOTEIO;
}

constexpr char kAxes[] = {'x', 'y', 'z'};

}  // namespace

std::string_view read_attribute(SystemCalls& calls, const char* folder, const char* name, std::span<char> buffer,
                                int& error) {
  const int fd = calls.open(joined(folder, name).data(), O_RDONLY);
  error = fd < 0 ? -fd : 0;
  if (fd < 0) return {};
  const long size = calls.read_at_start(fd, buffer);
  (void)calls.close(fd);
  if (size < 0) error = static_cast<int>(-size);
  return size < 0 ? std::string_view() : std::string_view(buffer.data(), static_cast<std::size_t>(size));
}

bool IioTriad::exists(const char* folder, const char* channel) {
  std::array<char, 64> name{};
  std::snprintf(name.data(), name.size(), "in_%s_x_raw", channel);
  const int fd = calls_->open(joined(folder, name.data()).data(), O_RDONLY);
  if (fd >= 0) (void)calls_->close(fd);
  return fd != -ENOENT;
}

Status IioTriad::open_axis(std::size_t axis, const char* folder, const char* channel, Problem& problem) {
  std::array<char, 64> name{};
  std::array<char, 64> text{};
  int error = 0;
  std::snprintf(name.data(), name.size(), "in_%s_%c_scale", channel, kAxes[axis]);
  std::string_view scale = read_attribute(*calls_, folder, name.data(), text, error);
  if (error != 0) {
    std::snprintf(name.data(), name.size(), "in_%s_scale", channel);
    scale = read_attribute(*calls_, folder, name.data(), text, error);
  }
  if (error != 0 || parse_iio_number(scale, scale_[axis]) != Status::ok || scale_[axis] == 0) {
    problem.set("%s/%s: no scale", folder, name.data());
    return Status::unsupported;
  }
  std::snprintf(name.data(), name.size(), "in_%s_%c_raw", channel, kAxes[axis]);
  const int fd = calls_->open(joined(folder, name.data()).data(), O_RDONLY);
  if (fd < 0) {
    problem.set("%s/%s: %s", folder, name.data(), strerrordesc_np(-fd));
    return fd == -ENOENT ? Status::unsupported : Status::disconnected;
  }
  raw_[axis] = fd;
  return Status::ok;
}

Status IioTriad::read_mount(const char* folder, const char* channel, Problem& problem) {
  std::array<char, 64> own{};
  std::snprintf(own.data(), own.size(), "in_%s_mount_matrix", channel);
  mount_ = kIdentity3;
  for (const char* const name : {static_cast<const char*>(own.data()), "in_mount_matrix", "mount_matrix"}) {
    std::array<char, 256> text{};
    int error = 0;
    const std::string_view matrix = read_attribute(*calls_, folder, name, text, error);
    if (error != 0) continue;
    if (parse_iio_matrix(matrix, mount_) == Status::ok && is_rotation(mount_)) return Status::ok;
    problem.set("%s/%s: is no rotation", folder, name);
    return Status::unsupported;
  }
  return Status::ok;
}

Status IioTriad::open(const char* folder, const char* channel, Problem& problem) {
  close();
  std::snprintf(place_.data(), place_.size(), "%s/in_%s", folder, channel);
  Status status = read_mount(folder, channel, problem);
  for (std::size_t axis = 0; axis < std::size(kAxes) && status == Status::ok; ++axis)
    status = open_axis(axis, folder, channel, problem);
  if (status != Status::ok) close();
  return status;
}

void IioTriad::close() {
  for (int& fd : raw_) {
    if (fd >= 0) (void)calls_->close(fd);
    fd = -1;
  }
}

Status IioTriad::read(Vector3& raw, Vector3& value, Problem& problem) {
  for (std::size_t axis = 0; axis < std::size(kAxes); ++axis) {
    std::array<char, 64> text{};
    const long size = calls_->read_at_start(raw_[axis], text);
    if (size < 0) {
      problem.set("%s_%c_raw: %s", place_.data(), kAxes[axis], strerrordesc_np(static_cast<int>(-size)));
      return is_gone(static_cast<int>(-size)) ? Status::disconnected : Status::bad_data;
    }
    if (parse_iio_number({text.data(), static_cast<std::size_t>(size)}, raw[axis]) != Status::ok) {
      problem.set("%s_%c_raw: no number", place_.data(), kAxes[axis]);
      return Status::bad_data;
    }
  }
  value = mount_ * Vector3{raw[0] * scale_[0], raw[1] * scale_[1], raw[2] * scale_[2]};
  return Status::ok;
}

}  // namespace lakshya
