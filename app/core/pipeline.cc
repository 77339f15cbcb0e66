#include "app/core/pipeline.h"

#include <omp.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "app/core/geometry.h"
#include "app/core/input_error.h"
#include "app/core/over_bands.h"
#include "app/nav/give_way.h"
#include "app/nav/motion_watch.h"
#include "app/nav/route.h"
#include "kernels/grid_bin/grid_bin.h"

namespace lakshya {
namespace {

// More than any board has to spare; a mistake in the configuration must not bring the machine down.
constexpr std::size_t kMaxArenaBytes = std::size_t{4} << 30;

bool rolls(const VehicleConfig& config) {
  return config.map.rolling == "yes";
}

bool finds_slopes(const VehicleConfig& config, const RectifiedGeometry& camera) {
  return config.prune.slope_deg > 0 && camera.width >= kSlopeStrips && camera.height >= kSlopeBins;
}

std::size_t size(int n) {
  return static_cast<std::size_t>(n);
}

NavGrid take_grid(const GridGeometry& g, Arena& arena) {
  return {g,
          arena.take_image<std::uint32_t>(g.cols, g.rows),
          arena.take_image<std::int64_t>(g.cols, g.rows),
          arena.take_image<std::uint32_t>(g.cols, g.rows),
          arena.take_image<std::uint32_t>(g.cols, g.rows),
          arena.take_image<std::uint8_t>(g.cols, g.rows)};
}

RollingMapMemory take_rolling_map(const VehicleConfig& config, Arena& arena) {
  if (!rolls(config)) return {};
  const int side = rolling_map_side(grid_geometry(config.grid), config.map.size_m);
  const std::size_t cells = size(side) * size(side);
  return {arena.take<std::uint8_t>(cells), arena.take<std::int16_t>(cells), arena.take<std::uint32_t>(cells),
          arena.take<std::uint8_t>(cells)};
}

MotionWatchParams motion_watch_params(const VehicleConfig& config, const RectifiedGeometry& camera) {
  const RollingMapParams map = rolling_map_params(config, camera);
  return {.forward_m = map.camera.forward_m,
          .left_m = map.camera.left_m,
          .yaw = map.camera.yaw,
          .view = std::atan(camera.width / (2 * camera.focal_px)),
          .blind_m = blind_zone_m(config, camera),
          .depth_sigma = map.sight.depth_sigma};
}

bool routes(const VehicleConfig& config) {
  return rolls(config) && config.planner.name == "route";
}

RouteMemory take_route(const VehicleConfig& config, Arena& arena) {
  if (!routes(config)) return {};
  constexpr auto kCells = static_cast<std::size_t>(kRouteCells);
  return {arena.take<std::uint8_t>(kCells), arena.take<std::uint8_t>(kCells), arena.take<std::uint8_t>(kCells),
          arena.take<std::int32_t>(kCells), arena.take<std::int32_t>(kCells), arena.take<std::int32_t>(kCells),
          arena.take<std::uint8_t>(kCells)};
}

MotionWatchMemory take_motion_watch(const VehicleConfig& config, Arena& arena) {
  if (!rolls(config)) return {};
  return {arena.take<std::uint32_t>(kWatchCells), arena.take<std::uint8_t>(kWatchCells),
          arena.take<std::uint8_t>(kWatchCells)};
}

// A map for every thread that may count points, the first of them the frame's: adding the others to it costs less than
// atomic adds in a common one (docs/performance.md).
std::vector<NavGrid> take_maps(const GridGeometry& g, int bands, Arena& arena) {
  std::vector<NavGrid> maps(size(std::clamp(omp_get_max_threads(), 1, bands)));
  for (NavGrid& map : maps)
    map = take_grid(g, arena);
  return maps;
}

template <class Images>
Images take_rectify_images(bool remap, const RectifiedGeometry& camera, Arena& arena) {
  if (!remap) return {};
  return {arena.take_image<std::int16_t>(camera.width, camera.height),
          arena.take_image<std::int16_t>(camera.width, camera.height),
          arena.take_image<std::uint16_t>(camera.width, camera.height)};
}

template <class T>
void copy_image(const Image<T>& from, ImageView<T> to) {
  std::copy(from.view().data, from.view().row(to.height), to.data);
}

void require(Status status, const char* what) {
  if (status != Status::ok) {
    throw InputError(what, std::string("camera and configuration do not go together: ") + to_string(status) +
                               " (check the camera mount, the search range and the map size)");
  }
}

// Runs `step`, stores how long it took, and passes its status on.
template <class Step>
Status timed(const Clock& clock, Stage stage, FrameResult& result, Step&& step) {
  const auto i = static_cast<std::size_t>(stage);
  result.times.begin[i] = clock.now();
  const Status status = step();
  result.times.took[i] = clock.now() - result.times.begin[i];
  return status;
}

}  // namespace

// What moves, and how long the vehicle has waited for it.
struct Pipeline::Traffic {
  MotionWatch watch;
  Patience patience;
};

Pipeline::Buffers::Buffers(const VehicleConfig& config, const RectifiedGeometry& camera, bool remap,
                           const KernelTable& kernels, Arena& arena)
    : map_left(take_rectify_images<RectifyImages>(remap, camera, arena)),
      map_right(take_rectify_images<RectifyImages>(remap, camera, arena)),
      left(arena.take_image<std::uint8_t>(camera.width, camera.height)),
      right(arena.take_image<std::uint8_t>(camera.width, camera.height)),
      matcher(config.matcher, camera.doffs(), camera.width, camera.height, kernels, arena),
      classes(arena.take_image<PixelClass>(camera.width, camera.height)),
      depth_table(arena.take<std::int32_t>(prune_table_entries(max_disparity_px(config.matcher)))),
      height_table(arena.take<std::int32_t>(prune_table_entries(max_disparity_px(config.matcher)))),
      project_scratch(arena.take<std::byte>(size(config.matcher.bands) * project_scratch_bytes(camera.width))),
      counts(arena.take<PixelCounts>(size(config.matcher.bands))),
      residuals(arena.take<GroundHistogram>(size(config.matcher.bands))),
      levelled(finds_slopes(config, camera) ? arena.take_image<std::int16_t>(camera.width, camera.height)
                                            : ImageView<std::int16_t>{}),
      maps(take_maps(grid_geometry(config.grid), config.matcher.bands, arena)),
      thresholds(arena.take<CellThresholds>(size(config.grid.rows) * size(config.grid.cols))),
      polar_table(arena.take<PolarEntry>(polar_table_entries(grid_geometry(config.grid)))),
      rolling(take_rolling_map(config, arena)),
      rolling_type(rolls(config) ? arena.take_image<std::uint8_t>(config.grid.cols, config.grid.rows)
                                 : ImageView<std::uint8_t>{}) {}

std::size_t Pipeline::memory_bytes(const VehicleConfig& config, const StereoCalibration& calibration, int width,
                                   int height, const KernelTable& kernels) {
  Arena measure;
  (void)Buffers(config, rectified_geometry(calibration, width, height), needs_remap(calibration), kernels, measure);
  (void)take_route(config, measure);
  (void)take_motion_watch(config, measure);
  if (measure.used() > kMaxArenaBytes) {
    throw InputError(calibration.source,
                     "images of " + std::to_string(width) + "x" + std::to_string(height) + " need " +
                         std::to_string(measure.used() >> 20) + " MiB of working memory, more than " +
                         std::to_string(kMaxArenaBytes >> 20) +
                         " (use smaller images, or fewer matcher.disparities or matcher.bands)");
  }
  return measure.used();
}

Pipeline::Pipeline(const VehicleConfig& config, const StereoCalibration& calibration, int width, int height,
                   const KernelTable& kernels, const Clock& clock, Arena memory)
    : kernels_(&kernels),
      clock_(&clock),
      camera_(rectified_geometry(calibration, width, height)),
      bands_(config.matcher.bands),
      min_height_mm_(static_cast<std::int32_t>(std::lround(config.score.min_height_m * 1000))),
      blind_zone_m_(blind_zone_m(config, camera_)),
      remap_(needs_remap(calibration)),
      rolls_(rolls(config)),
      arena_(std::move(memory)) {
  const int first = stored_range(config.matcher.min_disparity, camera_.doffs()).first_raw;
  if (first >= width || first + config.matcher.disparities <= -width) {
    throw InputError(calibration.source, "search range: disparities from " +
                                             std::to_string(config.matcher.min_disparity) + " px with doffs " +
                                             std::to_string(camera_.doffs()) + " px lie outside an image " +
                                             std::to_string(width) + " px wide (change matcher.min_disparity)");
  }
  if (kernels.memory != Arena::memory()) {
    throw InputError("backend",
                     "its kernels want their buffers in a device's memory, and the pipeline's are in the host's");
  }
  if (arena_.measures()) arena_ = Arena(memory_bytes(config, calibration, width, height, kernels));
  buffers_ = std::make_unique<Buffers>(config, camera_, remap_, kernels, arena_);
  if (remap_) make_maps(calibration);

  Buffers& b = *buffers_;
  require(build_prune_model(prune_geometry(config, camera_), b.depth_table, b.height_table, mount_model_), "prune");
  prune_model_ = mount_model_;
  ground_range16_ = disparity_of_pitch16(config, camera_, config.prune.ground_range_deg);
  ground_rate16_ = disparity_of_pitch16(config, camera_, config.prune.ground_rate_deg);
  floor_scatter16_ = static_cast<std::int32_t>(std::lround(config.prune.disparity_sigma_px * kDisparityScale));
  floor_widening_ = std::llround(config.prune.sigma_factor * (1 << kDisparityToQ16));
  slope_params_ = slope_params(config);
  require(build_score_table(b.maps[0].geometry, score_geometry(config, camera_), b.thresholds), "score");
  if (rolls_) {
    require(rolling_map_.configure(rolling_map_params(config, camera_), b.maps[0].geometry, b.rolling), "map");
  }
  if (routes(config)) {
    route_planner_ = std::make_unique<RoutePlanner>();
    require(route_planner_->configure(route_params(config, camera_), b.maps[0].geometry.cell_mm,
                                      take_route(config, arena_)),
            "route");
  }
  if (rolls_) {
    traffic_ = std::make_unique<Traffic>();
    require(traffic_->watch.configure(motion_watch_params(config, camera_), b.maps[0].geometry,
                                      take_motion_watch(config, arena_)),
            "motion");
  }
  vehicle_ = config.vehicle;
  PlannerParams planner = config.planner;
  planner.blind_zone_m = blind_zone_m_;
  require(planner_.configure(planner, config.vehicle, b.maps[0].geometry, b.polar_table, kernels.polar_histogram),
          "planner");
}

Pipeline::~Pipeline() = default;

void Pipeline::make_maps(const StereoCalibration& calibration) {
  const Rectification r = calibration.rectification ? *calibration.rectification
                                                    : rectify_stereo(calibration, camera_.width, camera_.height);
  const auto make = [this](const CameraModel& camera, const Eigen::Matrix3d& rotation,
                           const Eigen::Matrix<double, 3, 4>& projection, const RectifyImages& to) {
    const RectifyMaps maps = make_rectify_maps(camera, rotation, projection, camera_.width, camera_.height);
    copy_image(maps.x, to.x);
    copy_image(maps.y, to.y);
    copy_image(maps.fraction, to.fraction);
  };
  make(calibration.left, r.R1, r.P1, buffers_->map_left);
  make(calibration.right, r.R2, r.P2, buffers_->map_right);
}

void Pipeline::begin_anew() {
  prune_model_ = mount_model_;
  ground_offset16_.reset();
  slopes_ = {};
  plan_state_ = {};
  if (rolls_) rolling_map_.reset();
  if (route_planner_) route_planner_->reset();
  if (traffic_) {
    traffic_->watch.reset();
    traffic_->patience = {};
  }
  times_ = {};
}

Rows Pipeline::band_rows(int band) const {
  return rows_of_band(camera_.height, bands_, band);
}

Status Pipeline::rectify(ImageView<const std::uint8_t> left, ImageView<const std::uint8_t> right,
                         FrameResult& result) {
  if (left.width != camera_.width || left.height != camera_.height || !same_size(left, right)) {
    return Status::size_mismatch;
  }
  result.left = left;
  result.right = right;
  if (!remap_) return Status::ok;
  const Status status = over_bands(2 * bands_, [&](int i) {
    const bool is_left = i < bands_;
    const RectifyImages& maps = is_left ? buffers_->map_left : buffers_->map_right;
    return kernels_->rectify(is_left ? left : right, maps.view(), band_rows(i % bands_),
                             is_left ? buffers_->left : buffers_->right);
  });
  result.left = buffers_->left;
  result.right = buffers_->right;
  return status;
}

Status Pipeline::find_ground(FrameResult& result) {
  std::span<GroundHistogram> residuals = buffers_->residuals;
  const Status status = over_bands(bands_, [&](int band) {
    GroundHistogram& h = residuals[size(band)];
    h.fill(0);
    return kernels_->ground_residuals(mount_model_, result.disparity, band_rows(band), h);
  });
  for (std::size_t band = 1; band < residuals.size(); ++band) {
    for (std::size_t i = 0; i < residuals[0].size(); ++i)
      residuals[0][i] += residuals[band][i];
  }
  const std::int64_t pixels = std::int64_t{camera_.width} * camera_.height;
  std::int32_t offset = ground_offset(residuals[0], ground_range16_, pixels);
  if (ground_offset16_) {
    offset = std::clamp(offset, *ground_offset16_ - ground_rate16_, *ground_offset16_ + ground_rate16_);
  }
  ground_offset16_ = offset;
  result.ground_offset16 = offset;
  prune_model_ = shift_floor(mount_model_, std::int64_t{offset} << kDisparityToQ16);
  const std::int32_t scatter = ground_scatter(residuals[0], offset, pixels);
  if (scatter > floor_scatter16_)
    prune_model_ = widen_floor(prune_model_, (scatter - floor_scatter16_) * floor_widening_);
  return status;
}

Status Pipeline::level_slopes(FrameResult& result) {
  result.levelled = result.disparity;
  const ImageView<std::int16_t> levelled = buffers_->levelled;
  if (levelled.data == nullptr) return Status::ok;
  const Status found = find_slopes(prune_model_, slope_params_, result.disparity, slopes_);
  if (found != Status::ok || std::none_of(slopes_.begin(), slopes_.end(), std::mem_fn(&SlopeStrip::found)))
    return found;
  result.levelled = levelled;
  return over_bands(kSlopeStrips, [&](int strip) {
    return level_strip(prune_model_, slope_params_, slopes_, result.disparity, strip, levelled);
  });
}

Status Pipeline::project_and_bin(FrameResult& result) {
  Buffers& b = *buffers_;
  std::fill(b.counts.begin(), b.counts.end(), PixelCounts{});
  const std::size_t scratch = project_scratch_bytes(camera_.width);
  const int maps = static_cast<int>(b.maps.size());
  const Status cleared = over_bands(maps, maps, [&](int map) { return clear_grid(b.maps[size(map)]); });
  // Every thread counts into a map of its own.
  const Status counted = over_bands(bands_, maps, [&](int band) {
    return kernels_->project_rows(prune_model_, result.levelled, band_rows(band),
                                  b.maps[size(omp_get_thread_num())], b.counts[size(band)], b.classes,
                                  b.project_scratch.subspan(size(band) * scratch, scratch));
  });
  const Status added = over_bands(bands_, maps, [&](int band) {
    Status worst = Status::ok;
    const Rows rows = rows_of_band(b.maps[0].geometry.rows, bands_, band);
    for (std::size_t map = 1; map < b.maps.size(); ++map)
      worst = std::max(worst, add_grid(b.maps[map], rows, b.maps[0]));
    return worst;
  });
  result.pixels = {};
  for (const PixelCounts& counts : b.counts) {
    for (int i = 0; i < kPixelClasses; ++i)
      result.pixels.by_class[i] += counts.by_class[i];
    for (int i = 0; i < kNoDisparityReasons; ++i)
      result.pixels.by_reason[i] += counts.by_reason[i];
  }
  result.classes = b.classes;
  result.grid = b.maps[0];
  return std::max({cleared, counted, added});
}

Status Pipeline::remember(const PlanInput& input, FrameResult& result) {
  result.map = result.grid.type;
  result.movers = {};
  if (!rolls_ || !input.pose) return Status::ok;
  const Status added = rolling_map_.add(result.grid, *input.pose, result.disparity);
  if (added != Status::ok) return added;
  const Status watched = traffic_->watch.add(result.grid, *input.pose);
  if (watched != Status::ok) return watched;
  result.movers = traffic_->watch.movers();
  result.map = buffers_->rolling_type;
  return rolling_map_.view(result.grid.type, buffers_->rolling_type);
}

Status Pipeline::plan(const PlanInput& input, FrameResult& result) {
  if (!route_planner_ || !input.pose) return planner_.plan(result.map, input, plan_state_, result.plan);
  PlanInput with_route = input;
  const Pose& pose = input.pose->pose;
  constexpr double kCarriedTurn = 2;  // frames for which the vehicle goes on turning as it does
  constexpr double kFarAway = 1000;   // of a direction without a place
  const double distance_m = std::min(input.target_distance_m, kFarAway);
  Route route;
  const Status found = route_planner_->plan(
      rolling_map_, pose, pose.east_m + distance_m * std::cos(pose.yaw + input.target),
      pose.north_m + distance_m * std::sin(pose.yaw + input.target), kCarriedTurn * input.heading_change, route);
  if (found != Status::ok) return found;
  with_route.route = RouteAim{.found = route.found,
                              .direction = route.direction,
                              .straight_m = route.straight_m,
                              .clear_m = route.clear_m,
                              .clear_end = route.clear_end,
                              .swept_m = route.swept_m};
  return planner_.plan(result.map, with_route, plan_state_, result.plan);
}

Status Pipeline::process(ImageView<const std::uint8_t> left, ImageView<const std::uint8_t> right,
                         const PlanInput& input, FrameResult& result) {
  result.plan = {};  // blocked: a frame that fails leaves no old command behind
  Status status = timed(*clock_, Stage::rectify, result, [&] { return rectify(left, right, result); });
  if (status != Status::ok) return status;
  status = timed(*clock_, Stage::match, result, [&] {
    if (stand_in_ != nullptr) return stand_in_->match(result.left, result.right, result.disparity);
    return buffers_->matcher.match(result.left, result.right, result.disparity, clock_, &result.times.match);
  });
  if (status != Status::ok) return status;
  status = timed(*clock_, Stage::ground, result, [&] {
    const Status ground = find_ground(result);
    return ground == Status::ok ? level_slopes(result) : ground;
  });
  if (status != Status::ok) return status;
  status = timed(*clock_, Stage::project_and_bin, result, [&] { return project_and_bin(result); });
  if (status != Status::ok) return status;
  status = timed(*clock_, Stage::score, result, [&] {
    const Status scored = kernels_->score(buffers_->thresholds, min_height_mm_, result.grid);
    return scored == Status::ok && stand_in_ != nullptr ? stand_in_->see(result.grid) : scored;
  });
  if (status != Status::ok) return status;
  status = timed(*clock_, Stage::remember, result, [&] { return remember(input, result); });
  if (status != Status::ok) return status;
  status = timed(*clock_, Stage::plan, result, [&] {
    const Status planned = plan(input, result);
    if (planned == Status::ok && traffic_ && input.pose)
      limit_plan(vehicle_, result.movers, input.pose->pose, traffic_->watch.speed_mps(), traffic_->patience,
                 result.plan);
    return planned;
  });
  if (status == Status::ok) times_.add(result.times);
  return status;
}

}  // namespace lakshya
