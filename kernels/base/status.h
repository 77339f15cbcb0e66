// The one status type of kernels and drivers: no exceptions below app/core.
#pragma once

#include <cstdint>

namespace lakshya {

enum class [[nodiscard]] Status : std::uint8_t{
    ok,
    size_mismatch,      // two images or tables that must agree in size do not
    bad_argument,       // a parameter is outside the range that the header states
    scratch_too_small,  // the caller's scratch is smaller than the header's function says
};

constexpr const char* to_string(Status s) {
  switch (s) {
    case Status::ok:
      return "ok";
    case Status::size_mismatch:
      return "size mismatch";
    case Status::bad_argument:
      return "bad argument";
    case Status::scratch_too_small:
      return "scratch too small";
  }
  return "unknown status";
}

}  // namespace lakshya
