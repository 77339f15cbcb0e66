// The paper's edge images and the disparity found on them (its figs. 3 and 4): the sum of absolute differences sees
// edges, not brightness, so that two cameras need not be equally bright.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>

#include "app/core/image_file.h"
#include "app/tools/disparity_estimate.h"
#include "app/tools/ground_truth.h"
#include "app/tools/picture_canvas.h"
#include "app/tools/picture_colors.h"
#include "app/tools/picture_panels.h"
#include "kernels/edge/edge.h"
#include "tests/paper/experiment.h"

namespace lakshya::paper {
namespace {

constexpr int kCap = 31;
constexpr double kLargestPx = 62;  // the floor at the image's bottom
constexpr int kDarker = 40;        // grey levels, the right camera against the left

PaperScene edge_scene() {
  PaperScene scene{.name = "edge_images", .title = "", .remark = ""};
  scene.rig.pitch_deg = 8;
  add_floor(scene);
  add_thing(scene, Object::box, {{2.6, 0.5, 0}, {0.4, 0.6, 0.6}}, {.gray = 90, .contrast = 40, .seed = 21});
  add_thing(scene, Object::box, {{3.4, -0.9, 0}, {0.4, 0.4, 1.1}}, {.gray = 200, .contrast = 40, .seed = 23});
  add_thing(scene, Object::wall, {{6.1, 0, 0}, {0.2, 12, 3}}, {.gray = 160, .contrast = 45, .seed = 31});
  return scene;
}

Image<std::uint8_t> edges(const Image<std::uint8_t>& image, const std::string& filter) {
  Image<std::uint8_t> out(image.width(), image.height());
  const auto kernel = filter == "log" ? edge_log_ref : edge_sobel_ref;
  EXPECT_EQ(kernel(image.view(), kCap, {0, image.height()}, out.view()), Status::ok);
  return out;
}

Image<std::uint8_t> darker(const Image<std::uint8_t>& image) {
  Image<std::uint8_t> out(image.width(), image.height());
  for (int v = 0; v < image.height(); ++v) {
    for (int u = 0; u < image.width(); ++u)
      out.view().at(u, v) = static_cast<std::uint8_t>(std::max(image.view().at(u, v) - kDarker, 0));
  }
  return out;
}

class EdgeImages : public testing::Test {
 protected:
  DisparityEstimate match(const std::string& edge, const Image<std::uint8_t>& right) const {
    MatcherConfig config;
    config.name = "sad";
    config.edge = edge;
    config.edge_cap = kCap;
    return match_pair(config, kReferenceKernels, pair_.left.gray, right);
  }
  DisparityErrors errors(const DisparityEstimate& estimate) const {
    return compare_disparity(estimate.disparity.view(), pair_.disparity.view(), 64);
  }

  PaperScene scene_ = edge_scene();
  const test::RenderedPair& pair_ = rendered(scene_);
};

TEST_F(EdgeImages, BrightnessIsNoEdge) {
  for (const char* filter : {"log", "sobel"}) {
    Image<std::uint8_t> bright(60, 40);
    for (int v = 0; v < 40; ++v) {
      for (int u = 0; u < 60; ++u)
        bright.view().at(u, v) = static_cast<std::uint8_t>(kDarker + (u * 7 + v * 13 + u * v) % 150);
    }
    const Image<std::uint8_t> a = edges(bright, filter);
    const Image<std::uint8_t> b = edges(darker(bright), filter);
    EXPECT_TRUE(std::equal(a.view().data, a.view().data + 60 * std::ptrdiff_t{40}, b.view().data)) << filter;
  }
}

TEST_F(EdgeImages, SumsOfAbsoluteDifferencesFindTheSceneOnThem) {
  for (const char* filter : {"log", "sobel"}) {
    const DisparityErrors e = errors(match(filter, pair_.right.gray));
    EXPECT_GT(e.density, 0.75) << filter;
    EXPECT_LT(e.bad2, 0.02) << filter;
  }
}

// Only where the darker image reaches black something is lost.
TEST_F(EdgeImages, ADarkerCameraMakesNoDifference) {
  const Image<std::uint8_t> dark = darker(pair_.right.gray);
  for (const char* filter : {"log", "sobel"}) {
    const DisparityErrors same = errors(match(filter, pair_.right.gray));
    const DisparityErrors other = errors(match(filter, dark));
    EXPECT_GT(other.density, same.density - 0.05) << filter;
    EXPECT_LT(other.bad2, same.bad2 + 0.005) << filter;
  }
}

// ---- the sheet

Image<Rgb8> disparity_image(ImageView<const std::int16_t> disparity) {
  Image<Rgb8> out(disparity.width, disparity.height);
  for (int v = 0; v < disparity.height; ++v) {
    for (int u = 0; u < disparity.width; ++u) {
      const std::int16_t d = disparity.at(u, v);
      out.view().at(u, v) = d < 0 ? kNoDisparityColor : disparity_color(d / 16.0, kLargestPx);
    }
  }
  return out;
}

Image<Rgb8> edge_picture(const Image<std::uint8_t>& edge) {
  Image<std::uint8_t> stretched(edge.width(), edge.height());
  for (int v = 0; v < edge.height(); ++v) {
    for (int u = 0; u < edge.width(); ++u)
      stretched.view().at(u, v) = static_cast<std::uint8_t>(edge.view().at(u, v) * 255 / (2 * kCap));
  }
  return gray_picture(std::as_const(stretched).view());
}

TEST_F(EdgeImages, Sheet) {
  const char* folder = std::getenv("LAKSHYA_PICTURES");
  if (folder == nullptr) GTEST_SKIP() << "LAKSHYA_PICTURES names no folder";
  constexpr int kWidth = 320;
  constexpr int kHeight = 240;
  constexpr int kMargin = 30;
  constexpr int kTop = 126;
  constexpr int kRow = kHeight + 50;
  Canvas sheet(3 * (kWidth + kMargin) + kMargin, kTop + 2 * kRow, kPaper);
  sheet.text({kMargin, 44}, "Edge images and disparity (the paper's figs. 3 and 4)", kTitleText, kInk);
  sheet.text(
      {kMargin, 76},
      "Sums of absolute differences (SAD) compare edges: mid grey is no edge, light and dark are its two signs.",
      kBodyText, kFaintInk);
  int panel = 0;
  const auto place = [&](const Image<Rgb8>& image, const std::string& caption) {
    const Box box{kMargin + panel % 3 * (kWidth + kMargin), kTop + panel / 3 * kRow, kWidth, kHeight};
    sheet.text({static_cast<double>(box.x), box.y - 9.0}, caption, kHeadText, kInk);
    sheet.paste(image.view(), box);
    ++panel;
  };
  const auto matched = [&](const std::string& filter, const std::string& name) {
    const DisparityEstimate estimate = match(filter, pair_.right.gray);
    place(disparity_image(estimate.disparity.view()),
          "SAD on " + name + ": " + decimal(100 * errors(estimate).density, 0) + " % matched");
  };
  place(gray_picture(pair_.left.gray.view()), "Left image");
  place(edge_picture(edges(pair_.left.gray, "log")), "Laplacian of Gaussian (LoG)");
  place(edge_picture(edges(pair_.left.gray, "sobel")), "x-Sobel");
  place(disparity_image(pair_.disparity16.view()), "True disparity (warm is near)");
  matched("log", "LoG");
  matched("sobel", "x-Sobel");
  std::filesystem::create_directories(folder);
  write_png(std::string(folder) + "/edge_images.png", sheet.image().view());
}

}  // namespace
}  // namespace lakshya::paper
