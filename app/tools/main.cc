#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

#include <CLI/CLI.hpp>
#include <exception>

#include "app/core/input_error.h"
#include "app/tools/accuracy_command.h"
#include "app/tools/bench_command.h"
#include "app/tools/compare_command.h"
#include "app/tools/compass_command.h"
#include "app/tools/config_command.h"
#include "app/tools/devices_command.h"
#include "app/tools/eval_command.h"
#include "app/tools/plan_command.h"
#include "app/tools/process_command.h"
#include "app/tools/profile_command.h"

namespace {

constexpr int kOk = 0;
constexpr int kRefused = 1;
constexpr int kUsage = 2;

int run(int argc, char** argv) {
  CLI::App app{"Lakshya: stereo camera in, safe steering out."};
  app.name("lakshya");
  app.set_version_flag("--version", "lakshya " LAKSHYA_VERSION);
  app.require_subcommand(1);
  app.footer(
      "Exit code: 0 done, 1 input refused or (compare) results differ, 2 wrong usage.\n"
      "Help on one command: lakshya COMMAND --help");
  lakshya::add_process_command(app);
  lakshya::add_plan_command(app);
  lakshya::add_eval_command(app);
  lakshya::add_accuracy_command(app);
  lakshya::add_compare_command(app);
  lakshya::add_profile_command(app);
  lakshya::add_bench_command(app);
  lakshya::add_config_command(app);
  lakshya::add_devices_command(app);
  lakshya::add_compass_command(app);
  try {
    app.parse(argc, argv);
    return kOk;
  } catch (const CLI::RuntimeError& e) {  // a command's own verdict: compare
    return e.get_exit_code();
  } catch (const CLI::ParseError& e) {
    return app.exit(e) == 0 ? kOk : kUsage;
  } catch (const lakshya::InputError& e) {
    spdlog::error("{}", e.what());
    return kRefused;
  }
}

}  // namespace

int main(int argc, char** argv) {
  try {
    // Messages go to stderr, so that stdout holds results only.
    spdlog::set_default_logger(spdlog::stderr_color_mt("lakshya"));
    spdlog::set_pattern("%n: %^%l%$: %v");
    return run(argc, argv);
  } catch (const std::exception& e) {
    spdlog::critical("unexpected: {}", e.what());
    return kRefused;
  }
}
