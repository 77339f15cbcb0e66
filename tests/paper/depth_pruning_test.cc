// The paper's depth pruning (its fig. 10): a box in a room, and a limit of depth between the box and the walls, so that
// the box alone is left.
#include <gtest/gtest.h>

#include "tests/paper/sheet.h"

namespace lakshya::paper {
namespace {

const test::Cuboid kBox{{2.6, -0.3, 0}, {0.4, 0.7, 0.6}};

PaperScene room() {
  PaperScene scene{.name = "depth_pruning",
                   .title = "Depth pruning (the paper's fig. 10)",
                   .remark = "Depth is limited to 3.5 m: of floor, box and walls the box alone is left."};
  scene.rig.pitch_deg = 8;
  add_floor(scene);
  add_thing(scene, Object::box, kBox, {.gray = 62, .contrast = 40, .seed = 21});
  add_thing(scene, Object::wall, {{5.6, 0, 0}, {0.2, 6, 3}}, {.gray = 185, .contrast = 45, .seed = 31});
  add_thing(scene, Object::wall, {{2.75, 2.7, 0}, {5.5, 0.2, 3}}, {.gray = 165, .contrast = 50, .seed = 41});
  add_thing(scene, Object::wall, {{2.75, -2.7, 0}, {5.5, 0.2, 3}}, {.gray = 165, .contrast = 50, .seed = 51});
  return scene;
}

class DepthPruning : public testing::Test {
 protected:
  void check(const Experiment& experiment, int margin_px, const Clearance& clearance) {
    const FrameResult& frame = experiment.last().frame();
    const auto share = [&](const Selection& selection, PixelClass wanted) {
      return share_of(scene_, pair_, frame, selection, wanted).value();
    };
    EXPECT_GE(share({Object::wall, margin_px}, PixelClass::too_far), 0.98);
    EXPECT_GE(share({Object::box, margin_px, 0.07}, PixelClass::obstacle), 0.98);

    const StepCounts& kept = experiment.kept;
    EXPECT_LE(of(kept[1], Object::floor), of(kept[0], Object::floor) / 50);
    EXPECT_GT(of(kept[2], Object::wall), 2 * of(kept[2], Object::box)) << "the walls were there before";
    EXPECT_GE(of(kept[3], Object::box), of(kept[2], Object::box) * 99 / 100);
    // The matcher's window takes some pixels around the silhouette for the box.
    EXPECT_GE(of(kept[3], Object::box), total(kept[3]) * 95 / 100);
    EXPECT_EQ(share({Object::wall, margin_px}, PixelClass::obstacle), 0);
    EXPECT_LT(share({Object::floor, margin_px}, PixelClass::obstacle), 0.001);

    EXPECT_GE(front_found(frame.grid, kBox, 0.1), 0.99);
    PaperScene box_alone = scene_;
    std::erase_if(box_alone.things, [](const Thing& t) { return t.object != Object::box; });
    EXPECT_EQ(stray_obstacles(box_alone, frame.grid, clearance), "");
  }

  PaperScene scene_ = room();
  const test::RenderedPair& pair_ = rendered(scene_);
  VehicleConfig config_ = config_for(scene_.rig, "indoor", {"prune.max_depth_m=3.5"});
};

TEST_F(DepthPruning, WithTheTrueDisparity) {
  const Experiment experiment(scene_, pair_, config_, pair_.disparity16.view());
  check(experiment, 0, kTrueClearance);
  EXPECT_EQ(total(experiment.kept[3]), of(experiment.kept[3], Object::box));
}

TEST_F(DepthPruning, WithTheMatchedDisparity) {
  const ProcessedFrame matched(pair_, scene_.rig, config_);
  const Experiment experiment(scene_, pair_, config_, matched.frame().disparity);
  check(experiment, 5, kMatchedClearance);
  write_sheet(scene_, pair_, experiment, {.ahead_m = 6.5, .up_m = 2.7});
}

TEST_F(DepthPruning, WithALargerDepthTheWallsAreObstaclesToo) {
  const VehicleConfig config = config_for(scene_.rig, "indoor");
  const ProcessedFrame frame(pair_, scene_.rig, config, pair_.disparity16.view());
  EXPECT_EQ(cell_at(frame.frame().grid, 5.55, 0.55), kCellObstacle);
  EXPECT_EQ(stray_obstacles(scene_, frame.frame().grid, kTrueClearance), "");
}

}  // namespace
}  // namespace lakshya::paper
