// Private to FrameFolder: what the folders and lists of one camera hold.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace lakshya {

// Numbers inside names count as numbers: frame2.png before frame10.png.
bool natural_less(std::string_view a, std::string_view b);

// The numbers of a file's name without extension and leading zeros, "6,10" for 000006_10.png.
std::string numbers_of_name(const std::string& path);

// Paths of the images (.png .pgm .ppm .jpg .jpeg, any case, no hidden ones) of a folder in natural order. Throws
// InputError when it cannot be read.
std::vector<std::string> list_images(const std::string& folder);

struct TimedImage {
  std::int64_t time_ns = 0;
  std::string path;
};

// One camera of a EuRoC recording in order of time: the lines "time in ns,file name" of CAMERA/data.csv, or the images
// whose names are the times where there is no list. The images lie in CAMERA/data or in CAMERA itself. Throws
// InputError for times that are none or do not increase, and names with a folder in them.
std::vector<TimedImage> list_timed_images(const std::string& camera_folder);

// KITTI's times.txt: one time in seconds per line, not decreasing; in ns.
std::vector<std::int64_t> read_times(const std::string& path);

}  // namespace lakshya
