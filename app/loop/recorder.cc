#include "app/loop/recorder.h"

#include <fcntl.h>
#include <spdlog/fmt/fmt.h>
#include <unistd.h>

#include <cerrno>
#include <cmath>
#include <cstring>
#include <filesystem>

#include "app/core/image_file.h"
#include "app/core/input_error.h"
#include "app/loop/map_picture.h"
#include "hal/angle.h"

namespace lakshya {
namespace {

double seconds(Nanoseconds t) {
  return static_cast<double>(t) / static_cast<double>(kSecond);
}

double in_degrees(double rad) {
  return rad / kRadiansPerDegree;
}

// JSON has no infinity.
std::string number(double value, int digits) {
  return std::isfinite(value) ? fmt::format("{:.{}f}", value, digits) : "null";
}

// What a restart after a crash must not wipe out.
void keep_old(const std::string& folder, const std::string& path) {
  std::error_code ignored;
  if (std::filesystem::file_size(path, ignored) == 0 || ignored) return;
  int n = 1;
  while (std::filesystem::exists(fmt::format("{}/decisions.{}.jsonl", folder, n), ignored))
    ++n;
  std::filesystem::rename(path, fmt::format("{}/decisions.{}.jsonl", folder, n), ignored);
}

}  // namespace

std::string decision_line(const Decision& d, Nanoseconds start) {
  const PlanNote& p = d.plan;
  std::string line = fmt::format(
      R"({{"frame":{},"taken_s":{:.6f},"time_s":{:.6f},"latency_ms":{:.3f},"status":"{}","state":"{}","reason":"{}",)",
      p.number, seconds(p.taken - start), seconds(d.time - start), seconds(p.done - p.taken) * 1e3,
      to_string(p.status), to_string(d.state), d.reason == Event::all_well ? "" : to_string(d.reason));
  line += fmt::format(
      R"("target_deg":{},"blocked":{},"direction_deg":{},"recovery":"{}","clear_m":{},"clear_end":"{}",)"
      R"("speed_mps":{},"nearest_m":{},"obstacle_cells":{},"ground_pitch_deg":{},)",
      number(in_degrees(p.target), 3), p.blocked, number(in_degrees(p.direction), 3),
      p.recovery == Side::left ? "left" : "right", number(p.clear_m, 3),
      p.clear_end == ClearEnd::obstacle ? "obstacle" : "unknown", number(p.speed_mps, 4), number(p.nearest_m, 3),
      p.obstacles, number(p.ground_pitch_deg, 4));
  line +=
      fmt::format(R"("pose":{{"east_m":{},"north_m":{},"yaw_deg":{}}},"wheels":{{"left_mps":{},"right_mps":{}}}}})"
                  "\n",
                  number(d.pose.east_m, 4), number(d.pose.north_m, 4), number(in_degrees(d.pose.yaw), 3),
                  number(d.wheels.left_mps, 4), number(d.wheels.right_mps, 4));
  return line;
}

Recorder::Recorder(const std::string& folder, std::uint64_t picture_every, bool keeps_old)
    : folder_(folder), picture_every_(picture_every) {
  if (folder.empty()) return;
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) throw InputError(folder, "cannot be made: " + error.message() + " (choose another --out)");
  const std::string path = folder + "/decisions.jsonl";
  if (keeps_old) keep_old(folder, path);
  fd_ = ::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
  if (fd_ < 0)
    throw InputError(path, std::string("cannot be written: ") + std::strerror(errno) + " (choose another --out)");
}

Recorder::~Recorder() {
  if (fd_ >= 0) (void)::close(fd_);
}

void Recorder::fail(const std::string& why) {
  failed_ = true;
  problem_ = why;
}

bool Recorder::write(const Decision& decision, Nanoseconds start) {
  if (!is_on() || failed_) return !failed_;
  const std::string line = decision_line(decision, start);
  const ssize_t written = ::write(fd_, line.data(), line.size());
  if (written == static_cast<ssize_t>(line.size())) return true;
  fail(folder_ + "/decisions.jsonl: " + std::strerror(written < 0 ? errno : ENOSPC));
  // No half line stays.
  if (written > 0) {
    const off_t end = ::lseek(fd_, 0, SEEK_END);
    if (end >= written) (void)!::ftruncate(fd_, end - written);
  }
  return false;
}

bool Recorder::write_map(ImageView<const std::uint8_t> type, const PlanNote& plan, const VehicleConfig& config) {
  if (!is_on() || failed_) return !failed_;
  next_picture_ = plan.number + picture_every_;
  try {
    write_png(fmt::format("{}/map_{:06}.png", folder_, plan.number), loop_map_picture(type, plan, config).view());
  } catch (const InputError& e) {
    fail(e.what());
  }
  return !failed_;
}

}  // namespace lakshya
