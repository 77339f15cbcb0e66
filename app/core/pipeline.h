// One frame from raw pair to steering command: rectify, match, find the ground, prune and bin, score, plan.
// Everything is allocated when the pipeline is made; process() allocates nothing.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "app/core/arena.h"
#include "app/core/calibration.h"
#include "app/core/kernel_table.h"
#include "app/core/matcher.h"
#include "app/core/rectification.h"
#include "app/core/stage_times.h"
#include "app/core/vehicle_config.h"
#include "app/nav/mover.h"
#include "app/nav/planner.h"
#include "app/nav/rolling_map.h"
#include "hal/clock.h"
#include "kernels/slope/slope.h"

namespace lakshya {

class RoutePlanner;

// What one frame gave. Views stay valid until the next process() of the same pipeline.
struct FrameResult {
  ImageView<const std::uint8_t> left;  // rectified
  ImageView<const std::uint8_t> right;
  ImageView<const std::int16_t> disparity;  // stored, 1/16 px or NoDisparity
  ImageView<const PixelClass> classes;
  std::int32_t ground_offset16 = 0;  // the floor's disparity against the mount's plane, 1/16 px (kernels/ground)
  ImageView<const std::int16_t> levelled;  // the disparity as if the ground did not rise or fall (kernels/slope)
  PixelCounts pixels;
  NavGrid grid;                       // of this frame alone
  ImageView<const std::uint8_t> map;  // what was planned with: the rolling map's cells, or grid.type
  std::span<const Mover> movers;      // none where no rolling map is
  Plan plan;
  FrameTimes times;
};

// Does a stage's work in its place, so that another sensor can be compared under the same map and planner (lakshya sim --sensor).
class StandIn {
 public:
  virtual ~StandIn() = default;
  // In place of the matcher: the stored disparity of a rectified pair, valid until the next call.
  virtual Status match(ImageView<const std::uint8_t> left, ImageView<const std::uint8_t> right,
                       ImageView<const std::int16_t>& disparity) = 0;
  // After the scoring: may write another type into the map's cells.
  virtual Status see(const NavGrid& /*grid*/) { return Status::ok; }
};

class Pipeline {
 public:
  // width, height: of the raw images, already compared with the calibration's (require_image_size).
  // memory: memory_bytes() of a larger arena; a measuring one: the pipeline takes an arena of its own.
  // Throws InputError for a camera and configuration that do not go together. `kernels` and `clock` outlive the pipeline.
  Pipeline(const VehicleConfig& config, const StereoCalibration& calibration, int width, int height,
           const KernelTable& kernels, const Clock& clock, Arena memory = {});

  // What the pipeline will take for images of that size; depends on the number of OpenMP's threads.
  static std::size_t memory_bytes(const VehicleConfig& config, const StereoCalibration& calibration, int width,
                                  int height, const KernelTable& kernels);
  ~Pipeline();

  // left, right: raw images of the size given at the start. Without input.pose, or with map.rolling: no, the frame is planned with
  // alone.
  Status process(ImageView<const std::uint8_t> left, ImageView<const std::uint8_t> right, const PlanInput& input,
                 FrameResult& result);

  const RectifiedGeometry& camera() const { return camera_; }
  // Of the last frame processed.
  const PruneModel& prune_model() const { return prune_model_; }
  double blind_zone() const { return blind_zone_m_; }
  std::size_t arena_bytes() const { return arena_.used(); }
  // Of all frames that were processed to the end, or of those since clear_times().
  const StageTimes& times() const { return times_; }
  void clear_times() { times_ = {}; }
  // As if no frame had been processed yet.
  void begin_anew();
  // Outlives the pipeline; null: the pipeline's own stages.
  void stand_in(StandIn* stand_in) { stand_in_ = stand_in; }

 private:
  struct RectifyImages {
    ImageView<std::int16_t> x, y;
    ImageView<std::uint16_t> fraction;
    RectifyMap view() const { return {x, y, fraction}; }
  };

  // What lives in the arena, in the order in which it is taken.
  struct Buffers {
    Buffers(const VehicleConfig& config, const RectifiedGeometry& camera, bool remap, const KernelTable& kernels,
            Arena& arena);
    RectifyImages map_left, map_right;  // empty where the images are rectified already
    ImageView<std::uint8_t> left, right;
    Matcher matcher;
    ImageView<PixelClass> classes;
    std::span<std::int32_t> depth_table, height_table;
    std::span<std::byte> project_scratch;  // project_scratch_bytes() for every band
    std::span<PixelCounts> counts;
    std::span<GroundHistogram> residuals;
    ImageView<std::int16_t> levelled;  // the disparity with its slopes taken out
    std::vector<NavGrid> maps;
    std::span<CellThresholds> thresholds;
    std::span<PolarEntry> polar_table;
    RollingMapMemory rolling;  // empty, as its view, where there is none
    ImageView<std::uint8_t> rolling_type;
  };

  void make_maps(const StereoCalibration& calibration);
  Status rectify(ImageView<const std::uint8_t> left, ImageView<const std::uint8_t> right, FrameResult& result);
  Status find_ground(FrameResult& result);
  Status level_slopes(FrameResult& result);
  Status project_and_bin(FrameResult& result);
  Status remember(const PlanInput& input, FrameResult& result);
  Status plan(const PlanInput& input, FrameResult& result);
  Rows band_rows(int band) const;

  const KernelTable* kernels_;
  const Clock* clock_;
  StandIn* stand_in_ = nullptr;
  RectifiedGeometry camera_;
  int bands_;
  std::int32_t min_height_mm_;
  double blind_zone_m_;
  bool remap_;
  bool rolls_;
  Arena arena_;
  std::unique_ptr<Buffers> buffers_;
  PruneModel mount_model_;
  PruneModel prune_model_;  // the mount's, with the floor where this frame shows it
  std::int32_t ground_range16_ = 0;
  std::int32_t ground_rate16_ = 0;
  std::int32_t floor_scatter16_ = 0;  // that the model knows of
  std::int64_t floor_widening_ = 0;   // Q16 px for each 1/16 px beyond
  SlopeParams slope_params_;
  Slopes slopes_;                                // of the last frame
  std::optional<std::int32_t> ground_offset16_;  // of the last frame
  RollingMap rolling_map_;
  std::unique_ptr<RoutePlanner> route_planner_;  // null where nothing searches for a route
  struct Traffic;
  std::unique_ptr<Traffic> traffic_;  // null where there is no rolling map
  VehicleParams vehicle_;
  Planner planner_;
  PlanState plan_state_;
  StageTimes times_;
};

}  // namespace lakshya
