// The frames of a folder as the camera driver wants them. Decoding allocates; the driver counts it.
#pragma once

#include <string>

#include "app/core/device_config.h"
#include "app/core/frame_folder.h"
#include "hal/camera/folder_camera.h"

namespace lakshya {

class RecordedFolder final : public RecordedPairs {
 public:
  // Throws InputError: `config` names no frames, or the first of them cannot be read.
  explicit RecordedFolder(const FolderConfig& config);

  int count() const override { return frames_.count(); }
  int width() const override { return width_; }
  int height() const override { return height_; }
  std::optional<Nanoseconds> time(int n) const override { return frames_.timestamp_ns(n); }
  Status load(int n, ImageView<std::uint8_t> left, ImageView<std::uint8_t> right) override;

  const FrameFolder& frames() const { return frames_; }

 private:
  FrameFolder frames_;
  int width_ = 0;
  int height_ = 0;
};

}  // namespace lakshya
