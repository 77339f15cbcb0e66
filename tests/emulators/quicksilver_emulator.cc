// Emulated QuickSilver drives on a pseudo-terminal, to be started by hand: prints the terminal's path first.
#include <getopt.h>

#include <charconv>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <string>
#include <string_view>
#include <system_error>
#include <thread>
#include <vector>

#include "tests/emulators/on_terminal.h"
#include "tests/emulators/quicksilver_drive.h"

namespace lakshya::emulator {
namespace {

volatile std::sig_atomic_t stopped = 0;

constexpr const char* kUsage =
    "usage: quicksilver_emulator [OPTION...]\n"
    "  --addresses A,B,...          of the drives (16,17)\n"
    "  --resident-program yes|no    runs from power-up (yes)\n"
    "  --nak-every N                every Nth command is answered busy\n"
    "  --silent-every N             every Nth command is carried out and not answered\n"
    "  --garbage-every N            every Nth reply comes after a damaged line\n"
    "  --split                      replies come in two pieces\n"
    "  --merge                      replies come in one piece with a repetition\n"
    "  --slow-ms N                  replies come so much later\n"
    "  --checksum-errors            every command is answered bad checksum\n"
    "  --state-every MS             print the drives' states\n"
    "  --help                       this text\n";

struct Options {
  std::vector<int> addresses = {16, 17};
  bool resident_program = true;
  int nak_every = 0;
  int silent_every = 0;
  int garbage_every = 0;
  int split = 0;
  int merge = 0;
  int slow_ms = 0;
  int checksum_errors = 0;
  int state_every_ms = 0;
  int help = 0;
};

bool read_number(std::string_view text, int lowest, int& number) {
  const char* end = text.data() + text.size();
  const auto [stopped_at, error] = std::from_chars(text.data(), end, number);
  return error == std::errc() && stopped_at == end && number >= lowest;
}

bool read_addresses(std::string_view text, std::vector<int>& addresses) {
  addresses.clear();
  while (true) {
    const std::size_t comma = text.find(',');
    int address = 0;
    if (!read_number(text.substr(0, comma), 1, address) || address > 255) return false;
    addresses.push_back(address);
    if (comma == std::string_view::npos) return true;
    text.remove_prefix(comma + 1);
  }
}

bool read_yes_no(std::string_view text, bool& yes) {
  yes = text == "yes";
  return yes || text == "no";
}

bool take(int option, std::string_view value, Options& options) {
  switch (option) {
    case 'a':
      return read_addresses(value, options.addresses);
    case 'r':
      return read_yes_no(value, options.resident_program);
    case 'n':
      return read_number(value, 0, options.nak_every);
    case 's':
      return read_number(value, 0, options.silent_every);
    case 'g':
      return read_number(value, 0, options.garbage_every);
    case 'l':
      return read_number(value, 0, options.slow_ms);
    case 't':
      return read_number(value, 0, options.state_every_ms);
    default:
      return false;
  }
}

bool read_options(int argc, char** argv, Options& options) {
  const option known[] = {{"addresses", required_argument, nullptr, 'a'},
                          {"resident-program", required_argument, nullptr, 'r'},
                          {"nak-every", required_argument, nullptr, 'n'},
                          {"silent-every", required_argument, nullptr, 's'},
                          {"garbage-every", required_argument, nullptr, 'g'},
                          {"split", no_argument, &options.split, 1},
                          {"merge", no_argument, &options.merge, 1},
                          {"slow-ms", required_argument, nullptr, 'l'},
                          {"checksum-errors", no_argument, &options.checksum_errors, 1},
                          {"state-every", required_argument, nullptr, 't'},
                          {"help", no_argument, &options.help, 1},
                          {nullptr, 0, nullptr, 0}};
  for (int found = 0; (found = getopt_long(argc, argv, "", known, nullptr)) != -1;) {
    if (found != 0 && !take(found, optarg == nullptr ? "" : optarg, options)) return false;
  }
  return optind == argc;
}

void print_states(QuickSilverLine& line, OnTerminal& terminal) {
  std::vector<QuickSilverState> states;
  {
    const auto lock = terminal.locked();
    for (std::size_t i = 0; i < line.drives(); ++i)
      states.push_back(line.state(i, monotonic_ns()));
  }
  for (const QuickSilverState& state : states) {
    std::printf("drive %d: position %.0f, %.1f rpm, program %s%s, %d trips, %d commands, %d naks\n", state.address,
                state.position, state.velocity_rpm, state.program_runs ? "runs" : "does not run",
                state.tripped ? " (tripped)" : "", state.trips, state.commands, state.naks);
  }
  std::fflush(stdout);
}

void run(const Options& options) {
  QuickSilverLine line(options.addresses, {.at_power_up = options.resident_program});
  line.nak_every = options.nak_every;
  line.silent_every = options.silent_every;
  line.garbage_every = options.garbage_every;
  line.split = options.split != 0;
  line.merge = options.merge != 0;
  line.slow_ns = options.slow_ms * std::int64_t{1'000'000};
  line.checksum_errors = options.checksum_errors != 0;
  OnTerminal terminal(line);
  std::printf("%s\n", terminal.device().c_str());
  std::fflush(stdout);
  std::int64_t next_ns = monotonic_ns();
  while (stopped == 0) {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
    if (options.state_every_ms == 0 || monotonic_ns() < next_ns) continue;
    print_states(line, terminal);
    next_ns += options.state_every_ms * std::int64_t{1'000'000};
  }
}

}  // namespace
}  // namespace lakshya::emulator

int main(int argc, char** argv) {
  lakshya::emulator::Options options;
  if (!lakshya::emulator::read_options(argc, argv, options)) {
    std::fputs(lakshya::emulator::kUsage, stderr);
    return 2;
  }
  if (options.help != 0) {
    std::fputs(lakshya::emulator::kUsage, stdout);
    return 0;
  }
  std::signal(SIGINT, [](int) { lakshya::emulator::stopped = 1; });
  std::signal(SIGTERM, [](int) { lakshya::emulator::stopped = 1; });
  lakshya::emulator::run(options);
  return 0;
}
