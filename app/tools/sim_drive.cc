#include "app/tools/sim_drive.h"

#include <unistd.h>

#include "app/core/file_bytes.h"
#include "app/core/image_file.h"
#include "app/tools/output_folder.h"
#include "app/tools/sim_film.h"
#include "app/tools/sim_moments.h"
#include "app/tools/sim_onlookers.h"
#include "app/tools/sim_pictures.h"
#include "app/tools/sim_sheet.h"

namespace lakshya {
namespace {

// The others do not look at the camera's pictures, which are noise then.
bool looks_at_pictures(sim::Sensor sensor) {
  return sensor != sim::Sensor::lidar2d && sensor != sim::Sensor::truth;
}

}  // namespace

void record_course(const std::string& folder, const sim::World& world, const sim::RunResult& result,
                   double vehicle_radius_m) {
  const std::string file =
      world_label(result.world) + "_" + std::to_string(result.seed) + "_" + result.sensor + ".png";
  write_png(folder + "/" + file, course_picture(world, result, vehicle_radius_m).view());
}

sim::RunResult watched_drive(const std::string& name, const sim::World& world, const VehicleConfig& config,
                             const sim::RunSettings& settings, const KernelTable& kernels, const std::string& out) {
  OutputFolder folder(out);  // refuses before the long work, not after it
  const bool has_camera = looks_at_pictures(settings.sensor);
  SimFilm film(config, has_camera);
  SimMoments moments(has_camera);
  sim::RunResult result;
  {
    SimStatus status(::isatty(STDERR_FILENO) != 0);
    Onlookers all({&status, &film, &moments});
    result = run_world(world, config, settings, kernels, &all);
  }
  result.world = name;
  const double radius = config.vehicle.radius_m;
  write_png(folder.file("course.png"), course_picture(world, result, radius).view());
  write_png(folder.file("sheet.png"), drive_sheet(world, result, moments.record(), radius).view());
  film.write(folder.file("drive.webp"), ending_text(result), result.ending == sim::Ending::reached);
  write_file_atomically(folder.file("result.json"), run_json(result).dump(2) + "\n");
  // A drive that ended before its first frame has no film.
  folder.commit("drive.webp");
  return result;
}

}  // namespace lakshya
