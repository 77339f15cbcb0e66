#include "app/tools/sim_campaign.h"

#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <map>
#include <stdexcept>

#include "app/core/file_bytes.h"
#include "app/core/input_error.h"

namespace lakshya {
namespace {

using sim::RunResult;

std::string system_text(const char* what) {
  return std::string(what) + ": " + std::strerror(errno);
}

// What a child says: its result as a line, or "error: ...".
std::string read_to_end(int fd) {
  std::string text;
  char buffer[4096];
  for (;;) {
    const ssize_t got = ::read(fd, buffer, sizeof buffer);
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) return text;
    text.append(buffer, static_cast<std::size_t>(got));
  }
}

void write_all(int fd, const std::string& text) {
  for (std::size_t sent = 0; sent < text.size();) {
    const ssize_t n = ::write(fd, text.data() + sent, text.size() - sent);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return;
    sent += static_cast<std::size_t>(n);
  }
}

struct Child {
  pid_t pid = -1;
  int fd = -1;
  std::uint64_t seed = 0;
};

// One line is far less than a pipe holds, so that nobody waits for the reader.
Child start(std::uint64_t seed, const std::function<RunResult(std::uint64_t)>& drive) {
  int ends[2];
  if (::pipe(ends) != 0) throw InputError("campaign", system_text("no pipe"));
  std::cout << std::flush;
  std::cerr << std::flush;
  const pid_t pid = ::fork();
  if (pid < 0) throw InputError("campaign", system_text("no process"));
  if (pid > 0) {
    ::close(ends[1]);
    return {pid, ends[0], seed};
  }
  ::close(ends[0]);
  std::string line;
  try {
    line = run_json(drive(seed)).dump();
  } catch (const std::exception& e) {
    line = std::string("error: ") + e.what();
  }
  write_all(ends[1], line);
  ::_exit(0);
}

RunResult finish(const Child& child) {
  const std::string line = read_to_end(child.fd);
  ::close(child.fd);
  int status = 0;
  while (::waitpid(child.pid, &status, 0) < 0 && errno == EINTR) {
  }
  const std::string where = "seed " + std::to_string(child.seed);
  if (line.starts_with("error: ")) throw InputError(where, line.substr(7));
  if (line.empty())
    throw InputError(where, "the drive ended without a result (status " + std::to_string(status) + ")");
  return sim::run_from_json(nlohmann::ordered_json::parse(line));
}

std::map<std::uint64_t, RunResult> read_results(const std::string& path, const std::string& world,
                                                const std::string& sensor) {
  std::map<std::uint64_t, RunResult> results;
  std::ifstream file(path);
  int number = 0;
  for (std::string line; std::getline(file, line);) {
    ++number;
    const std::string where = path + ":" + std::to_string(number);
    // The last line of a campaign that was killed may be torn.
    const auto json = nlohmann::ordered_json::parse(line, nullptr, false);
    if (json.is_discarded() && file.eof()) break;
    try {
      if (json.contains("summary")) continue;
      RunResult result = sim::run_from_json(json);
      if (result.world != world || result.sensor != sensor)
        throw InputError(where, "is of world " + result.world + " and sensor " + result.sensor + ", not of " +
                                    world + " and " + sensor + " (name another file)");
      results.insert_or_assign(result.seed, std::move(result));
    } catch (const std::invalid_argument& e) {
      throw InputError(where, std::string("is no result of a drive: ") + e.what() + " (name another file)");
    }
  }
  return results;
}

class Campaign {
 public:
  Campaign(const CampaignSettings& settings, const std::string& world, const std::string& sensor)
      : settings_(settings) {
    if (settings.results.empty()) return;
    done_ = read_results(settings.results, world, sensor);
    file_.open(settings.results, std::ios::app);
    if (!file_) throw InputError(settings.results, system_text("cannot be written"));
  }

  std::vector<RunResult> run(const std::function<RunResult(std::uint64_t)>& drive,
                             const std::function<void(std::size_t, const RunResult&)>& progress) {
    for (const std::uint64_t seed : settings_.seeds) {
      if (done_.contains(seed)) {
        ++count_;
        continue;
      }
      if (children_.size() >= static_cast<std::size_t>(settings_.jobs)) collect(progress);
      children_.push_back(start(seed, drive));
    }
    while (!children_.empty())
      collect(progress);
    std::vector<RunResult> results;
    for (const std::uint64_t seed : settings_.seeds)
      results.push_back(done_.at(seed));
    return results;
  }

 private:
  // The one that ends next; whatever goes wrong, no child is left behind.
  void collect(const std::function<void(std::size_t, const RunResult&)>& progress) {
    siginfo_t ended{};
    while (::waitid(P_ALL, 0, &ended, WEXITED | WNOWAIT) < 0 && errno == EINTR) {
    }
    auto child = std::ranges::find(children_, ended.si_pid, &Child::pid);
    if (child == children_.end()) child = children_.begin();
    const Child finished = *child;
    children_.erase(child);
    try {
      RunResult result = finish(finished);
      if (file_.is_open()) file_ << run_json(result).dump() << '\n' << std::flush;
      progress(++count_, result);
      done_.insert_or_assign(finished.seed, std::move(result));
    } catch (...) {
      for (const Child& other : children_) {
        (void)read_to_end(other.fd);
        ::close(other.fd);
        (void)::waitpid(other.pid, nullptr, 0);
      }
      children_.clear();
      throw;
    }
  }

  const CampaignSettings& settings_;
  std::map<std::uint64_t, RunResult> done_;
  std::ofstream file_;
  std::vector<Child> children_;
  std::size_t count_ = 0;
};

}  // namespace

std::vector<RunResult> run_campaign(const CampaignSettings& settings, const std::string& world,
                                    const std::string& sensor, const std::function<RunResult(std::uint64_t)>& drive,
                                    const std::function<void(std::size_t, const RunResult&)>& progress) {
  return Campaign(settings, world, sensor).run(drive, progress);
}

}  // namespace lakshya
