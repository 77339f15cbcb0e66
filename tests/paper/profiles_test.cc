// The paper's two settings: outdoors 20 m of depth at up to 7 m/s, indoors less of both. The same pair gives another
// map and another speed under the other profile.
#include <gtest/gtest.h>

#include <numbers>

#include "tests/paper/sheet.h"

namespace lakshya::paper {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

// ---- outdoors: a yard with boxes 5, 11 and 15 m away and a house behind the depth that counts

const test::Cuboid kNearBox{{5.5, 2.2, 0}, {1.0, 1.2, 1.0}};
const test::Cuboid kMiddleBox{{11.5, -2.6, 0}, {1.0, 2.0, 1.1}};
const test::Cuboid kFarBox{{15.5, 2.5, 0}, {1.0, 2.4, 1.1}};

PaperScene yard() {
  PaperScene scene{.name = "outdoor",
                   .title = "The outdoor profile: 20 m of depth",
                   .remark = "Boxes 5, 11 and 15 m away are on the map; the house, 26 m away, does not count yet."};
  scene.rig = {.width = 640, .height = 480, .focal_px = 500, .baseline_m = 0.24, .height_m = 0.8, .pitch_deg = 6};
  add_floor(scene);
  add_thing(scene, Object::box, kNearBox, {.gray = 62, .contrast = 40, .seed = 21});
  add_thing(scene, Object::box, kMiddleBox, {.gray = 70, .contrast = 45, .seed = 121});
  add_thing(scene, Object::box, kFarBox, {.gray = 60, .contrast = 40, .seed = 221});
  add_thing(scene, Object::wall, {{26.5, 2, 0}, {1, 22, 5}}, {.gray = 185, .contrast = 45, .seed = 31});
  return scene;
}

class Yard : public testing::Test {
 protected:
  // The lowest rows show the floor at 87 px.
  VehicleConfig config(const std::string& profile) const {
    return config_for(scene_.rig, profile, {"matcher.disparities=96"});
  }
  // sigma_z = z^2 sigma_d / (f B) spreads a face over several rows: 0.47 m at 15 m.
  void check_outdoor(const FrameResult& frame, const Clearance& clearance) {
    EXPECT_GE(front_found(frame.grid, kNearBox, 0.2), 0.99);
    EXPECT_GE(front_found(frame.grid, kMiddleBox, 0.4), 0.9);
    EXPECT_GE(front_found(frame.grid, kFarBox, 0.6), 0.9);
    EXPECT_EQ(stray_obstacles(scene_, frame.grid, clearance), "");
  }

