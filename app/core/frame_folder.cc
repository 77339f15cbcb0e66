#include "app/core/frame_folder.h"

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <filesystem>
#include <set>
#include <string_view>
#include <system_error>
#include <utility>

#include "app/core/frame_lists.h"
#include "app/core/input_error.h"

namespace lakshya {
namespace {

namespace fs = std::filesystem;

struct Layout {
  std::string left;
  std::string right;
  bool by_time = false;
};

bool is_folder(const std::string& path) {
  std::error_code ignored;
  return fs::is_directory(path, ignored);
}

std::string name_of(const std::string& path) {
  return fs::path(path).filename().string();
}

std::vector<Layout> known_layouts(std::optional<CameraNumbers> cameras) {
  const auto image = [](int camera) { return "image_" + std::to_string(camera); };
  const CameraNumbers first = cameras.value_or(CameraNumbers{0, 1});
  std::vector<Layout> layouts{{image(first.left), image(first.right)}};
  if (!cameras) layouts.push_back({"image_2", "image_3"});
  layouts.insert(layouts.end(), {{"left", "right"}, {"mav0/cam0", "mav0/cam1", true}, {"cam0", "cam1", true}});
  return layouts;
}

[[noreturn]] void refuse_layout(const std::string& folder, const std::vector<Layout>& layouts) {
  if (!is_folder(folder)) {
    throw InputError(folder, "sequence: is not a folder (check the path)");
  }
  std::string looked_for;
  std::string half;
  for (const Layout& layout : layouts) {
    looked_for += (looked_for.empty() ? "" : ", ") + layout.left + " and " + layout.right;
    const bool left = is_folder(folder + "/" + layout.left);
    if (left == is_folder(folder + "/" + layout.right)) continue;
    half = "; " + (left ? layout.left : layout.right) + " is there, " + (left ? layout.right : layout.left) +
           " is not";
  }
  throw InputError(folder, "sequence: holds none of the folders looked for: " + looked_for + half +
                               " (name a sequence's folder, or both folders of images)");
}

Layout layout_of(const std::string& folder, std::optional<CameraNumbers> cameras) {
  const std::vector<Layout> layouts = known_layouts(cameras);
  std::vector<Layout> found;
  for (const Layout& layout : layouts) {
    const bool colour_besides_grey = layout.left == "image_2" && !found.empty();
    if (colour_besides_grey || !is_folder(folder + "/" + layout.left) || !is_folder(folder + "/" + layout.right)) {
      continue;
    }
    found.push_back({folder + "/" + layout.left, folder + "/" + layout.right, layout.by_time});
  }
  if (found.empty()) refuse_layout(folder, layouts);
  if (found.size() > 1) {
    throw InputError(folder, "sequence: both " + found[0].left + " and " + found[1].left +
                                 " are there (name the two folders of images)");
  }
  return found.front();
}

void require_same_names(const std::string& right_folder, const std::vector<std::string>& left,
                        const std::vector<std::string>& right) {
  std::set<std::string> numbers;
  for (const std::string& path : left)
    numbers.insert(numbers_of_name(path));
  const bool shared = std::any_of(right.begin(), right.end(),
                                  [&](const std::string& path) { return numbers.contains(numbers_of_name(path)); });
  for (std::size_t i = 0; shared && i < left.size(); ++i) {
    if (numbers_of_name(left[i]) == numbers_of_name(right[i])) continue;
    throw InputError(right_folder, "frame " + std::to_string(i) + ": " + name_of(right[i]) +
                                       " is not the partner of " + name_of(left[i]) +
                                       " (an image is missing on one side)");
  }
}

// 7 for 000007.png.
std::optional<std::size_t> number_of_name(const std::string& path) {
  const std::string stem = fs::path(path).stem().string();
  std::size_t number = 0;
  const auto [end, error] = std::from_chars(stem.data(), stem.data() + stem.size(), number);
  if (error != std::errc{} || end != stem.data() + stem.size()) return {};
  return number;
}

std::optional<int> camera_number(const std::string& image_path) {
  const std::string folder = fs::path(image_path).parent_path().filename().string();
  for (int camera = 0; camera < 4; ++camera) {
    const std::string digit = std::to_string(camera);
    if (folder == "image_" + digit || folder == "image_0" + digit) return camera;
  }
  return {};
}

}  // namespace

FrameFolder FrameFolder::open_sequence(const std::string& folder, std::optional<CameraNumbers> cameras) {
  const Layout layout = layout_of(folder, cameras);
  if (!layout.by_time) {
    FrameFolder frames = open_pair(layout.left, layout.right);
    frames.name_ = folder;
    std::error_code ignored;
    const std::string times = folder + "/times.txt";
    if (fs::exists(times, ignored)) frames.add_times(times);
    return frames;
  }
  FrameFolder frames(folder);
  frames.add_pairs_by_time(layout.left, layout.right);
  return frames;
}

FrameFolder FrameFolder::open_pair(const std::string& left_folder, const std::string& right_folder) {
  const std::vector<std::string> left = list_images(left_folder);
  const std::vector<std::string> right = list_images(right_folder);
  if (left.empty()) {
    throw InputError(left_folder, "images: none in this folder (PNG, PGM, PPM or JPEG by their names)");
  }
  if (left.size() != right.size()) {
    throw InputError(right_folder, "images: " + std::to_string(right.size()) + " here, but " +
                                       std::to_string(left.size()) + " in " + left_folder +
                                       " (each left image needs its right one)");
  }
  require_same_names(right_folder, left, right);
  FrameFolder frames(left_folder);
  for (std::size_t i = 0; i < left.size(); ++i)
    frames.frames_.push_back({left[i], right[i], {}});
  return frames;
}

FrameFolder FrameFolder::single_pair(const std::string& left_image, const std::string& right_image) {
  FrameFolder frames(left_image);
  frames.frames_.push_back({left_image, right_image, {}});
  return frames;
}

void FrameFolder::add_pairs_by_time(const std::string& left_folder, const std::string& right_folder) {
  const std::vector<TimedImage> left = list_timed_images(left_folder);
  const std::vector<TimedImage> right = list_timed_images(right_folder);
  const auto skip = [this](std::int64_t time, const std::string& why) {
    skipped_.push_back("frame at " + std::to_string(time) + " ns left out: " + why);
  };
  auto r = right.begin();
  for (const TimedImage& l : left) {
    for (; r != right.end() && r->time_ns < l.time_ns; ++r)
      skip(r->time_ns, "no left image");
    if (r == right.end() || r->time_ns != l.time_ns) {
      skip(l.time_ns, "no right image");
      continue;
    }
    std::error_code ignored;
    if (!fs::exists(l.path, ignored)) {
      skip(l.time_ns, l.path + " does not exist");
    } else if (!fs::exists(r->path, ignored)) {
      skip(l.time_ns, r->path + " does not exist");
    } else {
      frames_.push_back({l.path, r->path, l.time_ns});
    }
    ++r;
  }
  for (; r != right.end(); ++r)
    skip(r->time_ns, "no left image");
  if (frames_.empty()) {
    throw InputError(name_, "frames: none of " + std::to_string(left.size()) + " left and " +
                                std::to_string(right.size()) + " right images have their partner" +
                                (skipped_.empty() ? "" : ", " + skipped_.front()) + " (pairs share one time)");
  }
}

void FrameFolder::add_times(const std::string& path) {
  const std::vector<std::int64_t> times = read_times(path);
  for (std::size_t i = 0; i < frames_.size(); ++i) {
    const std::size_t line = number_of_name(frames_[i].left).value_or(i);
    if (line >= times.size()) {
      throw InputError(path, "times: " + std::to_string(times.size()) + " lines, but " + name_of(frames_[i].left) +
                                 " would need line " + std::to_string(line + 1) + " (one line for each frame)");
    }
    frames_[i].time_ns = times[line];
  }
}

const FrameFolder::Frame& FrameFolder::at(int n) const {
  if (n >= 0 && n < count()) return frames_[static_cast<std::size_t>(n)];
  throw InputError(name_, "frame " + std::to_string(n) + ": there are " + std::to_string(count()) +
                              " frames, 0 to " + std::to_string(count() - 1) + " (choose one of them)");
}

CameraNumbers camera_numbers_of(const std::string& left_path, const std::string& right_path) {
  const std::optional<int> left = camera_number(left_path);
  const std::optional<int> right = camera_number(right_path);
  if (!left || !right) return {};
  return {*left, *right};
}

}  // namespace lakshya
