#include "app/tools/pictures.h"

#include <gtest/gtest.h>

#include <array>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <numbers>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <string>
#include <vector>

#include "app/core/calibration_file.h"
#include "app/core/image_file.h"
#include "app/tools/picture_colors.h"
#include "app/tools/picture_panels.h"
#include "hal/clock/monotonic_clock.h"

namespace lakshya {
namespace {

int brightness(Rgb8 c) {
  return c.r + c.g + c.b;
}

bool same(Rgb8 a, Rgb8 b) {
  return a.r == b.r && a.g == b.g && a.b == b.b;
}

bool gray_ink(Rgb8 c) {
  return c.r == c.g && c.g == c.b;
}

// One frame made by hand: a grey image without disparity and a map of which nothing is known.
struct Scene {
  Scene(int width, int height, GridGeometry geometry = {})
      : left(width, height, 120),
        disparity(width, height, kLowTexture),
        classes(width, height, PixelClass::no_disparity),
        count(geometry.cols, geometry.rows),
        height_sum(geometry.cols, geometry.rows),
        floor_count(geometry.cols, geometry.rows),
        below_count(geometry.cols, geometry.rows),
        type(geometry.cols, geometry.rows, kCellUnknown) {
    camera.width = width;
    camera.height = height;
    camera.focal_px = 0.7 * width;
    camera.cx_left = camera.cx_right = (width - 1) / 2.0;
    camera.cy = (height - 1) / 2.0;
    camera.baseline_m = 0.12;
    config.grid.cell_m = geometry.cell_mm / 1000.0;
    frame.left = left.view();
    frame.right = left.view();
    frame.disparity = disparity.view();
    frame.classes = classes.view();
    frame.grid = {geometry, count.view(), height_sum.view(), floor_count.view(), below_count.view(), type.view()};
  }

  PictureInput input() const { return {frame, camera, config, target, 1.5, "a made frame"}; }

  void put_disparity(int u, int v, PixelClass pixel_class, double px) {
    classes.view().at(u, v) = pixel_class;
    disparity.view().at(u, v) = static_cast<std::int16_t>(px * kDisparityScale);
  }
  void put_obstacle(int row, int col, std::int64_t mean_height_mm) {
    type.view().at(col, row) = kCellObstacle;
    count.view().at(col, row) = 10;
    height_sum.view().at(col, row) = 10 * mean_height_mm;
  }
  void choose(double direction, double clear_m) {
    frame.plan.blocked = false;
    frame.plan.direction = direction;
    frame.plan.clear_distance_m = clear_m;
    frame.plan.openings.items[0] = {.first = 0, .count = 4};
    frame.plan.openings.count = 1;
    frame.plan.seen.fill(true);
    frame.plan.selectable.fill(true);
  }

  Image<std::uint8_t> left;
  Image<std::int16_t> disparity;
  Image<PixelClass> classes;
  Image<std::uint32_t> count;
  Image<std::int64_t> height_sum;
  Image<std::uint32_t> floor_count;
  Image<std::uint32_t> below_count;
  Image<std::uint8_t> type;
  RectifiedGeometry camera;
  VehicleConfig config;
  FrameResult frame;
  double target = 0;
};

int pixels_that(const Image<Rgb8>& image, const std::function<bool(Rgb8)>& test) {
  int found = 0;
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x)
      found += test(image.view().at(x, y)) ? 1 : 0;
  }
  return found;
}

int pixels_of(const Image<Rgb8>& image, Rgb8 color) {
  return pixels_that(image, [color](Rgb8 c) { return same(c, color); });
}

// The picture can be made, is neither empty nor absurdly large, and is not all of one colour.
void expect_sound(const Image<Rgb8>& picture, const std::string& what) {
  EXPECT_GE(picture.width(), 1000) << what;
  EXPECT_LE(picture.width(), 6000) << what;
  EXPECT_GE(picture.height(), 1000) << what;
  EXPECT_LE(picture.height(), 6000) << what;
  EXPECT_GT(pixels_of(picture, kPaper), 1000) << what;
  EXPECT_GT(pixels_that(picture, [](Rgb8 c) { return brightness(c) < 300; }), 1000) << what;
}

