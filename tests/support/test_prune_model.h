// A prune model that owns its tables.
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

#include "kernels/prune/prune.h"

namespace lakshya::test {

struct TestPruneModel {
  explicit TestPruneModel(const PruneGeometry& g)
      : depth(prune_table_entries(g.max_disparity_px)), height(prune_table_entries(g.max_disparity_px)) {
    EXPECT_EQ(build_prune_model(g, depth, height, prune), Status::ok);
  }
  std::vector<std::int32_t> depth;
  std::vector<std::int32_t> height;
  PruneModel prune;
};

}  // namespace lakshya::test
