#include <CLI/CLI.hpp>

#include "app/lakshyad/program.h"
#include "app/lakshyad/run_command.h"
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
#include "app/tools/sim_command.h"
#include "app/tools/soak_command.h"

int main(int argc, char** argv) {
  return lakshya::run_program("lakshya", argc, argv, [argv](CLI::App& app) {
    app.description("Lakshya: stereo camera in, safe steering out.");
    app.set_version_flag("--version", "lakshya " LAKSHYA_VERSION);
    app.footer(
        "Exit code: 0 done, 1 input refused, (compare) results differ or (soak) not passed, 2 wrong usage.\n"
        "Help on one command: lakshya COMMAND --help");
    lakshya::add_process_command(app);
    lakshya::add_plan_command(app);
    lakshya::add_run_command(app, argv);
    lakshya::add_replay_command(app, argv);
    lakshya::add_sim_command(app, argv);
    lakshya::add_eval_command(app);
    lakshya::add_accuracy_command(app);
    lakshya::add_compare_command(app);
    lakshya::add_profile_command(app);
    lakshya::add_bench_command(app);
    lakshya::add_soak_command(app, argv);
    lakshya::add_config_command(app);
    lakshya::add_devices_command(app);
    lakshya::add_compass_command(app);
  });
}