void expect_sheets_sound(const Scene& scene, const std::string& what) {
  expect_sound(map_picture(scene.input()), what + ", map");
  const Image<Rgb8> summary = summary_picture(scene.input());
  expect_sound(summary, what + ", summary");
  EXPECT_EQ(summary.width(), 2040) << what;
}

// One map alone, and the colour in it at a cell's centre.
class MapPlot {
 public:
  static constexpr int kSide = 600;
  explicit MapPlot(const Scene& scene)
      : sheet_(kSide + 100, kSide + 100, kPaper),
        cell_m_(scene.config.grid.cell_m),
        cols_(scene.frame.grid.geometry.cols),
        view_(whole_map_view(scene.input(), kSide, kSide)) {
    draw_map(sheet_, {50, 50, kSide, kSide}, view_, scene.input(), MapDetail::overview, "map");
  }
  Rgb8 cell(int row, int col) const {
    const Point p = view_.at((row + 0.5) * cell_m_, (cols_ / 2.0 - col - 0.5) * cell_m_);
    return sheet_.image().view().at(50 + static_cast<int>(p.x), 50 + static_cast<int>(p.y));
  }

 private:
  Canvas sheet_;
  double cell_m_;
  int cols_;
  MapView view_;
};

// ---- colours

TEST(PictureColors, TurboFollowsOpenCvsTable) {
  cv::Mat ramp(1, 256, CV_8UC1);
  for (int i = 0; i < 256; ++i)
    ramp.at<std::uint8_t>(0, i) = static_cast<std::uint8_t>(i);
  cv::Mat table;
  cv::applyColorMap(ramp, table, cv::COLORMAP_TURBO);
  for (int i = 0; i < 256; ++i) {
    const Rgb8 ours = turbo(i / 255.0);
    const auto theirs = table.at<cv::Vec3b>(0, i);  // blue first
    // A fit, not the table; least good at the dark blue end, where the scale does not begin.
    const int tolerance = i < 12 ? 40 : 25;
    EXPECT_NEAR(ours.r, theirs[2], tolerance) << i;
    EXPECT_NEAR(ours.g, theirs[1], tolerance) << i;
    EXPECT_NEAR(ours.b, theirs[0], tolerance) << i;
  }
}

TEST(PictureColors, NearIsWarmFarIsColdAndNoneIsNeither) {
  const Rgb8 far = disparity_color(0, 64);
  const Rgb8 near = disparity_color(64, 64);
  EXPECT_GT(far.b, far.r + 30);
  EXPECT_GT(near.r, near.b + 80);
  EXPECT_TRUE(same(disparity_color(1000, 64), near));
  EXPECT_LT(kNoDisparityColor.b - kNoDisparityColor.r, 10);
}

TEST(PictureColors, EveryClassAndReasonLooksDifferent) {
  std::vector<Rgb8> colors;
  for (int c = 1; c < kPixelClasses; ++c)
    colors.push_back(class_color(static_cast<PixelClass>(c), 16, 150));
  for (int reason = -kNoDisparityReasons; reason <= 0; ++reason)
    colors.push_back(class_color(PixelClass::no_disparity, static_cast<std::int16_t>(reason), 150));
  for (std::size_t i = 0; i < colors.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      const int apart = std::abs(colors[i].r - colors[k].r) + std::abs(colors[i].g - colors[k].g) +
                        std::abs(colors[i].b - colors[k].b);
      EXPECT_GT(apart, 15) << i << " and " << k;
    }
  }
}

// ---- texts

TEST(PictureTexts, NumbersHaveNoNegativeZero) {
  EXPECT_EQ(decimal(-0.04, 1), "0.0");
  EXPECT_EQ(decimal(-0.06, 1), "-0.1");
  EXPECT_EQ(decimal(12.345, 2), "12.35");
  EXPECT_EQ(degrees_text(std::numbers::pi / 8), "+22.5 deg");
  EXPECT_EQ(degrees_text(-std::numbers::pi / 8), "-22.5 deg");
  EXPECT_EQ(degrees_text(-1e-9), "0.0 deg");
}

