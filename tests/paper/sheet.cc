#include "tests/paper/sheet.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "app/core/image_file.h"
#include "app/tools/picture_colors.h"
#include "tests/paper/cloud_plots.h"

namespace lakshya::paper {
namespace {

constexpr int kMargin = 30;
constexpr int kGap = 30;
constexpr int kColumn = 420;
constexpr int kSheetWidth = 2 * kMargin + 3 * kColumn + 2 * kGap;
constexpr int kAxis = 46;
constexpr int kImageHeight = 315;
constexpr int kSideHeight = 170;
constexpr int kTopHeight = 400;

constexpr int kImagesTop = 128;
constexpr int kNotesTop = kImagesTop + kImageHeight + 10;
constexpr int kSideTop = kNotesTop + 172;
constexpr int kTopTop = kSideTop + kSideHeight + 86;
constexpr int kLegendTop = kTopTop + kTopHeight + 56;
constexpr int kSheetHeight = kLegendTop + 100;

int column_x(int column) {
  return kMargin + column * (kColumn + kGap);
}

void caption(Canvas& sheet, int column, int top, const std::string& text) {
  sheet.text({static_cast<double>(column_x(column)), top - 9.0}, text, kHeadText, kInk);
}

// ---- the images

// The name of each object at its innermost pixel.
void draw_names(Canvas& sheet, const Box& box, const test::RenderedPair& pair, double scale) {
  const auto view = pair.left.object.view();
  const cv::Mat object(view.height, view.width, CV_8U, const_cast<std::uint8_t*>(view.data));  // only read
  for (int id = 1; id < kObjects; ++id) {
    cv::Mat inside;
    cv::copyMakeBorder(object == id, inside, 1, 1, 1, 1, cv::BORDER_CONSTANT, 0);
    cv::Mat distance;
    cv::distanceTransform(inside, distance, cv::DIST_C, 3);
    double widest = 0;
    cv::Point at;
    cv::minMaxLoc(distance, nullptr, &widest, nullptr, &at);
    if (widest < 4) continue;
    const std::string name = to_string(static_cast<Object>(id));
    const int width = text_width(name, kBodyText);
    const int x =
        std::clamp(box.x + static_cast<int>(at.x * scale) - width / 2, box.x + 4, box.right() - width - 4);
    const int y = std::clamp(box.y + static_cast<int>(at.y * scale), box.y + 12, box.bottom() - 12);
    sheet.fill({x - 4, y - 9, width + 8, 18}, kPaper, 0.8);
    sheet.text({static_cast<double>(x), y + kBodyText / 2}, name, kBodyText, kInk);
  }
}

std::vector<Fact> facts(const PictureInput& input) {
  const CameraConfig& mount = input.config.camera;
  const PruneConfig& prune = input.config.prune;
  return {{"images", std::to_string(input.camera.width) + " x " + std::to_string(input.camera.height) + " px, f " +
                         decimal(input.camera.focal_px, 0) + " px"},
          {"baseline", decimal(input.camera.baseline_m, 2) + " m"},
          {"mount", decimal(mount.height_m, 2) + " m high, " + decimal(mount.pitch_deg, 0) + " deg nose down"},
          {"pruning",
           "depth " + decimal(prune.max_depth_m, 1) + " m, clearance " + decimal(prune.clearance_m, 1) + " m"},
          {"profile", input.config.profile}};
}

// In 16 levels per channel, which hardly shows and makes the file half as large: noise is what PNG cannot pack.
Image<Rgb8> coarse(Image<Rgb8> image) {
  const auto level = [](std::uint8_t value) { return static_cast<std::uint8_t>(value / 16 * 17); };
  const auto view = image.view();
  for (int y = 0; y < view.height; ++y) {
    for (int x = 0; x < view.width; ++x) {
      Rgb8& c = view.at(x, y);
      c = {level(c.r), level(c.g), level(c.b)};
    }
  }
  return image;
}

LegendItem share_item(const FrameResult& frame, const char* name, PixelClass pixel_class, std::int16_t reason) {
  constexpr std::uint8_t kGray = 150;
  const double pixels = frame.pixels.by_class[static_cast<int>(pixel_class)];
  const double all = static_cast<double>(frame.left.width) * frame.left.height;
  return filled_item(std::string(name) + " " + decimal(100 * pixels / all, 1) + "%",
                     class_color(pixel_class, reason, kGray));
}

void draw_images(Canvas& sheet, const test::RenderedPair& pair, const PictureInput& input) {
  const FrameResult& frame = input.frame;
  const double scale = std::min(static_cast<double>(kColumn) / frame.left.width,
                                static_cast<double>(kImageHeight) / frame.left.height);
  const auto place = [&](int column) {
    return Box{column_x(column), kImagesTop, static_cast<int>(frame.left.width * scale),
               static_cast<int>(frame.left.height * scale)};
  };
  caption(sheet, 0, kImagesTop, "Left image of the pair");
  sheet.paste(gray_picture(frame.left).view(), place(0));
  draw_names(sheet, place(0), pair, scale);
  draw_facts(sheet, {column_x(0), kNotesTop, kColumn, 0}, facts(input));

  caption(sheet, 1, kImagesTop, "Disparity, matched");
  sheet.paste(disparity_picture(input).view(), place(1));
  draw_disparity_bar(sheet, {column_x(1), kNotesTop, kColumn, 0}, input);

  caption(sheet, 2, kImagesTop, "What pruning says of each pixel");
  sheet.paste(classes_picture(input).view(), place(2));
  draw_legend(
      sheet, {static_cast<double>(column_x(2)), static_cast<double>(kNotesTop)}, kColumn,
      {share_item(frame, "obstacle", PixelClass::obstacle, 0), share_item(frame, "floor", PixelClass::floor, 0),
       share_item(frame, "ceiling", PixelClass::ceiling, 0), share_item(frame, "too far", PixelClass::too_far, 0),
       share_item(frame, "drop-off", PixelClass::drop_off, 0),
       share_item(frame, "no disparity, darkened by reason", PixelClass::no_disparity, kNotUnique)});
}

// ---- points and map

Box plot_at(int column, int top, int height) {
  return {column_x(column) + kAxis, top, kColumn - kAxis, height};
}

void draw_clouds(Canvas& sheet, const PaperScene& scene, const test::RenderedPair& pair,
                 const Experiment& experiment, const PlotReach& reach, const MapView& view) {
  const Cloud before = whole_cloud(pair, experiment.last());
  const Cloud after = pruned_cloud(pair, experiment.last());
  const PruneConfig& limits = experiment.last().config().prune;
  int column = 0;
  for (const Cloud* cloud : {&before, &after}) {
    const std::string when = column == 0 ? "before pruning" : "after pruning";
    caption(sheet, column, kSideTop - 14, "Points " + when + ", from the side");
    draw_side_view(sheet, plot_at(column, kSideTop, kSideHeight), scene, *cloud, limits, reach.ahead_m, reach.up_m);
    caption(sheet, column, kTopTop - 14, "Points " + when + ", from above");
    draw_top_view(sheet, plot_at(column, kTopTop, kTopHeight), view, scene, *cloud);
    ++column;
  }
}

LegendItem outline_item() {
  return {"true outline, in its object's colour",
          [](Canvas& canvas, const Box& swatch) { canvas.frame(swatch, kInk); }};
}

void draw_legends(Canvas& sheet, const ObjectCounts& before, const PictureInput& input) {
  std::vector<LegendItem> items;
  for (int id = 1; id < kObjects; ++id) {
    const auto o = static_cast<Object>(id);
    if (of(before, o) > 0) items.push_back(filled_item(std::string("points of the ") + to_string(o), color_of(o)));
  }
  items.push_back(outline_item());
  const int width = kSheetWidth - 2 * kMargin;
  const int used = draw_legend(sheet, {kMargin, kLegendTop}, width, items);
  draw_legend(sheet, {kMargin, static_cast<double>(kLegendTop + used)}, width, map_legend(input));
}

}  // namespace

void write_sheet(const PaperScene& scene, const test::RenderedPair& pair, const Experiment& experiment,
                 const PlotReach& reach) {
  const char* folder = std::getenv("LAKSHYA_PICTURES");
  if (folder == nullptr) return;
  const ProcessedFrame& run = experiment.last();
  const PictureInput input{run.frame(), run.pipeline().camera(),     run.config(),
                           0,           run.pipeline().blind_zone(), scene.title};
  Canvas sheet(kSheetWidth, kSheetHeight, kPaper);
  sheet.text({kMargin, 30 + kTitleText}, scene.title, kTitleText, kInk, Align::left, 2);
  sheet.text({kMargin, 78}, text_that_fits(scene.remark, kBodyText, kSheetWidth - 2 * kMargin), kBodyText,
             kFaintInk);
  draw_images(sheet, pair, input);

  const Box map = plot_at(2, kTopTop, kTopHeight);
  const double per_metre = (map.height - 50) / reach.ahead_m;
  const MapView view{{map.width / 2.0, static_cast<double>(map.height - map_behind_px(per_metre, run.config()))},
                     per_metre};
  draw_clouds(sheet, scene, pair, experiment, reach, view);
  caption(sheet, 2, kSideTop - 14, "Points kept, step by step");
  draw_step_bars(sheet, {column_x(2), kSideTop, kColumn, 0}, experiment.kept);
  caption(sheet, 2, kTopTop - 14, "Navigation map. " + command_text(run.frame().plan));
  draw_map(sheet, map, view, input, MapDetail::overview, "");
  Canvas area = sheet.part(map);
  draw_outlines(area, view, scene);
  draw_legends(sheet, experiment.kept[0], input);

  std::filesystem::create_directories(folder);
  write_png((std::filesystem::path(folder) / (scene.name + ".png")).string(), coarse(sheet.image()).view());
}

}  // namespace lakshya::paper
