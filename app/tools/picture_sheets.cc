// The two sheets: map_picture and summary_picture. Only layout happens here.
#include <algorithm>
#include <array>
#include <cmath>

#include "app/tools/picture_colors.h"
#include "app/tools/picture_panels.h"
#include "app/tools/pictures.h"

namespace lakshya {
namespace {

constexpr int kMargin = 30;
constexpr int kGap = 30;
constexpr int kTitleHeight = 52;
constexpr int kCaption = 24;
constexpr int kNearSide = 800;  // px, the near map's plot

void draw_title(Canvas& sheet, const std::string& title) {
  sheet.text({kMargin, kMargin + kTitleText}, text_that_fits(title, kTitleText, sheet.width() - 2 * kMargin - 40),
             kTitleText, kInk, Align::left, 2);
  sheet.fill({kMargin, kMargin + kTitleHeight - 18, sheet.width() - 2 * kMargin, 1}, kRule);
}

std::string near_caption() {
  return "Navigation map near the vehicle";
}

std::string whole_caption(const PictureInput& input) {
  const GridGeometry& g = input.frame.grid.geometry;
  return "Whole map: " + std::to_string(g.rows) + " x " + std::to_string(g.cols) + " cells of " +
         decimal(g.cell_mm / 1000.0, 2) + " m";
}

void draw_near_map(Canvas& sheet, const Box& plot, const PictureInput& input) {
  draw_map(sheet, plot, near_map_view(input, plot.width, plot.height), input, MapDetail::full, near_caption());
}

void draw_whole_map(Canvas& sheet, const Box& plot, const PictureInput& input) {
  draw_map(sheet, plot, whole_map_view(input, plot.width, plot.height), input, MapDetail::overview,
           whole_caption(input));
}

// ---- the camera's images on the summary

// Fits the cell; enlarged by whole factors only, so that every pixel keeps its shape.
Box fitted(int width, int height, int most_width, int most_height) {
  double scale = std::min(static_cast<double>(most_width) / width, static_cast<double>(most_height) / height);
  if (scale > 1) scale = std::floor(scale);
  return {0, 0, std::max(1, static_cast<int>(std::lround(width * scale))),
          std::max(1, static_cast<int>(std::lround(height * scale)))};
}

struct ImagePanel {
  std::string caption;
  Image<Rgb8> picture;
  std::function<void(Canvas&, const Box&)> draw_notes;
};

std::array<ImagePanel, 3> image_panels(const PictureInput& input) {
  return {ImagePanel{"Left image, rectified", gray_picture(input.frame.left),
                     [&](Canvas& sheet, const Box& box) { draw_facts(sheet, box, camera_facts(input)); }},
          ImagePanel{"Disparity", disparity_picture(input),
                     [&](Canvas& sheet, const Box& box) { draw_disparity_bar(sheet, box, input); }},
          ImagePanel{"Pixel classes", classes_picture(input),
                     [&](Canvas& sheet, const Box& box) { draw_class_counts(sheet, box, input); }}};
}

// Where the three images and their notes go. Side by side with the notes below; wide images two by two, with the
// last one's notes in the fourth place.
class ImageLayout {
 public:
  static constexpr int kSheetWidth = 2040;

  ImageLayout(int width, int height)
      : columns_(width > 2.2 * height ? 2 : 3), image_(fitted(width, height, column_width(), kMostHeight)) {}

  Box image(int panel, int top) const {
    const int row = panel / columns_;
    return {kMargin + panel % columns_ * (column_width() + kGap), top + kCaption + row * first_row_height(),
            image_.width, image_.height};
  }
  Box notes(int panel, int top) const {
    const Box picture = image(panel, top);
    if (panel >= columns_) return {picture.x + column_width() + kGap, picture.y, kNotesWidth, kNotesHeight};
    return {picture.x, picture.bottom() + kNotesGap, kNotesWidth, kNotesHeight};
  }
  int height() const {
    if (columns_ == 3) return first_row_height();
    return first_row_height() + kCaption + std::max(image_.height, kNotesHeight) + kGap;
  }

 private:
  static constexpr int kMostHeight = 900;
  static constexpr int kNotesWidth = 640;
  static constexpr int kNotesHeight = 140;
  static constexpr int kNotesGap = 10;

  int column_width() const { return (kSheetWidth - 2 * kMargin - (columns_ - 1) * kGap) / columns_; }
  int first_row_height() const { return kCaption + image_.height + kNotesGap + kNotesHeight + kGap; }

