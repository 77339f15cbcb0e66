// The one status type of kernels and drivers: no exceptions below app/core.
#pragma once

#include <cstdint>

namespace lakshya {

enum class [[nodiscard]] Status : std::uint8_t{
    ok,
    size_mismatch,      // two images or tables that must agree in size do not
    bad_argument,       // a parameter is outside the range that the header states
    scratch_too_small,  // the caller's scratch is smaller than the header's function says
    timeout,            // a device gave nothing, or took nothing, in the time allowed
    bad_data,           // a device gave something that is not what its manual says
    disconnected,       // a device is not there, or no longer
    refused,            // a device answered that it will not (a nak), or a limit of the driver forbids it
    unsupported,        // a device cannot do that
    end_of_data,        // a recording is over
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
    case Status::timeout:
      return "timeout";
    case Status::bad_data:
      return "bad data";
    case Status::disconnected:
      return "disconnected";
    case Status::refused:
      return "refused";
    case Status::unsupported:
      return "unsupported";
    case Status::end_of_data:
      return "end of data";
  }
  return "unknown status";
}

}  // namespace lakshya
