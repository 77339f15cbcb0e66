#include "app/core/recorded_folder.h"

#include <algorithm>
#include <filesystem>

#include "app/core/image_file.h"
#include "app/core/input_error.h"

namespace lakshya {
namespace {

FrameFolder frames_of(const FolderConfig& config) {
  const bool sides = !config.left.empty() && !config.right.empty();
  if (config.path.empty() == !sides) {
    throw InputError("folder", "either folder.path or both folder.left and folder.right name the recorded images");
  }
  if (!sides) return FrameFolder::open_sequence(config.path);
  std::error_code ignored;
  const bool folders = std::filesystem::is_directory(config.left, ignored);
  return folders ? FrameFolder::open_pair(config.left, config.right)
                 : FrameFolder::single_pair(config.left, config.right);
}

bool read_into(const std::string& path, ImageView<std::uint8_t> to) {
  const Image<std::uint8_t> image = read_gray(path);
  if (!same_size(image.view(), to)) return false;
  for (int v = 0; v < to.height; ++v)
    std::ranges::copy(row_span(image.view(), v), to.row(v));
  return true;
}

}  // namespace

RecordedFolder::RecordedFolder(const FolderConfig& config) : frames_(frames_of(config)) {
  const Image<std::uint8_t> first = read_gray(frames_.left(0));
  width_ = first.width();
  height_ = first.height();
}

Status RecordedFolder::load(int n, ImageView<std::uint8_t> left, ImageView<std::uint8_t> right) {
  try {
    return read_into(frames_.left(n), left) && read_into(frames_.right(n), right) ? Status::ok : Status::bad_data;
  } catch (const InputError&) {
    return Status::bad_data;
  }
}

}  // namespace lakshya