TEST(PictureTexts, StepsAreRound) {
  EXPECT_DOUBLE_EQ(round_step(0.7), 1.0);
  EXPECT_DOUBLE_EQ(round_step(1.0), 1.0);
  EXPECT_DOUBLE_EQ(round_step(1.1), 2.0);
  EXPECT_DOUBLE_EQ(round_step(23), 50);
  EXPECT_DOUBLE_EQ(round_step(51), 100);
}

TEST(PictureTexts, LongTextIsCutToTheWidth) {
  EXPECT_EQ(text_that_fits("short", kBodyText, 500), "short");
  const std::string cut = text_that_fits(std::string(100'000, 'm'), kBodyText, 200);
  EXPECT_LE(text_width(cut, kBodyText), 200);
  EXPECT_TRUE(cut.ends_with("m..."));
  EXPECT_EQ(text_that_fits("text", kBodyText, 2), "");
}

// ---- pictures with the camera's pixels

TEST(DisparityPicture, ShowsEachPixelInItsPlace) {
  Scene scene(40, 30);
  scene.put_disparity(3, 4, PixelClass::obstacle, 60);
  scene.put_disparity(5, 4, PixelClass::too_far, 0);
  scene.put_disparity(7, 4, PixelClass::obstacle, 60);
  const Image<Rgb8> picture = disparity_picture(scene.input());
  ASSERT_EQ(picture.width(), 40);
  ASSERT_EQ(picture.height(), 30);
  EXPECT_TRUE(same(picture.view().at(3, 4), disparity_color(60, 60)));
  EXPECT_TRUE(same(picture.view().at(5, 4), disparity_color(0, 60)));
  EXPECT_EQ(pixels_of(picture, kNoDisparityColor), 40 * 30 - 3);
}

TEST(DisparityPicture, AFewOutliersDoNotSetTheScale) {
  Scene scene(50, 20);
  for (int i = 0; i < 1000; ++i)
    scene.put_disparity(i % 50, i / 50, PixelClass::floor, i < 4 ? 500 : 20);
  EXPECT_DOUBLE_EQ(disparity_scale(scene.frame.disparity).last, 20);
  EXPECT_TRUE(same(disparity_picture(scene.input()).view().at(30, 10), turbo(1)));
}

TEST(DisparityPicture, TheScaleStartsAtZeroUnlessTheWholeSceneIsNear) {
  Scene scene(50, 20);
  for (int i = 0; i < 1000; ++i)
    scene.put_disparity(i % 50, i / 50, PixelClass::obstacle, i < 500 ? 30 : 40);
  EXPECT_DOUBLE_EQ(disparity_scale(scene.frame.disparity).first, 30);
  EXPECT_DOUBLE_EQ(disparity_scale(scene.frame.disparity).last, 40);
  for (int i = 0; i < 100; ++i)
    scene.put_disparity(i % 50, i / 50, PixelClass::obstacle, 15);
  EXPECT_DOUBLE_EQ(disparity_scale(scene.frame.disparity).first, 0);
}

TEST(DisparityPicture, WithoutAnyDisparityIsDark) {
  const Scene scene(16, 16);
  EXPECT_DOUBLE_EQ(disparity_scale(scene.frame.disparity).last, 1);
  EXPECT_EQ(pixels_of(disparity_picture(scene.input()), kNoDisparityColor), 256);
}

TEST(ClassesPicture, ColoursSayTheClass) {
  Scene scene(16, 16);
  scene.put_disparity(0, 0, PixelClass::obstacle, 10);
  scene.put_disparity(1, 0, PixelClass::floor, 10);
  scene.put_disparity(2, 0, PixelClass::ceiling, 10);
  scene.put_disparity(3, 0, PixelClass::drop_off, 10);
  scene.put_disparity(4, 0, PixelClass::too_far, 1);
  const Image<Rgb8> picture = classes_picture(scene.input());
  const auto at = [&](int u) { return picture.view().at(u, 0); };
  EXPECT_GT(at(0).r, at(0).g + 50);
  EXPECT_GT(at(0).r, at(0).b + 50);
  EXPECT_GT(at(1).g, at(1).r + 30);
  EXPECT_GT(at(1).g, at(1).b + 10);
  EXPECT_GT(at(2).b, at(2).r + 50);
  EXPECT_GT(at(2).b, at(2).g + 20);
  EXPECT_GT(at(3).r, at(3).g + 50);
  EXPECT_GT(at(3).b, at(3).g + 50);
  EXPECT_TRUE(same(at(4), {120, 120, 120}));
  EXPECT_LT(brightness(at(5)), 270) << "without disparity: darkened";
}

TEST(ClassesPicture, TheImageShowsThroughEveryTint) {
  for (int c = 1; c < kPixelClasses; ++c) {
    const auto color = [c](std::uint8_t gray) {
      return brightness(class_color(static_cast<PixelClass>(c), 16, gray));
    };
    EXPECT_GT(color(200) - color(50), 150) << c;
  }
}

// ---- the map

TEST(MapPicture, CellsShowTypeAndHeight) {
  Scene scene(64, 48);
  scene.type.view().at(60, 100) = kCellUnoccupied;
  scene.put_obstacle(100, 64, 100);
  scene.put_obstacle(100, 68, 1000);
  scene.type.view().at(72, 100) = kCellObstacle;  // a drop-off: no obstacle points
  const MapPlot plot(scene);
  EXPECT_TRUE(same(plot.cell(100, 60), kFreeCell));
  EXPECT_TRUE(same(plot.cell(100, 50), kUnknownCell));
  EXPECT_TRUE(same(plot.cell(100, 72), kDropOffCell));
  EXPECT_TRUE(same(plot.cell(100, 64), height_color(0.1, 1.2)));
  EXPECT_LT(brightness(plot.cell(100, 64)), 330);
  EXPECT_LT(brightness(plot.cell(100, 68)), brightness(plot.cell(100, 64)) - 60) << "higher is darker";
}

TEST(MapPicture, LeftIsLeftAndAheadIsUp) {
  Scene scene(64, 48);
  const MapView view = whole_map_view(scene.input(), 400, 500);
  EXPECT_DOUBLE_EQ(view.origin.x, 200);
  EXPECT_LT(view.at(1, 2).x, view.at(1, 0).x);
  EXPECT_LT(view.at(2, 0).y, view.at(1, 0).y);
  EXPECT_GE(view.at(20, 0).y, -1e-9) << "the last row is inside";
  EXPECT_GE(view.at(0, 10).x, -1e-9);
  EXPECT_GE(500 - view.origin.y, 0.45 * view.scale) << "the vehicle's circle is inside";
}

TEST(MapPicture, TheNearViewHoldsWhatIsKnown) {
  Scene scene(64, 48);
  scene.put_obstacle(39, 120, 500);  // 4 m ahead, 2 m to the right
  const MapView near = near_map_view(scene.input(), 800, 800);
  EXPECT_GE(near.at(4.0, 0).y, 0);
  EXPECT_LE(near.at(0, -2.1).x, 800);
  EXPECT_GT(near.scale, 3 * whole_map_view(scene.input(), 800, 800).scale);
  scene.put_obstacle(199, 100, 500);
  EXPECT_GE(near_map_view(scene.input(), 800, 800).scale, 0.9 * 800 / (1.5 * 5 + 1)) << "at most 1.5 active radii";
}

TEST(MapPicture, AnObstacleCellIsDrawnDarkAtFourPixelsOrMore) {
  Scene scene(64, 48);
  scene.choose(0.3, 2);
  const Image<Rgb8> before = map_picture(scene.input());
  scene.put_obstacle(150, 30, 600);  // beyond the near view, which therefore stays as it is
  scene.type.view().at(30, 150) = kCellUnoccupied;
  const Image<Rgb8> free = map_picture(scene.input());
  scene.type.view().at(30, 150) = kCellObstacle;
  const Image<Rgb8> after = map_picture(scene.input());
  ASSERT_EQ(free.width(), after.width());
  ASSERT_EQ(free.height(), after.height());
  EXPECT_EQ(before.width(), after.width());
  int changed = 0;
  for (int y = 0; y < after.height(); ++y) {
    for (int x = 0; x < after.width(); ++x) {
      if (same(after.view().at(x, y), free.view().at(x, y))) continue;
      ++changed;
      EXPECT_LT(brightness(after.view().at(x, y)), 330);
      EXPECT_GT(x, after.width() / 2) << "the whole map is on the right";
    }
  }
  EXPECT_EQ(changed, 16);
}

TEST(MapPicture, ShowsWhetherTheWayIsBlocked) {
  Scene scene(64, 48);
  const Image<Rgb8> blocked = map_picture(scene.input());
  EXPECT_GT(pixels_of(blocked, kBlockedColor), 5000);
  scene.choose(0.3, 2);
  const Image<Rgb8> open = map_picture(scene.input());
  EXPECT_LT(pixels_of(open, kBlockedColor), pixels_of(blocked, kBlockedColor) / 2);
  EXPECT_GT(pixels_of(open, kChosenColor), pixels_of(blocked, kChosenColor) + 500);
  EXPECT_GT(pixels_of(open, kOpeningColor), pixels_of(blocked, kOpeningColor) + 500);
}

TEST(MapPicture, TheRecoveryTurnsToItsSide) {
  Scene scene(64, 48);
  scene.frame.plan.recovery = Side::left;
  const Image<Rgb8> left = map_picture(scene.input());
  scene.frame.plan.recovery = Side::right;
  const Image<Rgb8> right = map_picture(scene.input());
  EXPECT_GT(pixels_that(left, [](Rgb8 c) { return same(c, kBlockedColor); }), 5000);
  ASSERT_EQ(left.width(), right.width());
  int different = 0;
  for (int y = 0; y < left.height(); ++y) {
    for (int x = 0; x < left.width(); ++x)
      different += same(left.view().at(x, y), right.view().at(x, y)) ? 0 : 1;
  }
  EXPECT_GT(different, 300);
}

TEST(MapPicture, BlockedSectorsAreShadedOnTheirSide) {
  Scene scene(64, 48);
  scene.choose(0, 2);
  const auto panel = [&] {
    Canvas sheet(800, 400, kPaper);
    draw_histogram(sheet, {100, 100, 600, 200}, scene.input());
    return sheet.image();
  };
  const Image<Rgb8> free = panel();
  scene.frame.plan.binary[sector_index(9)] = true;  // 45 degrees to the left
  scene.frame.plan.histogram[sector_index(9)] = 400;
  const Image<Rgb8> blocked = panel();
  const auto x = static_cast<int>(100 + (18 + 0.5 - 9) * 600 / 37);
  EXPECT_LT(blocked.view().at(x, 110).g, free.view().at(x, 110).g) << "shaded";
  EXPECT_LT(brightness(blocked.view().at(x, 290)), 300) << "the bar";
  const int mirrored = 800 - x;
  EXPECT_TRUE(same(blocked.view().at(mirrored, 110), free.view().at(mirrored, 110)));
}

// ---- the sheets, whatever comes

TEST(Sheets, TinyImagesAndNothingKnown) {
  for (const int side : {1, 2, 16}) {
    const Scene scene(side, side);
    EXPECT_EQ(classes_picture(scene.input()).width(), side);
    EXPECT_EQ(disparity_picture(scene.input()).height(), side);
    expect_sheets_sound(scene, "side " + std::to_string(side));
  }
}

TEST(Sheets, ImagesOfAnyShape) {
  const std::array<std::array<int, 2>, 5> sizes = {{{1226, 370}, {1282, 1110}, {3000, 20}, {20, 3000}, {640, 480}}};
  for (const auto& size : sizes) {
    const Scene scene(size[0], size[1]);
    expect_sound(summary_picture(scene.input()), std::to_string(size[0]) + "x" + std::to_string(size[1]));
  }
}

TEST(Sheets, MapsOfAnyShape) {
  for (const GridGeometry g : {GridGeometry{10, 10, 100}, GridGeometry{10, 1000, 20}, GridGeometry{1000, 10, 1000},
                               GridGeometry{200, 200, 100}}) {
    Scene scene(64, 48, g);
    scene.type.view().at(g.cols / 2, g.rows / 2) = kCellUnoccupied;
    scene.put_obstacle(g.rows - 1, 0, 300);
    expect_sheets_sound(scene, std::to_string(g.rows) + "x" + std::to_string(g.cols));
  }
}

TEST(Sheets, DirectionsAllRound) {
  for (const double target : {-3.1, -1.6, 0.0, 1.6, 3.14}) {
    Scene scene(64, 48);
    scene.target = target;
    scene.choose(-target, 0);
    scene.frame.plan.openings.items[0] = {.first = 30, .count = 72};
    expect_sheets_sound(scene, "target " + std::to_string(target));
  }
}

TEST(Sheets, ExtremesOfTheConfiguration) {
  Scene scene(64, 48);
  scene.config.planner.active_radius_m = 100;
  scene.config.camera = {
      .height_m = 5, .pitch_deg = 60, .roll_deg = 30, .yaw_deg = 180, .forward_m = -5, .left_m = 5};
  scene.config.vehicle.radius_m = 5;
  scene.config.planner.threshold_low = 100'000;
  scene.config.planner.threshold_high = 100'000;
  scene.frame.plan.histogram.fill(4'000'000'000U);
  scene.frame.times.took.fill(1'000'000'000'000);
  expect_sheets_sound(scene, "large");
  scene.config.planner.active_radius_m = 0.5;
  scene.config.vehicle.radius_m = 0.05;
  scene.config.vehicle.safety_distance_m = 0;
  scene.config.planner.threshold_low = 1;
  scene.config.planner.threshold_high = 1;
  scene.config.prune.clearance_m = 0.1;
  expect_sheets_sound(scene, "small");
}

TEST(Sheets, ALongTitleIsCut) {
  const Scene scene(64, 48);
  const PictureInput input{scene.frame, scene.camera, scene.config, 0, 0, std::string(10'000, 'W') + "\xc3\xa4\n"};
  const Image<Rgb8> picture = summary_picture(input);
  for (int y = 0; y < 80; ++y)
    EXPECT_TRUE(gray_ink(picture.view().at(picture.width() - 5, y)));
}

TEST(Sheets, TheSummaryShowsTheImagesAsTheyAre) {
  Scene scene(640, 480);
  for (int v = 100; v < 200; ++v) {
    for (int u = 100; u < 200; ++u)
      scene.put_disparity(u, v, PixelClass::obstacle, 30);
  }
  const Image<Rgb8> picture = summary_picture(scene.input());
  EXPECT_GE(pixels_of(picture, class_color(PixelClass::obstacle, 480, 120)), 10'000);
  EXPECT_GE(pixels_of(picture, disparity_color(30, 30)), 10'000);
  EXPECT_GE(pixels_of(picture, {120, 120, 120}), 640 * 480);
}

TEST(Sheets, ARenderedSceneEndToEnd) {
  const char* data = std::getenv("LAKSHYA_DATA");
  if (data == nullptr) GTEST_SKIP() << "LAKSHYA_DATA is not set";
  const std::string scene = std::string(data) + "/rendered/s2/";
  if (!std::filesystem::exists(scene + "left.png")) GTEST_SKIP() << scene << " is missing";
  VehicleConfig config;
  config.camera.pitch_deg = 5;
  const Image<std::uint8_t> left = read_gray(scene + "left.png");
  const Image<std::uint8_t> right = read_gray(scene + "right.png");
  const MonotonicClock clock;
  Pipeline pipeline(config, read_calibration(scene + "calib.txt"), left.width(), left.height(), kReferenceKernels,
                    clock);
  FrameResult frame;
  ASSERT_EQ(pipeline.process(left.view(), right.view(), {}, frame), Status::ok);
  const PictureInput input{frame, pipeline.camera(), config, 0, pipeline.blind_zone(), "s2"};
  const Rgb8 box = classes_picture(input).view().at(255, 300);
  EXPECT_GT(box.r, box.g + 40);
  const Rgb8 floor = classes_picture(input).view().at(320, 460);
  EXPECT_GT(floor.g, floor.r + 20);
  expect_sound(map_picture(input), "map");
  expect_sound(summary_picture(input), "summary");
}

}  // namespace
}  // namespace lakshya
