// Cameras on IEEE 1394 through libdc1394, where it was there when this was built.
#pragma once

#include <memory>

#include "hal/camera/iidc_camera.h"

namespace lakshya {

// Built without libdc1394, its start() is unsupported. libdc1394 allocates when a camera is started, also again. Its messages to
// the standard error output are switched off, for the whole process.
std::unique_ptr<IidcCamera> make_dc1394_camera();

}  // namespace lakshya
