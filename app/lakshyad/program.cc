#include "app/lakshyad/program.h"

#include <fcntl.h>
#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <csignal>
#include <exception>

#include "app/core/input_error.h"

namespace lakshya {
namespace {

constexpr int kOk = 0;
constexpr int kRefused = 1;
constexpr int kUsage = 2;

// Standard input, output and error exist, be it as nothing: else the drives' line would be opened as one of them and get the log.
void require_standard_streams() {
  for (int fd = STDIN_FILENO; fd <= STDERR_FILENO; ++fd) {
    if (fcntl(fd, F_GETFD) < 0) (void)!::open("/dev/null", fd == STDIN_FILENO ? O_RDONLY : O_WRONLY);
  }
}

int run(const char* name, int argc, char** argv, const std::function<void(CLI::App&)>& add_commands) {
  CLI::App app;
  app.name(name);
  app.require_subcommand(1);
  add_commands(app);
  try {
    app.parse(argc, argv);
    return kOk;
  } catch (const CLI::RuntimeError& e) {  // a command's own verdict: compare
    return e.get_exit_code();
  } catch (const CLI::ParseError& e) {
    return app.exit(e) == 0 ? kOk : kUsage;
  } catch (const InputError& e) {
    spdlog::error("{}", e.what());
    return kRefused;
  }
}

}  // namespace

int run_program(const char* name, int argc, char** argv, const std::function<void(CLI::App&)>& add_commands) {
  require_standard_streams();
  // Whoever read what is printed may go; the vehicle drives on.
  (void)std::signal(SIGPIPE, SIG_IGN);
  try {
    // Messages go to stderr, so that stdout holds results only.
    spdlog::set_default_logger(spdlog::stderr_color_mt(name));
    spdlog::set_pattern("%n: %^%l%$: %v");
    return run(name, argc, argv, add_commands);
  } catch (const std::exception& e) {
    spdlog::critical("unexpected: {}", e.what());
    return kRefused;
  }
}

}  // namespace lakshya
