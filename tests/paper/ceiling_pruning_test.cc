// The paper's ceiling pruning (its fig. 9): a box between two walls under a hanging lamp. The vehicle passes below the
// lamp as long as that hangs higher than the clearance.
#include <gtest/gtest.h>

#include "tests/paper/sheet.h"

namespace lakshya::paper {
namespace {

const test::Cuboid kBox{{3.0, 0.75, 0}, {0.5, 0.5, 0.5}};
constexpr double kCeiling = 2.6;
constexpr double kLampHeight = 0.25;

test::Cuboid lamp_at(double bottom_m) {
  return {{3.6, -0.3, bottom_m}, {0.4, 0.4, kLampHeight}};
}

PaperScene corridor(double lamp_bottom_m) {
  PaperScene scene;
  scene.rig.pitch_deg = 3;
  add_floor(scene);
  scene.surfaces.push_back({{0, -2, kCeiling},
                            {1, 0, 0},
                            {0, 1, 0},
                            9,
                            4,
                            static_cast<std::uint8_t>(Object::ceiling),
                            {.gray = 200, .contrast = 35, .seed = 50}});
  const test::Cuboid lamp = lamp_at(lamp_bottom_m);
  const double cord_bottom = lamp_bottom_m + kLampHeight;
  const test::SurfaceTexture bright{.gray = 225, .contrast = 35, .seed = 61};
  add_thing(scene, Object::lamp, lamp, bright);
  add_thing(scene, Object::lamp, {{lamp.base.x, lamp.base.y, cord_bottom}, {0.04, 0.04, kCeiling - cord_bottom}},
            bright);
  add_thing(scene, Object::box, kBox, {.gray = 62, .contrast = 40, .seed = 21});
  add_thing(scene, Object::wall, {{4.7, 1.6, 0}, {8.6, 0.2, kCeiling}}, {.gray = 175, .contrast = 50, .seed = 31});
  add_thing(scene, Object::wall, {{4.7, -1.6, 0}, {8.6, 0.2, kCeiling}}, {.gray = 175, .contrast = 50, .seed = 41});
  add_thing(scene, Object::wall, {{9.1, 0, 0}, {0.2, 4, kCeiling}}, {.gray = 140, .contrast = 45, .seed = 71});
  return scene;
}

PaperScene high_lamp() {
  PaperScene scene = corridor(1.5);
  scene.name = "ceiling_pruning";
  scene.title = "Ceiling pruning (the paper's fig. 9)";
  scene.remark =
      "The lamp hangs at 1.5 m, above the clearance of 1.2 m: its points are dropped, and the cells below "
      "it are free.";
  return scene;
}

PaperScene low_lamp() {
  PaperScene scene = corridor(0.85);
  scene.name = "ceiling_pruning_low_lamp";
  scene.title = "Ceiling pruning: the same lamp, too low to pass below";
  scene.remark = "The lamp hangs at 0.85 m, below the clearance of 1.2 m: it is an obstacle.";
  return scene;
}

struct Margins {
  int pixels = 0;  // Selection::margin_px
  Clearance cells;
};
constexpr Margins kTrue{0, kTrueClearance};
constexpr Margins kMatched{5, kMatchedClearance};

// What holds wherever the lamp hangs. The classes are looked at without a limit of depth: the walls go on.
void check_surroundings(const PaperScene& scene, const test::RenderedPair& pair, const Experiment& experiment,
                        const Margins& margins) {
  const FrameResult& all_depths = experiment.frames[2]->frame();
  const auto share = [&](const Selection& selection, PixelClass wanted) {
    return share_of(scene, pair, all_depths, selection, wanted).value();
  };
  EXPECT_GE(share({Object::floor, margins.pixels}, PixelClass::floor), 0.98);
  EXPECT_GE(share({Object::box, margins.pixels, 0.07}, PixelClass::obstacle), 0.98);
  EXPECT_GE(share({Object::wall, margins.pixels, 0.15, 1.1}, PixelClass::obstacle), 0.98);
  EXPECT_GE(share({Object::wall, margins.pixels, 1.3}, PixelClass::ceiling), 0.98);
  EXPECT_GE(share({Object::ceiling, margins.pixels}, PixelClass::ceiling), 0.98);

  const NavGrid& grid = experiment.last().frame().grid;
  EXPECT_GE(front_found(grid, kBox, 0.1), 0.99);
  EXPECT_EQ(stray_obstacles(scene, grid, margins.cells), "");
  EXPECT_EQ(not_free(grid, {1.5, 2.6, -0.3, 0.3}), "") << "the way to box and lamp";

  const StepCounts& kept = experiment.kept;
  EXPECT_LE(of(kept[1], Object::floor), of(kept[0], Object::floor) / 50);
  EXPECT_GE(of(kept[1], Object::wall), of(kept[0], Object::wall) * 90 / 100);
  EXPECT_LE(of(kept[2], Object::ceiling), of(kept[0], Object::ceiling) / 50);
  // The ground estimate looks at what is nearer than the limit of depth only, so a few pixels may change sides.
  EXPECT_GE(of(kept[3], Object::box), of(kept[1], Object::box) * 99 / 100);
}

void check_high_lamp(const PaperScene& scene, const test::RenderedPair& pair, const Experiment& experiment,
                     const Margins& margins) {
  check_surroundings(scene, pair, experiment, margins);
  const FrameResult& frame = experiment.last().frame();
  const Share lamp = share_of(scene, pair, frame, {Object::lamp, margins.pixels}, PixelClass::ceiling);
  EXPECT_GT(lamp.pixels, 500);
  EXPECT_GE(lamp.value(), 0.98);
  EXPECT_GE(of(experiment.kept[1], Object::lamp), of(experiment.kept[0], Object::lamp) * 98 / 100);
  EXPECT_LE(of(experiment.kept[2], Object::lamp), of(experiment.kept[0], Object::lamp) / 50);
  EXPECT_EQ(not_free(frame.grid, {3.4, 3.8, -0.5, -0.1}), "") << "below the lamp";
}

void check_low_lamp(const PaperScene& scene, const test::RenderedPair& pair, const Experiment& experiment,
                    const Margins& margins) {
  check_surroundings(scene, pair, experiment, margins);
  const FrameResult& frame = experiment.last().frame();
  const Share lamp = share_of(scene, pair, frame, {Object::lamp, margins.pixels, -1, 1.15}, PixelClass::obstacle);
  EXPECT_GT(lamp.pixels, 500);
  EXPECT_GE(lamp.value(), 0.98);
  EXPECT_GE(front_found(frame.grid, lamp_at(0.85), 0.1), 0.99);
}

TEST(CeilingPruning, ALampAboveTheClearanceWithTheTrueDisparity) {
  const PaperScene scene = high_lamp();
  const test::RenderedPair& pair = rendered(scene);
  const Experiment experiment(scene, pair, config_for(scene.rig, "indoor"), pair.disparity16.view());
  check_high_lamp(scene, pair, experiment, kTrue);
}

TEST(CeilingPruning, ALampAboveTheClearanceWithTheMatchedDisparity) {
  const PaperScene scene = high_lamp();
  const test::RenderedPair& pair = rendered(scene);
  const VehicleConfig config = config_for(scene.rig, "indoor");
  const ProcessedFrame matched(pair, scene.rig, config);
  const Experiment experiment(scene, pair, config, matched.frame().disparity);
  check_high_lamp(scene, pair, experiment, kMatched);
  write_sheet(scene, pair, experiment, {.ahead_m = 9, .up_m = 2.7});
}

TEST(CeilingPruning, ALampBelowTheClearanceWithTheTrueDisparity) {
  const PaperScene scene = low_lamp();
  const test::RenderedPair& pair = rendered(scene);
  const Experiment experiment(scene, pair, config_for(scene.rig, "indoor"), pair.disparity16.view());
  check_low_lamp(scene, pair, experiment, kTrue);
}

TEST(CeilingPruning, ALampBelowTheClearanceWithTheMatchedDisparity) {
  const PaperScene scene = low_lamp();
  const test::RenderedPair& pair = rendered(scene);
  const VehicleConfig config = config_for(scene.rig, "indoor");
  const ProcessedFrame matched(pair, scene.rig, config);
  const Experiment experiment(scene, pair, config, matched.frame().disparity);
  check_low_lamp(scene, pair, experiment, kMatched);
  write_sheet(scene, pair, experiment, {.ahead_m = 9, .up_m = 2.7});
}

// The clearance decides, not the lamp: a lower vehicle passes below the low lamp.
TEST(CeilingPruning, ALowerVehiclePassesBelowTheLowLamp) {
  const PaperScene scene = low_lamp();
  const test::RenderedPair& pair = rendered(scene);
  const VehicleConfig config = config_for(scene.rig, "indoor", {"prune.clearance_m=0.8"});
  const ProcessedFrame frame(pair, scene.rig, config, pair.disparity16.view());
  EXPECT_EQ(share_of(scene, pair, frame.frame(), {Object::lamp}, PixelClass::ceiling).value(), 1);
  EXPECT_EQ(cell_at(frame.frame().grid, 3.45, -0.25), kCellUnoccupied);
}

}  // namespace
}  // namespace lakshya::paper
