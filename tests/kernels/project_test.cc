#include "kernels/project/project.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <random>
#include <vector>

#include "kernels/grid_bin/grid_bin.h"
#include "kernels/project/row_terms.h"
#include "tests/support/each_isa.h"
#include "tests/support/test_grid.h"
#include "tests/support/test_image.h"
#include "tests/support/test_prune_model.h"

namespace lakshya {
namespace {

using test::PaddedImage;
using Model = test::TestPruneModel;

// A map whose rows are longer than its width.
class PaddedGrid {
 public:
  PaddedGrid(const GridGeometry& g, int padding)
      : geometry_(g),
        count_(g.cols, g.rows, padding),
        height_sum_(g.cols, g.rows, padding),
        floor_count_(g.cols, g.rows, padding),
        below_count_(g.cols, g.rows, padding),
        type_(g.cols, g.rows, padding) {
    EXPECT_EQ(clear_grid(view()), Status::ok);
  }
  NavGrid view() {
    return {geometry_, count_.view(), height_sum_.view(), floor_count_.view(), below_count_.view(), type_.view()};
  }
  bool canaries_alive() const {
    return count_.canaries_alive() && height_sum_.canaries_alive() && floor_count_.canaries_alive() &&
           below_count_.canaries_alive();
  }

 private:
  GridGeometry geometry_;
  PaddedImage<std::uint32_t> count_;
  PaddedImage<std::int64_t> height_sum_;
  PaddedImage<std::uint32_t> floor_count_;
  PaddedImage<std::uint32_t> below_count_;
  PaddedImage<std::uint8_t> type_;
};

struct Result {
  Result(const GridGeometry& g, int width, int height, int padding)
      : grid(g, padding), classes(width, height, 5, PixelClass::ceiling) {}
  PaddedGrid grid;
  PixelCounts counts;
  PaddedImage<PixelClass> classes;
};

testing::AssertionResult equal_results(Result& a, Result& b) {
  const NavGrid x = a.grid.view();
  const NavGrid y = b.grid.view();
  if (std::memcmp(&a.counts, &b.counts, sizeof(PixelCounts)) != 0) {
    return testing::AssertionFailure() << "pixels are counted differently";
  }
  for (int v = 0; v < a.classes.view().height; ++v) {
    for (int u = 0; u < a.classes.view().width; ++u) {
      if (a.classes.view().at(u, v) != b.classes.view().at(u, v)) {
        return testing::AssertionFailure() << "class at " << u << "," << v;
      }
    }
  }
  const std::array<testing::AssertionResult, 4> planes = {
      test::equal_images(x.count, y.count), test::equal_images(x.height_sum, y.height_sum),
      test::equal_images(x.floor_count, y.floor_count), test::equal_images(x.below_count, y.below_count)};
  for (const auto& plane : planes) {
    if (!plane) return plane;
  }
  if (!a.grid.canaries_alive() || !a.classes.canaries_alive()) {
    return testing::AssertionFailure() << "wrote beside its rows";
  }
  return testing::AssertionSuccess();
}

struct Trial {
  PruneGeometry camera;
  GridGeometry grid;
};

// Cameras and maps of every kind: level or not, clearances above, at and below the camera, floors out of the search
// range, cells so small that a pixel's footprint is hundreds of them.
Trial any_trial(std::mt19937& random, int width) {
  const auto between = [&](double low, double high) { return std::uniform_real_distribution(low, high)(random); };
  Trial t;
  PruneGeometry& g = t.camera;
  g.focal_px = between(40, 900);
  g.baseline_m = between(0.03, 0.8);
  g.center_u = between(0, width);
  g.center_v = between(-15, 15);
  g.height_m = between(0.2, 2.0);
  g.pitch = between(-0.3, 0.8);
  const bool mounted_straight = random() % 2 == 0;
  if (!mounted_straight) g.roll = between(-0.5, 0.5);
  if (!mounted_straight || random() % 2 == 0) g.yaw = between(-3, 3);
  g.forward_m = between(-0.5, 0.5);
  g.left_m = between(-0.3, 0.3);
  g.max_depth_m = between(0.5, 40);
  const unsigned ceiling = random() % 4;
  g.clearance_m = ceiling == 0 ? g.height_m : between(0.3, 2.5);
  if (ceiling == 1) g.clearance_m = g.height_m + 0.002;  // a bound far out of 32 bits
  g.floor_tolerance_m = between(0, 0.15);
  g.disparity_sigma_px = between(0, 1);
  g.pitch_sigma = between(0, 0.01);
  g.max_disparity_px = between(16, random() % 4 == 0 ? 2040 : 130);
  constexpr std::array<GridGeometry, 6> kGrids = {GridGeometry{200, 200, 100}, GridGeometry{30, 26, 370},
                                                  GridGeometry{1, 2, 10'000},  GridGeometry{400, 300, 7},
                                                  GridGeometry{120, 100, 33},  GridGeometry{300, 300, 1}};
  t.grid = kGrids[random() % kGrids.size()];
  return t;
}

// Half of the pixels near the floor, where decisions are made; runs of equal ones, and codes of every kind.
void fill_scene(ImageView<std::int16_t> image, const PruneModel& m, std::mt19937& random) {
  for (int v = 0; v < image.height; ++v) {
    std::int64_t d = 0;
    for (int u = 0; u < image.width; ++u) {
      const std::int64_t floor = m.floor.at(u, v) >> kDisparityToQ16;
      switch (random() % 6) {
        case 0:
          d = static_cast<std::int64_t>(random() % 2100) - 8;
          break;
        case 1:
          d = random() % 40 == 0 ? static_cast<std::int64_t>(random() % 65536) - 32768 : d;
          break;
        case 2:
        case 3:
          d = floor + static_cast<std::int64_t>(random() % 64) - 32;
          break;
        default:  // as before
          break;
      }
      image.at(u, v) = static_cast<std::int16_t>(std::clamp<std::int64_t>(d, -32768, 32767));
    }
  }
}

std::vector<std::byte> scratch_for(int width) {
  return std::vector<std::byte>(project_scratch_bytes(width));
}

TEST(Project, IsPruningAndBinning) {
  std::mt19937 random(3);
  const int width = 70;
  const Model m(any_trial(random, width).camera);
  PaddedImage<std::int16_t> image(width, 9);
  fill_scene(image.view(), m.prune, random);
  Result one({200, 200, 100}, width, 9, 0);
  std::vector<std::byte> scratch = scratch_for(width);
  ASSERT_EQ(
      project_rows_ref(m.prune, image.view(), {0, 9}, one.grid.view(), one.counts, one.classes.view(), scratch),
      Status::ok);

  Result other({200, 200, 100}, width, 9, 0);
  std::vector<ObstaclePoint> obstacles(width);
  std::vector<GroundStrip> floor(width);
  std::vector<GroundStrip> below(width);
  PrunedRow row{.obstacles = obstacles, .floor = floor, .below = below};
  for (int v = 0; v < 9; ++v) {
    const NavGrid grid = other.grid.view();
    ASSERT_EQ(reproject_prune_row_ref(m.prune, v, row_span(ImageView<const std::int16_t>(image.view()), v), row,
                                      other.counts, row_span(other.classes.view(), v)),
              Status::ok);
    ASSERT_EQ(bin_obstacles_ref(row.obstacles.first(row.obstacle_count), grid), Status::ok);
    ASSERT_EQ(bin_ground_ref(row.floor.first(row.floor_count), grid, grid.floor_count), Status::ok);
    ASSERT_EQ(bin_ground_ref(row.below.first(row.below_count), grid, grid.below_count), Status::ok);
  }
  EXPECT_TRUE(equal_results(one, other));
}

TEST(ProjectSimd, EqualsTheReference) {
  std::mt19937 random(21);
  test::for_each_isa([&](const char* isa) {
    PixelCounts seen;
    std::uint64_t binned = 0;
    int straight = 0;
    int narrow = 0;
    int wide = 0;
    for (int width : test::awkward_widths()) {
      if (width == 203) width = 1100;  // more than a piece of a row
      for (int trial = 0; trial < 8; ++trial) {
        constexpr int kRows = 7;
        const Trial t = any_trial(random, width);
        const Model mount(t.camera);
        const PruneModel m = shift_floor(mount.prune, static_cast<std::int64_t>(random() % 200'000) - 100'000);
        for (int v = 0; v < kRows; ++v) {
          RowTerms terms;
          if (!make_row_terms(m, t.grid, v, width, terms)) continue;
          ++(!terms.narrow.fits ? wide : terms.narrow.straight ? straight : narrow);
        }
        PaddedImage<std::int16_t> image(width, kRows);
        fill_scene(image.view(), m, random);
        const int padding = trial % 3 == 0 ? 3 : 0;
        Result expected(t.grid, width, kRows, padding);
        Result found(t.grid, width, kRows, padding);
        std::vector<std::byte> scratch = scratch_for(width);
        ASSERT_EQ(project_rows_ref(m, image.view(), {0, kRows}, expected.grid.view(), expected.counts,
                                   expected.classes.view(), scratch),
                  Status::ok);
        for (const Rows rows : {Rows{0, 3}, Rows{3, 3}, Rows{3, kRows}}) {
          ASSERT_EQ(project_rows_simd(m, image.view(), rows, found.grid.view(), found.counts, found.classes.view(),
                                      scratch),
                    Status::ok);
        }
        ASSERT_TRUE(equal_results(found, expected)) << isa << " width " << width << " trial " << trial;
        for (int c = 0; c < kPixelClasses; ++c)
          seen.by_class[c] += found.counts.by_class[c];
        binned += test::TestGrid::total(found.grid.view().floor_count);

        Result without(t.grid, width, kRows, padding);
        ASSERT_EQ(project_rows_simd(m, image.view(), {0, kRows}, without.grid.view(), without.counts, {}, scratch),
                  Status::ok);
        ASSERT_EQ(std::memcmp(&without.counts, &found.counts, sizeof(PixelCounts)), 0);
      }
    }
    for (const std::uint32_t n : seen.by_class)
      EXPECT_GT(n, 300U);
    EXPECT_GT(binned, 1000U);
    // Rows of every kind that project_simd.cc tells apart.
    EXPECT_GT(straight, 50);
    EXPECT_GT(narrow, 50);
    EXPECT_GT(wide, 50);
  });
}

TEST(CellDivider, IsExactUpToItsLimit) {
  std::vector<int> sides = {1000, 1023, 1024, 1025, 2621, 4096, 9999, 16'383, 16'385, 32'767, 32'768};
  for (int side = 3; side < 520; ++side)
    sides.push_back(side);
  for (const int side : sides) {
    const CellDivider divider = make_cell_divider(side);
    ASSERT_GE(divider.limit, 1 << 15) << side;
    ASSERT_LE(divider.limit, 0xFFFF) << side;
    for (std::uint32_t mm = 0; mm <= static_cast<std::uint32_t>(divider.limit); ++mm) {
      const std::uint32_t scaled = mm * divider.multiplier >> 16;
      ASSERT_EQ(scaled * divider.shift >> 16, mm / static_cast<std::uint32_t>(side)) << side << " at " << mm;
    }
  }
  for (const int side : {1, 2, 32'769, 1'000'000})
    EXPECT_LT(make_cell_divider(side).limit, 0) << side;
}

// Whatever the sides of a cell, none of a millimetre may be counted in its neighbour.
TEST(ProjectSimd, EveryMillimetreFallsIntoItsCell) {
  test::for_each_isa([&](const char* isa) {
    for (const std::int32_t cell : {1, 3, 7, 64, 99, 100, 127, 1000, 2621}) {
      const GridGeometry g{200, 200, cell};
      // A camera that sees nothing but what stands straight ahead, one millimetre farther from disparity to disparity.
      PruneModel m;
      std::vector<std::int32_t> depth(2000);
      std::vector<std::int32_t> scale(2000);
      for (std::size_t i = 0; i < depth.size(); ++i)
        depth[i] = static_cast<std::int32_t>(2000 - i) + 99 * cell;
      m.depth_mm = depth;
      m.height_scale = scale;
      m.max_floor_disparity = std::int64_t{1} << 27;
      m.floor.constant = -1;
      m.forward.constant = std::int64_t{1} << 32;
      m.left.constant = std::int64_t{1} << 31;
      m.left.per_u = -(std::int64_t{1} << 22);
      m.forward_mm = -3;
      PaddedImage<std::int16_t> image(1999, 1);
      for (int u = 0; u < 1999; ++u)
        image.view().at(u, 0) = static_cast<std::int16_t>(u + 1);
      Result expected(g, 1999, 1, 0);
      Result found(g, 1999, 1, 0);
      std::vector<std::byte> scratch = scratch_for(1999);
      RowTerms terms;
      ASSERT_TRUE(make_row_terms(m, g, 0, 1999, terms)) << cell;
      m.ceiling_test = CeilingTest::below_camera;
      m.ceiling.constant = std::int64_t{1} << 29;  // nothing is too high
      ASSERT_EQ(project_rows_ref(m, image.view(), {0, 1}, expected.grid.view(), expected.counts,
                                 expected.classes.view(), scratch),
                Status::ok);
      ASSERT_EQ(project_rows_simd(m, image.view(), {0, 1}, found.grid.view(), found.counts, found.classes.view(),
                                  scratch),
                Status::ok);
      EXPECT_EQ(expected.counts.by_class[static_cast<int>(PixelClass::obstacle)], 1999U);
      ASSERT_TRUE(equal_results(found, expected)) << isa << " cell " << cell;
    }
  });
}

TEST(ProjectSimd, WhatDoesNotFitIsTheReferences) {
  std::mt19937 random(5);
  Trial t = any_trial(random, 40);
  t.camera.max_depth_m = 5000;  // farther than millimetres are exact in float
  const Model m(t.camera);
  RowTerms terms;
  EXPECT_FALSE(make_row_terms(m.prune, t.grid, 0, 40, terms));
  t.camera.max_depth_m = 20;
  const Model near(t.camera);
  EXPECT_TRUE(make_row_terms(near.prune, {200, 200, 100}, 0, 40, terms));
  EXPECT_FALSE(make_row_terms(near.prune, {200, 200, 10'000}, 0, 40, terms));
  PaddedImage<std::int16_t> image(40, 5);
  fill_scene(image.view(), m.prune, random);
  Result expected(t.grid, 40, 5, 0);
  Result found(t.grid, 40, 5, 0);
  std::vector<std::byte> scratch = scratch_for(40);
  ASSERT_EQ(project_rows_ref(m.prune, image.view(), {0, 5}, expected.grid.view(), expected.counts,
                             expected.classes.view(), scratch),
            Status::ok);
  ASSERT_EQ(project_rows_simd(m.prune, image.view(), {0, 5}, found.grid.view(), found.counts, found.classes.view(),
                              scratch),
            Status::ok);
  EXPECT_TRUE(equal_results(found, expected));
}

TEST(Project, RefusesWrongArguments) {
  std::mt19937 random(6);
  const Model m(any_trial(random, 8).camera);
  const PaddedImage<std::int16_t> image(8, 4);
  PaddedImage<PixelClass> small(7, 4, 1, PixelClass::floor);
  Result r({20, 20, 100}, 8, 4, 0);
  std::vector<std::byte> scratch = scratch_for(8);
  for (const auto project : {project_rows_ref, project_rows_simd}) {
    const auto run = [&](Rows rows, const NavGrid& grid, ImageView<PixelClass> classes, std::span<std::byte> s) {
      return project(m.prune, image.view(), rows, grid, r.counts, classes, s);
    };
    EXPECT_EQ(run({0, 4}, r.grid.view(), small.view(), scratch), Status::size_mismatch);
    EXPECT_EQ(run({0, 5}, r.grid.view(), {}, scratch), Status::bad_argument);
    EXPECT_EQ(run({-1, 4}, r.grid.view(), {}, scratch), Status::bad_argument);
    EXPECT_EQ(run({0, 4}, {}, {}, scratch), Status::bad_argument);
    EXPECT_EQ(run({0, 4}, r.grid.view(), {}, std::span(scratch).first(scratch.size() - 1)),
              Status::scratch_too_small);
    EXPECT_EQ(run({0, 4}, r.grid.view(), {}, scratch), Status::ok);
  }
}

}  // namespace
}  // namespace lakshya
