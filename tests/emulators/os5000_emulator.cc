// An OS5000 compass on a pseudo-terminal, to try a driver by hand: prints the terminal's path and runs until it is interrupted.
#include <getopt.h>

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <string_view>

#include "tests/emulators/on_terminal.h"
#include "tests/emulators/os5000_device.h"

namespace {

using lakshya::emulator::Os5000Device;

constexpr const char* kUsage =
    "usage: os5000_emulator [--rate HZ] [--heading DEG] [--turn DPS] [--format C|OHPR|HCHDT]\n"
    "                       [--wrong-checksum-every N] [--garbage-every N] [--split] [--merge] [--silent]\n"
    "                       [--help]\n";

bool set_format(Os5000Device& device, std::string_view name) {
  if (name == "C") {
    device.format = Os5000Device::Format::tagged;
  } else if (name == "OHPR") {
    device.format = Os5000Device::Format::by_place;
  } else if (name == "HCHDT") {
    device.format = Os5000Device::Format::true_heading;
  } else {
    return false;
  }
  return true;
}

bool read_number(const char* text, double low, double high, double& value) {
  char* end = nullptr;
  value = std::strtod(text, &end);
  return end != text && *end == '\0' && value >= low && value <= high;
}

bool read_count(const char* text, int low, int high, int& count) {
  double value = 0;
  if (!read_number(text, low, high, value) || value != static_cast<int>(value)) return false;
  count = static_cast<int>(value);
  return true;
}

bool set_option(Os5000Device& device, int option, const char* text) {
  constexpr int kMost = 1'000'000;
  switch (option) {
    case 'r':
      return read_count(text, -50, 40, device.rate_hz);
    case 'd':
      return read_number(text, 0, 360, device.heading_deg);
    case 't':
      return read_number(text, -720, 720, device.turn_dps);
    case 'f':
      return set_format(device, text);
    case 'w':
      return read_count(text, 0, kMost, device.wrong_checksum_every);
    case 'g':
      return read_count(text, 0, kMost, device.garbage_every);
    case 's':
      return device.split = true;
    case 'm':
      return device.merge = true;
    case 'q':
      return device.silent = true;
    default:
      return false;
  }
}

bool set_options(Os5000Device& device, int& help, int count, char** arguments) {
  const option options[] = {{"rate", required_argument, nullptr, 'r'},
                            {"heading", required_argument, nullptr, 'd'},
                            {"turn", required_argument, nullptr, 't'},
                            {"format", required_argument, nullptr, 'f'},
                            {"wrong-checksum-every", required_argument, nullptr, 'w'},
                            {"garbage-every", required_argument, nullptr, 'g'},
                            {"split", no_argument, nullptr, 's'},
                            {"merge", no_argument, nullptr, 'm'},
                            {"silent", no_argument, nullptr, 'q'},
                            {"help", no_argument, &help, 1},
                            {nullptr, 0, nullptr, 0}};
  for (int option = 0; (option = getopt_long(count, arguments, "", options, nullptr)) != -1;) {
    if (option != 0 && !set_option(device, option, optarg)) return false;
  }
  return optind == count;
}

}  // namespace

int main(int count, char** arguments) {
  Os5000Device device;
  int help = 0;
  if (!set_options(device, help, count, arguments)) {
    std::fputs(kUsage, stderr);
    return 2;
  }
  if (help != 0) {
    std::fputs(kUsage, stdout);
    return 0;
  }
  // Blocked before the emulator's thread starts, so that only sigwait() sees them.
  sigset_t ends;
  sigemptyset(&ends);
  sigaddset(&ends, SIGINT);
  sigaddset(&ends, SIGTERM);
  pthread_sigmask(SIG_BLOCK, &ends, nullptr);
  const lakshya::emulator::OnTerminal terminal(device);
  std::printf("%s\n", terminal.device().c_str());
  std::fflush(stdout);
  int signal = 0;
  sigwait(&ends, &signal);
  return 0;
}
