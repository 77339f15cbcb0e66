// A kernel table whose matcher gives a disparity image that the test made, so that the rest of the real pipeline
// can be tested on exact disparities.
#pragma once

#include <algorithm>
#include <cstdint>

#include "app/core/kernel_table.h"
#include "kernels/base/image_view.h"

namespace lakshya::test {

// While one of these lives, pipelines made with kernels() "match" this image, whatever the pair shows. One at a
// time: kernels are plain functions and have no other place to find it.
class GivenDisparity {
 public:
  explicit GivenDisparity(ImageView<const std::int16_t> disparity) { given_ = disparity; }
  ~GivenDisparity() { given_ = {}; }
  GivenDisparity(const GivenDisparity&) = delete;
  GivenDisparity& operator=(const GivenDisparity&) = delete;

  static KernelTable kernels() {
    KernelTable table = kReferenceKernels;
    table.sgm = skip_matching;
    table.support = copy_given;
    return table;
  }

 private:
  // Deduced from the table's entry, whatever its parameters are.
  template <class... Arguments>
  static Status skip_matching(Arguments... /*unused*/) {
    return Status::ok;
  }
  static Status copy_given(ImageView<const std::int16_t> /*matched*/, const SupportParams& /*params*/, Rows rows,
                           ImageView<std::int16_t> out) {
    if (!same_size(given_, out)) return Status::size_mismatch;
    for (int v = rows.begin; v < rows.end; ++v)
      std::copy_n(given_.row(v), out.width, out.row(v));
    return Status::ok;
  }

  inline static ImageView<const std::int16_t> given_;
};

}  // namespace lakshya::test
