// The paper's floor cancellation (its fig. 7): a box stands on the floor, a newspaper lies beside it. The newspaper is
// as easy to see as the box, but it is floor, and the vehicle may drive over it.
#include <gtest/gtest.h>

#include "tests/paper/sheet.h"

namespace lakshya::paper {
namespace {

constexpr double kTolerance = 0.04;  // prune.floor_tolerance_m
const test::Cuboid kBox{{2.6, 0.45, 0}, {0.4, 0.5, 0.4}};

PaperScene newspaper_scene() {
  PaperScene scene{.name = "floor_cancellation",
                   .title = "Floor cancellation (the paper's fig. 7)",
                   .remark =
                       "The newspaper lies flat: its points go away with the floor's, its cells stay free. "
                       "The box stays."};
  scene.rig.pitch_deg = 8;
  add_floor(scene);
  scene.surfaces.push_back({{1.9, -0.75, 0.002},
                            {1, 0, 0},
                            {0, 1, 0},
                            0.6,
                            0.8,
                            static_cast<std::uint8_t>(Object::newspaper),
                            {.gray = 215, .contrast = 60, .finest_m = 0.012, .seed = 7}});
  add_thing(scene, Object::box, kBox, {.gray = 62, .contrast = 40, .seed = 21});
  add_thing(scene, Object::wall, {{7.1, 0, 0}, {0.2, 12, 3}}, {.gray = 185, .contrast = 45, .seed = 31});
  return scene;
}

class FloorCancellation : public testing::Test {
 protected:
  // `margin_px`: see Selection.
  void check(const Experiment& experiment, int margin_px, const Clearance& clearance) {
    const FrameResult& frame = experiment.last().frame();
    const auto share = [&](const Selection& selection, PixelClass wanted) {
      return share_of(scene_, pair_, frame, selection, wanted);
    };
    const Share newspaper = share({Object::newspaper, margin_px}, PixelClass::floor);
    EXPECT_GT(newspaper.pixels, 2000);
    EXPECT_GE(newspaper.value(), 0.98);
    EXPECT_EQ(share({Object::newspaper, margin_px}, PixelClass::obstacle).with_class, 0);
    EXPECT_GE(share({Object::floor, margin_px}, PixelClass::floor).value(), 0.98);
    // What is lower than the tolerance, and three sigma of disparity above it, is floor by definition.
    const Share box = share({Object::box, margin_px, kTolerance + 0.02}, PixelClass::obstacle);
    EXPECT_GT(box.pixels, 3000);
    EXPECT_GE(box.value(), 0.98);

    EXPECT_GE(front_found(frame.grid, kBox, 0.1), 0.99);
    EXPECT_EQ(not_free(frame.grid, {1.9, 2.5, -0.8, 0}), "") << "where the newspaper lies";
    EXPECT_EQ(stray_obstacles(scene_, frame.grid, clearance), "");
    expect_steps(experiment.kept);
  }

  static void expect_steps(const StepCounts& kept) {
    EXPECT_LE(of(kept[1], Object::floor), of(kept[0], Object::floor) / 50);
    EXPECT_LE(of(kept[1], Object::newspaper), of(kept[0], Object::newspaper) / 50);
    EXPECT_GE(of(kept[1], Object::box), of(kept[0], Object::box) * 80 / 100);
    for (std::size_t step = 1; step < kSteps; ++step)
      EXPECT_LE(total(kept[step]), total(kept[step - 1]));
  }

  PaperScene scene_ = newspaper_scene();
  const test::RenderedPair& pair_ = rendered(scene_);
  VehicleConfig config_ = config_for(scene_.rig, "indoor");
};

TEST_F(FloorCancellation, WithTheTrueDisparity) {
  const Experiment experiment(scene_, pair_, config_, pair_.disparity16.view());
  check(experiment, 0, kTrueClearance);
  EXPECT_LE(std::abs(experiment.last().frame().ground_offset16), 1);
}

TEST_F(FloorCancellation, WithTheMatchedDisparity) {
  const ProcessedFrame matched(pair_, scene_.rig, config_);
  const Experiment experiment(scene_, pair_, config_, matched.frame().disparity);
  check(experiment, 5, kMatchedClearance);
  write_sheet(scene_, pair_, experiment, {.ahead_m = 8, .up_m = 2.0});
}

TEST_F(FloorCancellation, WithoutATolerantFloorTheNewspaperIsStillFloor) {
  // 2 mm of paper are far below what a sixteenth of a pixel can tell.
  VehicleConfig config = config_;
  config.prune.floor_tolerance_m = 0;
  const Experiment experiment(scene_, pair_, config, pair_.disparity16.view());
  EXPECT_EQ(of(experiment.kept[1], Object::newspaper), 0);
}

}  // namespace
}  // namespace lakshya::paper
