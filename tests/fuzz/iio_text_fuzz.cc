#include <cmath>
#include <cstdlib>
#include <string>

#include "app/core/input_error.h"
#include "hal/compass/iio_text.h"
#include "tests/fuzz/fuzz.h"

namespace lakshya::fuzz {

void read(Bytes bytes) {
  const std::string text = text_of(bytes);
  double number = 0;
  Matrix3 matrix{};
  const bool is_number = parse_iio_number(text, number) == Status::ok;
  const bool is_matrix = parse_iio_matrix(text, matrix) == Status::ok;
  if (!std::isfinite(number) || (is_number && is_matrix)) std::abort();
  for (const double value : matrix) {
    if (is_matrix && !std::isfinite(value)) std::abort();
  }
  (void)is_rotation(matrix);
  if (!is_number && !is_matrix) throw InputError("fuzz", "neither a number nor a matrix");
}

std::vector<std::string> seeds() {
  return {"-123\n", "0.000149536\n", "0, 1, 0; -1, 0, 0; 0, 0, 1\n"};
}

}  // namespace lakshya::fuzz
