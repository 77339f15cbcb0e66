// How the kernel writes numbers of its industrial I/O devices in sysfs (Documentation/ABI/testing/sysfs-bus-iio).
#pragma once

#include <string_view>

#include "hal/compass/matrix3.h"
#include "kernels/base/status.h"

namespace lakshya {

// Without spaces and line ends around it.
std::string_view without_blanks(std::string_view text);

// "-123\n", "0.001500000". bad_data: anything else, or not finite.
Status parse_iio_number(std::string_view text, double& value);

// A mount matrix, row by row: "0, 1, 0; -1, 0, 0; 0, 0, 1". bad_data: anything else.
Status parse_iio_matrix(std::string_view text, Matrix3& matrix);

}  // namespace lakshya
