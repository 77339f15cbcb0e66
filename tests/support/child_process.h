// A program of ours that runs beside the test, to be signalled and watched.
#pragma once

#include <fcntl.h>
#include <signal.h>  // kill is POSIX
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <string>
#include <thread>
#include <vector>

#include "tests/support/run_command.h"

namespace lakshya {

// The firmware that LAKSHYAD_BIN names; empty when there is none.
inline std::string lakshyad_binary() {
  const char* binary = std::getenv("LAKSHYAD_BIN");
  return binary != nullptr && std::filesystem::exists(binary) ? binary : "";
}

class ChildProcess {
 public:
  // Program and arguments; what it prints goes into files.
  explicit ChildProcess(const std::vector<std::string>& words) {
    std::vector<char*> arguments;
    for (const std::string& word : words)
      arguments.push_back(const_cast<char*>(word.c_str()));
    arguments.push_back(nullptr);
    const std::string out = folder_.path("out");
    const std::string err = folder_.path("err");
    pid_ = fork();
    if (pid_ != 0) return;
    const int out_fd = ::open(out.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0600);
    const int err_fd = ::open(err.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0600);
    dup2(out_fd, STDOUT_FILENO);
    dup2(err_fd, STDERR_FILENO);
    execv(arguments[0], arguments.data());
    _exit(127);
  }
  ~ChildProcess() {
    if (pid_ <= 0) return;
    (void)::kill(pid_, SIGKILL);
    (void)::waitpid(pid_, nullptr, 0);
  }
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  void signal(int number) const { (void)::kill(pid_, number); }
  pid_t pid() const { return pid_; }

  // The exit code; 128 and the signal's number where one ended it; -1: it still runs.
  int wait(int limit_ms) {
    for (int ms = 0; pid_ > 0 && ms <= limit_ms; ++ms) {
      int status = 0;
      if (::waitpid(pid_, &status, WNOHANG) == pid_) {
        pid_ = -1;
        return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    return -1;
  }

  std::string out() const { return bytes_of(folder_.path("out")); }
  std::string err() const { return bytes_of(folder_.path("err")); }

 private:
  TempFolder folder_;
  pid_t pid_ = -1;
};

}  // namespace lakshya
