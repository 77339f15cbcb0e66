// The frame's stages one by one, for `lakshya compare`: each can be run with any table of kernels on what the
// reference left before it, so that a difference shows in the stage where it arises.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "app/core/image.h"
#include "app/core/pipeline.h"
#include "app/tools/compare_planes.h"
#include "app/tools/compare_setup.h"

namespace lakshya {

// One map that owns its planes.
struct OwnedGrid {
  explicit OwnedGrid(const GridGeometry& g = {0, 0, 100});
  NavGrid view();
  GridGeometry geometry;
  Image<std::uint32_t> count, floor_count, below_count;
  Image<std::int64_t> height_sum;
  Image<std::uint8_t> type;
};

inline constexpr std::array<const char*, 3> kComparedMatchers = {"sgm", "census", "sad"};

// What the stages leave. Each writes its own members, made to size when it runs.
struct StageOutputs {
  Status status = Status::ok;  // the worst that a kernel of the stage returned
  Image<std::uint8_t> left, right;
  Image<CensusCode> left_codes, right_codes;
  Image<std::uint8_t> textured;
  Image<std::uint8_t> left_log, right_log;
  Image<std::uint8_t> left_sobel, right_sobel;
  std::array<Image<std::int16_t>, kComparedMatchers.size()> matched, supported;
  GroundHistogram residuals{};
  std::array<std::int32_t, 1> ground_offset16{};
  Image<PixelClass> classes;
  PixelCounts counts;
  OwnedGrid binned;
  OwnedGrid scored;
  PolarHistogram polar_histogram{};
  std::unique_ptr<Pipeline> pipeline;  // whose views `frame` holds
  FrameResult frame;
};

struct CompareStage {
  const char* name;
  bool reads_earlier;  // outputs of the stages before
  // The kernels that the stage calls are the same functions in both tables: there is nothing to compare.
  bool (*same)(const KernelTable& a, const KernelTable& b);
  // `in`: the reference's outputs of the stages before. `in` and `out` may be one object.
  void (*run)(const CompareSetup& setup, const StageOutputs& in, const KernelTable& kernels, StageOutputs& out);
  Planes (*planes)(const StageOutputs& out);
};

// In the order of the frame; the last is the whole frame.
std::span<const CompareStage> compare_stages();

}  // namespace lakshya
