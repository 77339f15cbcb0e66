// One picture of the film of a simulated drive (sim_film.h).
#pragma once

#include <string>

#include "app/core/image.h"
#include "app/core/pipeline.h"
#include "app/core/vehicle_config.h"
#include "app/loop/messages.h"

namespace lakshya {

struct FilmPicture {
  const FrameResult& frame;
  const PlanNote& plan;
  const VehicleConfig& config;
  StatusNote status;       // the newest
  double time_s = 0;       // since the drive began
  bool has_camera = true;  // false: what the camera gives is noise that nobody looks at
};

inline constexpr int kFilmWidth = 960;
inline constexpr int kFilmHeight = 424;

// Left what the camera sees, tinted by pixel class; right the navigation map near the vehicle, seen from above; a line of status
// and a legend below.
Image<Rgb8> film_picture(const FilmPicture& input);

// The same picture with a text across it: how the drive ended.
Image<Rgb8> with_ending(const Image<Rgb8>& picture, const std::string& ending, bool ended_well);

// The camera's picture tinted by class, or the classes alone.
Image<Rgb8> tinted_picture(const FrameResult& frame, bool has_camera);

}  // namespace lakshya
