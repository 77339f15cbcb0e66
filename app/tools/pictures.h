// Pictures of one processed frame, for people: what the matcher, the pruning, the map and the planner made of it.
//
// `frame` is one that Pipeline::process() filled, of any image size and any map; disparity, classes and left agree
// in size. Nothing is thrown but std::bad_alloc. Directions are shown in degrees counter-clockwise from straight
// ahead, so that left is positive, and left is on the left everywhere.
#pragma once

#include <string>

#include "app/core/calibration.h"
#include "app/core/image.h"
#include "app/core/pipeline.h"
#include "app/core/vehicle_config.h"

namespace lakshya {

struct PictureInput {
  const FrameResult& frame;
  const RectifiedGeometry& camera;
  const VehicleConfig& config;
  double target_rad;    // where the planner was asked to go, finite
  double blind_zone_m;  // Pipeline::blind_zone()
  std::string title;    // ASCII (other characters become '?'), cut where it does not fit
};

// Disparity in colour, pixel for pixel: from dark blue (far) through green to red (near). The scale runs from 0 (from
// the smallest present, in a scene that is near as a whole) to the 99.5th percentile. Dark grey: no disparity.
Image<Rgb8> disparity_picture(const PictureInput& input);

// The rectified left image, pixel for pixel, tinted by what pruning decided: obstacle red, floor green, ceiling
// blue, drop-off magenta, too far untinted. Where there is no disparity it is darkened, with a slight tint for the
// reason. The legend is on the summary.
Image<Rgb8> classes_picture(const PictureInput& input);

// The whole navigation map (at least 4 px per cell) and its part near the vehicle, both seen from above with the
// vehicle at the bottom looking up, the polar histogram below, and a legend.
Image<Rgb8> map_picture(const PictureInput& input);

// Everything on one sheet 2000 px wide: images, disparity scale in px and metres, pixel counts, maps, histogram,
// the command and the time of each stage.
Image<Rgb8> summary_picture(const PictureInput& input);

}  // namespace lakshya
