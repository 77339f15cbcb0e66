// An emergency stop in a file: for tests, and for a switch of one's own, whose program or kernel driver writes it
// (the `value` of a GPIO in sysfs, say). Its first byte is 1 when pressed and 0 when released.
#pragma once

#include <string>

#include "hal/estop.h"
#include "hal/linux/system_calls.h"

namespace lakshya {

struct FileEstopSettings {
  std::string path;  // on a file system of this machine: one on a network may wait
};

// The file is opened for every reading: one that stays open would go on saying what it said after somebody has
// replaced or deleted it. A file that is empty while somebody writes it is bad data, and so pressed: write a new
// one and rename it. A writer that has died is not seen.
class FileEstop final : public EmergencyStop {
 public:
  explicit FileEstop(FileEstopSettings settings, SystemCalls& system = linux_system_calls());
  FileEstop(const FileEstop&) = delete;
  FileEstop& operator=(const FileEstop&) = delete;

  // Reads it once. bad_argument: no path.
  Status open() override;
  void close() override { is_open_ = false; }
  // bad_readings, disconnections (readings without a file)
  std::span<const Counter> counters() const override { return counters_; }

  // disconnected: no file, or it cannot be read; bad_data: its first byte is neither. A file that comes back is
  // read again.
  Status read(bool& pressed) override;

 private:
  const FileEstopSettings settings_;
  SystemCalls* system_;
  bool is_open_ = false;
  Counter counters_[2] = {{"bad_readings"}, {"disconnections"}};
};

}  // namespace lakshya
