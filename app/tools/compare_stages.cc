#include "app/tools/compare_stages.h"

#include <algorithm>

#include "app/core/geometry.h"
#include "app/tools/compare_stage_planes.h"
#include "kernels/grid_bin/grid_bin.h"

namespace lakshya {
namespace {

std::size_t size(int n) {
  return static_cast<std::size_t>(n);
}

void note(Status status, StageOutputs& out) {
  out.status = std::max(out.status, status);
}

// Calls kernel(rows) for every band, as the pipeline does.
template <class Kernel>
void in_bands(const CompareSetup& s, StageOutputs& out, Kernel&& kernel) {
  for (int band = 0; band < s.config.matcher.bands; ++band)
    note(kernel(s.band(band)), out);
}

Image<std::uint8_t> copy_of(const ImageView<const std::uint8_t>& image) {
  Image<std::uint8_t> copy(image.width, image.height);
  for (int v = 0; v < image.height; ++v)
    std::copy_n(image.row(v), image.width, copy.view().row(v));
  return copy;
}

void run_rectify(const CompareSetup& s, const StageOutputs& /*in*/, const KernelTable& k, StageOutputs& out) {
  out.left = copy_of(s.left);
  out.right = copy_of(s.right);
  if (!s.remap) return;
  in_bands(s, out, [&](Rows rows) {
    return std::max(k.rectify(s.left, s.maps_left.view(), rows, out.left.view()),
                    k.rectify(s.right, s.maps_right.view(), rows, out.right.view()));
  });
}

void run_census(const CompareSetup& s, const StageOutputs& in, const KernelTable& k, StageOutputs& out) {
  out.left_codes = out.right_codes = Image<CensusCode>(s.width, s.height);
  in_bands(s, out, [&](Rows rows) {
    return std::max(k.census(in.left.view(), rows, out.left_codes.view()),
                    k.census(in.right.view(), rows, out.right_codes.view()));
  });
}

void run_texture(const CompareSetup& s, const StageOutputs& in, const KernelTable& k, StageOutputs& out) {
  out.textured = Image<std::uint8_t>(s.width, s.height);
  in_bands(s, out, [&](Rows rows) {
    return k.texture(in.left.view(), s.config.matcher.texture_threshold, rows, out.textured.view());
  });
}

void run_edge_log(const CompareSetup& s, const StageOutputs& in, const KernelTable& k, StageOutputs& out) {
  out.left_log = out.right_log = Image<std::uint8_t>(s.width, s.height);
  const int cap = s.config.matcher.edge_cap;
  in_bands(s, out, [&](Rows rows) {
    return std::max(k.edge_log(in.left.view(), cap, rows, out.left_log.view()),
                    k.edge_log(in.right.view(), cap, rows, out.right_log.view()));
  });
}

void run_edge_sobel(const CompareSetup& s, const StageOutputs& in, const KernelTable& k, StageOutputs& out) {
  out.left_sobel = out.right_sobel = Image<std::uint8_t>(s.width, s.height);
  const int cap = s.config.matcher.edge_cap;
  in_bands(s, out, [&](Rows rows) {
    return std::max(k.edge_sobel(in.left.view(), cap, rows, out.left_sobel.view()),
                    k.edge_sobel(in.right.view(), cap, rows, out.right_sobel.view()));
  });
}

// Scratch for one band, aligned as the kernels want it.
class Scratch {
 public:
  explicit Scratch(std::size_t bytes) : arena_(bytes + Arena::kAlignment), bytes_(arena_.take<std::byte>(bytes)) {}
  std::span<std::byte> bytes() const { return bytes_; }