  PaperScene scene_ = yard();
  const test::RenderedPair& pair_ = rendered(scene_);
};

TEST_F(Yard, OutdoorWithTheTrueDisparity) {
  const Experiment experiment(scene_, pair_, config("outdoor"), pair_.disparity16.view());
  check_outdoor(experiment.last().frame(), kTrueClearance);
  EXPECT_EQ(share_of(scene_, pair_, experiment.last().frame(), {Object::wall}, PixelClass::too_far).value(), 1);
}

TEST_F(Yard, OutdoorWithTheMatchedDisparity) {
  const VehicleConfig outdoor = config("outdoor");
  const ProcessedFrame matched(pair_, scene_.rig, outdoor);
  const Experiment experiment(scene_, pair_, outdoor, matched.frame().disparity);
  check_outdoor(experiment.last().frame(), kMatchedClearance);
  EXPECT_GE(share_of(scene_, pair_, matched.frame(), {Object::wall, 5}, PixelClass::too_far).value(), 0.98);
  write_sheet(scene_, pair_, experiment, {.ahead_m = 21, .up_m = 4});
}

TEST_F(Yard, TheProfileDecidesDepthAndSpeed) {
  const ProcessedFrame outdoor(pair_, scene_.rig, config("outdoor"), pair_.disparity16.view());
  const ProcessedFrame indoor(pair_, scene_.rig, config("indoor"), pair_.disparity16.view());
  EXPECT_GE(front_found(indoor.frame().grid, kNearBox, 0.2), 0.99);
  EXPECT_EQ(front_found(indoor.frame().grid, kMiddleBox, 0.4), 0);
  EXPECT_EQ(front_found(indoor.frame().grid, kFarBox, 0.6), 0);
  ASSERT_FALSE(outdoor.frame().plan.blocked);
  ASSERT_FALSE(indoor.frame().plan.blocked);
  EXPECT_GT(outdoor.frame().plan.speed_mps, 2);
  EXPECT_LE(indoor.frame().plan.speed_mps, 1);
  EXPECT_GT(indoor.frame().plan.speed_mps, 0.9);
  EXPECT_LE(indoor.frame().plan.clear_distance_m, 8);
  EXPECT_GT(outdoor.frame().plan.clear_distance_m, 10);
}

// ---- indoors: a doorway in a wall 2.5 m away, another wall 3 m behind it

PaperScene doorway() {
  PaperScene scene{.name = "indoor",
                   .title = "The indoor profile: through a doorway",
                   .remark =
                       "Only what is within 3 m of the vehicle enters its histogram, so that the wall behind "
                       "the doorway does not close it."};
  scene.rig.pitch_deg = 8;
  add_floor(scene);
  const test::SurfaceTexture front{.gray = 175, .contrast = 50, .seed = 31};
  add_thing(scene, Object::wall, {{2.55, 2.45, 0}, {0.1, 2.5, 2.2}}, front);   // left of the door
  add_thing(scene, Object::wall, {{2.55, -1.85, 0}, {0.1, 2.9, 2.2}}, front);  // right of it: -0.4 to 1.2 m is open
  add_thing(scene, Object::wall, {{5.6, 0, 0}, {0.2, 8, 2.6}}, {.gray = 120, .contrast = 45, .seed = 71});
  return scene;
}

class Doorway : public testing::Test {
 protected:
  static void check_passes(const FrameResult& frame) {
    ASSERT_FALSE(frame.plan.blocked);
    // The gap's middle, 0.4 m to the left at 2.5 m, is 9 degrees to the left; its edges less the vehicle's half
    // width and safety distance leave about 7 degrees either side.
    EXPECT_NEAR(frame.plan.direction, 9 * kDegree, 9 * kDegree);
    EXPECT_GT(frame.plan.clear_distance_m, 2.7);
  }

  PaperScene scene_ = doorway();
  const test::RenderedPair& pair_ = rendered(scene_);
};

TEST_F(Doorway, IndoorWithTheTrueDisparity) {
  const ProcessedFrame frame(pair_, scene_.rig, config_for(scene_.rig, "indoor"), pair_.disparity16.view());
  check_passes(frame.frame());
  EXPECT_EQ(stray_obstacles(scene_, frame.frame().grid, kTrueClearance), "");
}

TEST_F(Doorway, IndoorWithTheMatchedDisparity) {
  const VehicleConfig config = config_for(scene_.rig, "indoor");
  const ProcessedFrame matched(pair_, scene_.rig, config);
  const Experiment experiment(scene_, pair_, config, matched.frame().disparity);
  check_passes(experiment.last().frame());
  EXPECT_EQ(stray_obstacles(scene_, experiment.last().frame().grid, kMatchedClearance), "");
  write_sheet(scene_, pair_, experiment, {.ahead_m = 6.5, .up_m = 2.7});
}

TEST_F(Doorway, TheOutdoorProfileSeesTheWallBehindAndDoesNotGoThrough) {
  const ProcessedFrame frame(pair_, scene_.rig, config_for(scene_.rig, "outdoor"), pair_.disparity16.view());
  EXPECT_TRUE(frame.frame().plan.blocked);
}

}  // namespace
}  // namespace lakshya::paper
