// What `lakshya sim` draws of its drives.
#pragma once

#include <string>

#include "app/core/kernel_table.h"
#include "app/tools/sim/run_world.h"

namespace lakshya {

// Writes FOLDER/<world>_<seed>_<sensor>.png (course_picture); the world's name as a file's name. Throws InputError.
void record_course(const std::string& folder, const sim::World& world, const sim::RunResult& result,
                   double vehicle_radius_m);

// One drive, watched: status on stderr while it goes on, then course.png, sheet.png, drive.webp and result.json in the folder
// `out`, all of them or none. `name`: the world's, as the user gave it. Throws InputError.
sim::RunResult watched_drive(const std::string& name, const sim::World& world, const VehicleConfig& config,
                             const sim::RunSettings& settings, const KernelTable& kernels, const std::string& out);

}  // namespace lakshya