 private:
  Arena arena_;
  std::span<std::byte> bytes_;
};

void run_sgm(const CompareSetup& s, const StageOutputs& in, const KernelTable& k, StageOutputs& out) {
  const MatcherConfig c = s.matcher("sgm");
  const SgmParams p = sgm_params(c, s.camera.doffs(), s.width);
  const Scratch scratch(sgm_scratch_bytes(s.width, p.range.disparities));
  out.matched[0] = Image<std::int16_t>(s.width, s.height);
  in_bands(s, out, [&](Rows rows) {
    return k.sgm(in.left.view(), in.left_codes.view(), in.right_codes.view(), in.textured.view(),
                 descriptor_rows(c, s.height), p, rows, scratch.bytes(), out.matched[0].view());
  });
}

template <class Descriptors, class Kernel>
void run_block(const CompareSetup& s, int matcher, const Image<Descriptors>& left, const Image<Descriptors>& right,
               const StageOutputs& in, Kernel kernel, StageOutputs& out) {
  const MatcherConfig c = s.matcher(kComparedMatchers[size(matcher)]);
  const BlockParams p = block_params(c, s.camera.doffs(), s.width);
  const Scratch scratch(block_scratch_bytes(s.width, p.range.disparities, p.radius_v));
  Image<std::int16_t>& matched = out.matched[size(matcher)];
  matched = Image<std::int16_t>(s.width, s.height);
  in_bands(s, out, [&](Rows rows) {
    return kernel(left.view(), right.view(), in.textured.view(), descriptor_rows(c, s.height), p, rows,
                  scratch.bytes(), matched.view());
  });
}

void run_census_block(const CompareSetup& s, const StageOutputs& in, const KernelTable& k, StageOutputs& out) {
  run_block(s, 1, in.left_codes, in.right_codes, in, k.census_block, out);
}

void run_sad_block(const CompareSetup& s, const StageOutputs& in, const KernelTable& k, StageOutputs& out) {
  const bool sobel = s.config.matcher.edge == "sobel";
  run_block(s, 2, sobel ? in.left_sobel : in.left_log, sobel ? in.right_sobel : in.right_log, in, k.sad_block, out);
}

void run_support(const CompareSetup& s, const StageOutputs& in, const KernelTable& k, StageOutputs& out) {
  for (std::size_t m = 0; m < kComparedMatchers.size(); ++m) {
    out.supported[m] = Image<std::int16_t>(s.width, s.height);
    in_bands(s, out, [&](Rows rows) {
      return k.support(in.matched[m].view(), support_params(s.matcher(kComparedMatchers[m])), rows,
                       out.supported[m].view());
    });
  }
}

// What the configured matcher gives to the stages after it.
ImageView<const std::int16_t> disparity_of(const CompareSetup& s, const StageOutputs& in) {
  const auto name = std::find(kComparedMatchers.begin(), kComparedMatchers.end(), s.config.matcher.name);
  return in.supported[static_cast<std::size_t>(name - kComparedMatchers.begin())].view();
}

void run_ground(const CompareSetup& s, const StageOutputs& in, const KernelTable& k, StageOutputs& out) {
  const ImageView<const std::int16_t> disparity = disparity_of(s, in);
  out.residuals.fill(0);
  in_bands(s, out, [&](Rows rows) { return k.ground_residuals(s.mount, disparity, rows, out.residuals); });
  const std::int32_t range16 = disparity_of_pitch16(s.config, s.camera, s.config.prune.ground_range_deg);
  out.ground_offset16[0] = ground_offset(out.residuals, range16, std::int64_t{s.width} * s.height);
}

void run_project(const CompareSetup& s, const StageOutputs& in, const KernelTable& k, StageOutputs& out) {
  const ImageView<const std::int16_t> disparity = disparity_of(s, in);
  const PruneModel model = shift_floor(s.mount, std::int64_t{in.ground_offset16[0]} << kDisparityToQ16);
  const Scratch scratch(project_scratch_bytes(s.width));
  out.classes = Image<PixelClass>(s.width, s.height);
  out.counts = {};
  out.binned = OwnedGrid(grid_geometry(s.config.grid));
  const NavGrid grid = out.binned.view();
  note(clear_grid(grid), out);
  in_bands(s, out, [&](Rows rows) {
    return k.project_rows(model, disparity, rows, grid, out.counts, out.classes.view(), scratch.bytes());
  });
}

void run_score(const CompareSetup& s, const StageOutputs& in, const KernelTable& k, StageOutputs& out) {
  out.scored = in.binned;
  note(k.score(s.thresholds, s.min_height_mm, out.scored.view()), out);
}

void run_polar_histogram(const CompareSetup& s, const StageOutputs& in, const KernelTable& k, StageOutputs& out) {
  note(k.polar_histogram(in.scored.type.view(), s.polar_table, out.polar_histogram, {}), out);
}

void run_frame(const CompareSetup& s, const StageOutputs& /*in*/, const KernelTable& k, StageOutputs& out) {
  out.pipeline = std::make_unique<Pipeline>(s.config, s.calibration, s.width, s.height, k, s.clock);
  note(out.pipeline->process(s.left, s.right, {}, out.frame), out);
}

#define LAKSHYA_SAME(member) [](const KernelTable& a, const KernelTable& b) { return a.member == b.member; }
constexpr std::array<CompareStage, 14> kStageList = {{
    {"rectify", false, LAKSHYA_SAME(rectify), run_rectify, rectify_planes},
    {"census", true, LAKSHYA_SAME(census), run_census, census_planes},
    {"texture", true, LAKSHYA_SAME(texture), run_texture, texture_planes},
    {"edge_log", true, LAKSHYA_SAME(edge_log), run_edge_log, edge_log_planes},
    {"edge_sobel", true, LAKSHYA_SAME(edge_sobel), run_edge_sobel, edge_sobel_planes},
    {"sgm", true, LAKSHYA_SAME(sgm), run_sgm, sgm_planes},
    {"census_block", true, LAKSHYA_SAME(census_block), run_census_block, census_block_planes},
    {"sad_block", true, LAKSHYA_SAME(sad_block), run_sad_block, sad_block_planes},
    {"support", true, LAKSHYA_SAME(support), run_support, support_planes},
    {"ground", true, LAKSHYA_SAME(ground_residuals), run_ground, ground_planes},
    {"project", true, LAKSHYA_SAME(project_rows), run_project, project_planes},
    {"score", true, LAKSHYA_SAME(score), run_score, score_planes},
    {"polar_histogram", true, LAKSHYA_SAME(polar_histogram), run_polar_histogram, polar_histogram_planes},
    {"frame", false, [](const KernelTable&, const KernelTable&) { return false; }, run_frame, frame_planes},
}};
#undef LAKSHYA_SAME

}  // namespace

OwnedGrid::OwnedGrid(const GridGeometry& g)
    : geometry(g),
      count(g.cols, g.rows),
      floor_count(g.cols, g.rows),
      below_count(g.cols, g.rows),
      height_sum(g.cols, g.rows),
      type(g.cols, g.rows) {}

NavGrid OwnedGrid::view() {
  return {geometry, count.view(), height_sum.view(), floor_count.view(), below_count.view(), type.view()};
}

std::span<const CompareStage> compare_stages() {
  return kStageList;
}

}  // namespace lakshya
