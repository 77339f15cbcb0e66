#include "app/core/frame_lists.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <system_error>

#include "app/core/file_bytes.h"
#include "app/core/input_error.h"
#include "app/core/input_text.h"

namespace lakshya {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMaxListBytes = std::size_t{64} << 20;
constexpr double kMaxSeconds = 9e9;  // int64 nanoseconds end at 9.2e9 s
constexpr double kNsPerSecond = 1e9;

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

// The run of digits at the text's start.
std::string_view leading_digits(std::string_view text) {
  return text.substr(0,
                     static_cast<std::size_t>(std::find_if_not(text.begin(), text.end(), is_digit) - text.begin()));
}

std::string_view without_zeros(std::string_view digits) {
  return digits.substr(std::min(digits.find_first_not_of('0'), digits.size() - 1));
}

int compare_numbers(std::string_view a, std::string_view b) {
  if (a.size() != b.size()) return a.size() < b.size() ? -1 : 1;
  return a.compare(b);
}

bool is_image_name(const fs::path& path) {
  constexpr std::array<std::string_view, 5> kExtensions{".png", ".pgm", ".ppm", ".jpg", ".jpeg"};
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
  return !path.filename().string().starts_with('.') &&
         std::find(kExtensions.begin(), kExtensions.end(), extension) != kExtensions.end();
}

std::int64_t parse_time_ns(const InputKey& key, std::string_view text) {
  std::int64_t time = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), time);
  if (error != std::errc{} || end != text.data() + text.size() || time < 0) {
    key.refuse(shown(text) + " is not a time (write whole nanoseconds)");
  }
  return time;
}

std::string image_folder_of(const std::string& camera_folder) {
  std::error_code ignored;
  const std::string data = camera_folder + "/data";
  return fs::is_directory(data, ignored) ? data : camera_folder;
}

std::vector<TimedImage> read_timed_list(const std::string& list, const std::string& image_folder) {
  std::vector<TimedImage> images;
  int number = 0;
  const std::string text = read_text(list, kMaxListBytes);
  for_each_line(text, [&](std::string_view line) {
    const InputKey key{list, "line " + std::to_string(++number)};
    line = trimmed(line);
    if (line.empty() || line.starts_with('#')) return;
    const std::size_t comma = line.find(',');
    if (comma == std::string_view::npos) key.refuse(shown(line) + " has no comma (write TIME,FILE NAME)");
    const std::int64_t time = parse_time_ns(key, trimmed(line.substr(0, comma)));
    const std::string name(trimmed(line.substr(comma + 1)));
    if (name.empty() || name != fs::path(name).filename() || name == "." || name == "..") {
      key.refuse(shown(name) + " is not the name of a file (write the name without a folder)");
    }
    images.push_back({time, image_folder + "/" + name});
  });
  return images;
}

std::vector<TimedImage> times_from_names(const std::string& image_folder) {
  std::vector<TimedImage> images;
  for (const std::string& path : list_images(image_folder)) {
    images.push_back({parse_time_ns({path, "file name"}, fs::path(path).stem().string()), path});
  }
  return images;
}

}  // namespace

bool natural_less(std::string_view a, std::string_view b) {
  std::size_t i = 0;
  std::size_t j = 0;
  while (i < a.size() && j < b.size()) {
    if (is_digit(a[i]) && is_digit(b[j])) {
      const std::string_view x = leading_digits(a.substr(i));
      const std::string_view y = leading_digits(b.substr(j));
      const int order = compare_numbers(without_zeros(x), without_zeros(y));
      if (order != 0) return order < 0;
      i += x.size();
      j += y.size();
      continue;
    }
    if (a[i] != b[j]) return static_cast<unsigned char>(a[i]) < static_cast<unsigned char>(b[j]);
    ++i;
    ++j;
  }
  if (a.size() - i != b.size() - j) return a.size() - i < b.size() - j;
  return a < b;
}

std::string numbers_of_name(const std::string& path) {
  const std::string stem = fs::path(path).stem().string();
  std::string numbers;
  for (std::string_view rest = stem; !rest.empty();) {
    const std::string_view digits = leading_digits(rest);
    if (!digits.empty()) numbers += (numbers.empty() ? "" : ",") + std::string(without_zeros(digits));
    rest.remove_prefix(std::max<std::size_t>(digits.size(), 1));
  }
  return numbers;
}

std::vector<std::string> list_images(const std::string& folder) {
  std::error_code error;
  std::vector<std::string> images;
  fs::directory_iterator entry(folder, error);
  while (!error && entry != fs::directory_iterator()) {
    std::error_code ignored;
    if (is_image_name(entry->path()) && entry->is_regular_file(ignored)) images.push_back(entry->path().string());
    entry.increment(error);
  }
  if (error) {
    throw InputError(folder,
                     "folder: cannot be read: " + error.message() + " (name a folder of images that is readable)");
  }
  std::sort(images.begin(), images.end(), natural_less);
  return images;
}

std::vector<TimedImage> list_timed_images(const std::string& camera_folder) {
  const std::string list = camera_folder + "/data.csv";
  const std::string image_folder = image_folder_of(camera_folder);
  std::error_code ignored;
  const bool listed = fs::exists(list, ignored);
  std::vector<TimedImage> images = listed ? read_timed_list(list, image_folder) : times_from_names(image_folder);
  for (std::size_t i = 1; i < images.size(); ++i) {
    if (images[i].time_ns > images[i - 1].time_ns) continue;
    InputKey{listed ? list : image_folder, "time " + std::to_string(images[i].time_ns)}.refuse(
        "not later than the one before it (keep one image for each moment, in order)");
  }
  return images;
}

std::vector<std::int64_t> read_times(const std::string& path) {
  std::vector<std::int64_t> times;
  const std::string text = read_text(path, kMaxListBytes);
  for_each_line(text, [&](std::string_view line) {
    if (trimmed(line).empty()) return;
    const InputKey key{path, "line " + std::to_string(times.size() + 1)};
    const double seconds = parse_number(key, line);
    if (!(seconds >= 0 && seconds <= kMaxSeconds)) {
      key.refuse(shown(seconds) + " is not a time in seconds (write 0 or more)");
    }
    times.push_back(std::llround(seconds * kNsPerSecond));
    if (times.size() > 1 && times.back() < times[times.size() - 2]) {
      key.refuse("earlier than the line before it (write one time for each frame, in order)");
    }
  });
  return times;
}

}  // namespace lakshya
