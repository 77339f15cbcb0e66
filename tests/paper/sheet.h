// One sheet per experiment, for people: image, disparity, classes, the point cloud before and after pruning, and the
// map.
#pragma once

#include "tests/paper/experiment.h"

namespace lakshya::paper {

// How far the plots reach, metres.
struct PlotReach {
  double ahead_m = 8;
  double up_m = 2.6;
};

// Writes NAME.png into the folder that LAKSHYA_PICTURES names; without that variable it does nothing.
void write_sheet(const PaperScene& scene, const test::RenderedPair& pair, const Experiment& experiment,
                 const PlotReach& reach);

}  // namespace lakshya::paper
