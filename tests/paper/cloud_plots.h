// The parts of a sheet that show points: from the side, from above, and counted.
#pragma once

#include <vector>

#include "app/tools/picture_panels.h"
#include "tests/paper/experiment.h"

namespace lakshya::paper {

Rgb8 color_of(Object object);

// Metres in the body frame, with what the pixel truly shows.
struct CloudPoint {
  double forward_m = 0;
  double left_m = 0;
  double height_m = 0;
  Object object = Object::nothing;
};
using Cloud = std::vector<CloudPoint>;

// Every pixel with a finite depth.
Cloud whole_cloud(const test::RenderedPair& pair, const ProcessedFrame& run);
// The obstacle points that are left after pruning.
Cloud pruned_cloud(const test::RenderedPair& pair, const ProcessedFrame& run);

// Distance ahead to the right, height up, with the limits that pruning has there.
void draw_side_view(Canvas& sheet, const Box& plot, const PaperScene& scene, const Cloud& cloud,
                    const PruneConfig& limits, double ahead_m, double up_m);

// The true outlines of the scene's things, from above.
void draw_outlines(Canvas& area, const MapView& view, const PaperScene& scene);
// As the map shows the world: the vehicle at the bottom, looking up.
void draw_top_view(Canvas& sheet, const Box& plot, const MapView& view, const PaperScene& scene,
                   const Cloud& cloud);

// One bar per pruning step, divided by what the points truly are.
void draw_step_bars(Canvas& sheet, const Box& box, const StepCounts& kept);

}  // namespace lakshya::paper
