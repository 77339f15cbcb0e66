// Private to picture_*.cc: the panels that the sheets are made of.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "app/tools/picture_canvas.h"
#include "app/tools/pictures.h"

namespace lakshya {

// ---- picture_images.cc

// Ends of the colour scale, px. `last` is the 99.5th percentile of the disparities present, at least 1; `first` is 0, or
// the 0.5th percentile where that is beyond half of `last` (a near scene, or a rig with a large doffs).
struct DisparityScale {
  double first = 0;
  double last = 1;
};
DisparityScale disparity_scale(ImageView<const std::int16_t> disparity);
Image<Rgb8> gray_picture(ImageView<const std::uint8_t> gray);

// ---- picture_map.cc

// Room that a map's plot needs around it for caption and axes.
inline constexpr int kMapLeft = 46;
inline constexpr int kMapTop = 30;
inline constexpr int kMapBottom = 46;

enum class MapDetail { full, overview };

// From metres in the body frame to px of a plot; the vehicle at the bottom centre, looking up.
struct MapView {
  Point origin;      // the turning centre
  double scale = 1;  // px per metre
  Point at(double forward_m, double left_m) const {
    return {origin.x - left_m * scale, origin.y - forward_m * scale};
  }
};

// Room below the turning centre: for the vehicle and the scale bar.
int map_behind_px(double scale, const VehicleConfig& config);
// The whole grid in a plot of this size.
MapView whole_map_view(const PictureInput& input, int width, int height);
// The cells that are known, up to 1.5 active radii away; without any, the active radius.
MapView near_map_view(const PictureInput& input, int width, int height);

// The map in `plot`, its caption above and its axes beside. Overview: without labels inside.
void draw_map(Canvas& sheet, const Box& plot, const MapView& view, const PictureInput& input, MapDetail detail,
              const std::string& caption);

// ---- picture_histogram.cc

inline constexpr int kHistogramLeft = 60;
inline constexpr int kHistogramRight = 76;
inline constexpr int kHistogramTop = 70;
inline constexpr int kHistogramBottom = 84;

void draw_histogram(Canvas& sheet, const Box& plot, const PictureInput& input);

// ---- picture_legends.cc

struct LegendItem {
  std::string text;
  std::function<void(Canvas& canvas, const Box& swatch)> draw;
};

LegendItem filled_item(const std::string& text, Rgb8 color);
LegendItem line_item(const std::string& text, Rgb8 color, double thickness, Stroke stroke);

inline constexpr int kLegendRow = 26;
// Items one after another, in as many rows as they need; returns the height used.
int draw_legend(Canvas& sheet, Point top_left, int width, const std::vector<LegendItem>& items);
std::vector<LegendItem> map_legend(const PictureInput& input);

void draw_disparity_bar(Canvas& sheet, const Box& box, const PictureInput& input);
void draw_class_counts(Canvas& sheet, const Box& box, const PictureInput& input);

// ---- picture_texts.cc

struct Fact {
  std::string name;
  std::string value;
};
void draw_facts(Canvas& sheet, const Box& box, const std::vector<Fact>& facts);
std::vector<Fact> camera_facts(const PictureInput& input);
void draw_command(Canvas& sheet, const Box& box, const PictureInput& input);

// "+5.0 deg", or "blocked: turn left on the spot".
std::string command_text(const Plan& plan);

}  // namespace lakshya