  int columns_;
  Box image_;
};

void draw_images(Canvas& sheet, int top, const ImageLayout& layout, const PictureInput& input) {
  int index = 0;
  for (const ImagePanel& panel : image_panels(input)) {
    const Box box = layout.image(index, top);
    sheet.text({static_cast<double>(box.x), box.y - 9.0}, panel.caption, kHeadText, kInk);
    sheet.paste(panel.picture.view(), box);
    panel.draw_notes(sheet, layout.notes(index, top));
    ++index;
  }
}

// ---- map, histogram and command on the summary

constexpr int kWholeSide = 470;  // px, the whole map's plot on the summary
constexpr int kPlanHeight = kMapTop + kNearSide + kMapBottom;

void draw_plan(Canvas& sheet, int top, const PictureInput& input) {
  const Box near{kMargin + kMapLeft, top + kMapTop, kNearSide, kNearSide};
  draw_near_map(sheet, near, input);
  const Box whole{near.right() + kGap + kMapLeft, near.y, kWholeSide, 400};
  draw_whole_map(sheet, whole, input);
  const int right = sheet.width() - kMargin;
  const int command_left = whole.right() + kGap + 10;
  draw_command(sheet, {command_left, near.y, right - command_left, whole.height}, input);
  const int left = near.right() + kGap + kHistogramLeft;
  const int histogram_top = whole.bottom() + kMapBottom + kHistogramTop;
  draw_histogram(sheet,
                 {left, histogram_top, right - kHistogramRight - left,
                  near.bottom() + kMapBottom - kHistogramBottom - histogram_top},
                 input);
}

int legend_height(int width, const PictureInput& input) {
  Canvas measure(1, 1, kPaper);
  return draw_legend(measure, {0, 0}, width, map_legend(input));
}

}  // namespace

Image<Rgb8> map_picture(const PictureInput& input) {
  constexpr int kHistogramHeight = 240;
  constexpr int kLeastPerCell = 4;
  const GridGeometry& g = input.frame.grid.geometry;
  const int per_cell = std::max(kLeastPerCell, kNearSide / std::max(g.cols, g.rows));
  const double scale = 1000.0 * per_cell / g.cell_mm;
  const Box near{kMargin + kMapLeft, kMargin + kTitleHeight + kMapTop, kNearSide, kNearSide};
  const Box whole{near.right() + kGap + kMapLeft, near.y, g.cols * per_cell,
                  g.rows * per_cell + map_behind_px(scale, input.config)};

  const int width = std::max(whole.right() + kMargin, 1400);
  const int maps_bottom = std::max(near.bottom(), whole.bottom()) + kMapBottom;
  const int legend_top = maps_bottom + 10;
  const int legend = legend_height(width - 2 * kMargin, input);
  const int histogram_top = legend_top + legend + kGap + kHistogramTop;
  Canvas sheet(width, histogram_top + kHistogramHeight + kHistogramBottom + kMargin, kPaper);
  draw_title(sheet, input.title);
  draw_near_map(sheet, near, input);
  draw_whole_map(sheet, whole, input);
  draw_legend(sheet, {kMargin, static_cast<double>(legend_top)}, width - 2 * kMargin, map_legend(input));
  const int left = kMargin + kHistogramLeft;
  draw_histogram(sheet,
                 {left, histogram_top, std::min(width, 2040) - kMargin - kHistogramRight - left, kHistogramHeight},
                 input);
  return sheet.image();
}

Image<Rgb8> summary_picture(const PictureInput& input) {
  const ImageLayout layout(std::max(input.frame.left.width, 1), std::max(input.frame.left.height, 1));
  const int width = ImageLayout::kSheetWidth;
  const int images_top = kMargin + kTitleHeight;
  const int plan_top = images_top + layout.height();
  const int legend_top = plan_top + kPlanHeight + 12;
  const int legend = legend_height(width - 2 * kMargin, input);
  Canvas sheet(width, legend_top + legend + kMargin, kPaper);
  draw_title(sheet, input.title);
  draw_images(sheet, images_top, layout, input);
  draw_plan(sheet, plan_top, input);
  draw_legend(sheet, {kMargin, static_cast<double>(legend_top)}, width - 2 * kMargin, map_legend(input));
  return sheet.image();
}

}  // namespace lakshya
