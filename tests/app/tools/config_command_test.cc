#include "app/tools/config_command.h"

#include <gtest/gtest.h>

#include <CLI/CLI.hpp>
#include <iostream>
#include <sstream>
#include <string>
#include <vector>

#include "app/core/input_error.h"
#include "app/core/vehicle_config_file.h"
#include "app/core/vehicle_config_text.h"

namespace lakshya {
namespace {

// What `lakshya config ARGS` prints. Restores std::cout also when the command throws.
class Printed {
 public:
  Printed() : before_(std::cout.rdbuf(text_.rdbuf())) {}
  ~Printed() { std::cout.rdbuf(before_); }
  Printed(const Printed&) = delete;
  Printed& operator=(const Printed&) = delete;
  std::string text() const { return text_.str(); }

 private:
  std::ostringstream text_;
  std::streambuf* before_;
};

std::string run(std::vector<std::string> args) {
  CLI::App app;
  add_config_command(app);
  args.insert(args.begin(), "config");
  std::vector<std::string> reversed(args.rbegin(), args.rend());  // CLI11 takes the last first
  const Printed printed;
  app.parse(reversed);
  return printed.text();
}

TEST(ConfigCommand, WithoutOptionsPrintsTheDocumentedDefaults) {
  EXPECT_EQ(run({}), documented_yaml());
}

TEST(ConfigCommand, PrintsTheTable) {
  EXPECT_EQ(run({"--markdown"}), markdown_table());
}

TEST(ConfigCommand, PrintsEffectiveValues) {
  const std::vector<std::string> sets{"camera.height_m=0.45", "grid.rows=150"};
  EXPECT_EQ(run({"--profile", "indoor", "--set", sets[0], "--set", sets[1]}),
            effective_yaml(load_vehicle_config("", "indoor", sets)));
}

TEST(ConfigCommand, RefusesWhatTheLoaderRefuses) {
  EXPECT_THROW(run({"--set", "camera.height_m=9"}), InputError);
  EXPECT_THROW(run({"--profile", "forest"}), InputError);
  EXPECT_THROW(run({"--config", "no-such-folder/vehicle.yaml"}), InputError);
}

TEST(ConfigCommand, WrongUseIsAParseError) {
  EXPECT_THROW(run({"--markdown", "--profile", "indoor"}), CLI::ParseError);
  EXPECT_THROW(run({"--set", "camera.height_m=0.4", "camera.left_m=0.4"}), CLI::ParseError);
  EXPECT_THROW(run({"--profile"}), CLI::ParseError);
}

}  // namespace
}  // namespace lakshya
