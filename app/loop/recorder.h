// What a run leaves in a folder: decisions.jsonl, a line for every plan, and pictures of the map.
#pragma once

#include <string>

#include "app/core/vehicle_config.h"
#include "app/loop/messages.h"

namespace lakshya {

class Recorder {
 public:
  // An empty folder name records nothing. Throws InputError where the folder cannot be made or written.
  // picture_every: a map picture for every so many plans; 0: none. keeps_old: decisions.jsonl of a run before becomes
  // decisions.1.jsonl, .2. and so on; else it is replaced.
  Recorder(const std::string& folder, std::uint64_t picture_every, bool keeps_old = false);
  ~Recorder();
  Recorder(const Recorder&) = delete;
  Recorder& operator=(const Recorder&) = delete;

  bool is_on() const { return fd_ >= 0; }
  bool wants_picture(std::uint64_t number) const {
    return is_on() && picture_every_ > 0 && number >= next_picture_;
  }

  // False: it could not be written; from then on nothing more is, and problem() says why.
  bool write(const Decision& decision, Nanoseconds start);
  bool write_map(ImageView<const std::uint8_t> type, const PlanNote& plan, const VehicleConfig& config);

  // After a failure: from now on there is room again.
  void try_again() { failed_ = false; }

  bool has_failed() const { return failed_; }
  const std::string& problem() const { return problem_; }
  const std::string& folder() const { return folder_; }

 private:
  void fail(const std::string& why);

  std::string folder_;
  std::uint64_t picture_every_;
  std::uint64_t next_picture_ = 0;
  int fd_ = -1;
  bool failed_ = false;
  std::string problem_;
};

// A line of decisions.jsonl, with its end. Times are seconds since `start`; what is no number is null.
std::string decision_line(const Decision& decision, Nanoseconds start);

}  // namespace lakshya
