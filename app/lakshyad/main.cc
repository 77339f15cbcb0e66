
#include <CLI/CLI.hpp>

#include "app/lakshyad/program.h"
#include "app/lakshyad/run_command.h"
#include "app/lakshyad/self_test_command.h"
#include "app/lakshyad/stop_motors_command.h"

int main(int argc, char** argv) {
  return lakshya::run_program("lakshyad", argc, argv, [argv](CLI::App& app) {
    app.description("Lakshya's firmware: stereo camera in, safe steering out.");
    app.set_version_flag("--version", "lakshyad " LAKSHYA_VERSION);
    lakshya::add_run_command(app, argv);
    lakshya::add_replay_command(app, argv);
    lakshya::add_stop_motors_command(app);
    lakshya::add_self_test_command(app);
  });
}
