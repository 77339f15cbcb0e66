// What each stage of compare_stages.h wrote, as planes.
#pragma once

#include "app/tools/compare_planes.h"
#include "app/tools/compare_stages.h"

namespace lakshya {

Planes rectify_planes(const StageOutputs& out);
Planes census_planes(const StageOutputs& out);
Planes texture_planes(const StageOutputs& out);
Planes edge_log_planes(const StageOutputs& out);
Planes edge_sobel_planes(const StageOutputs& out);
Planes sgm_planes(const StageOutputs& out);
Planes census_block_planes(const StageOutputs& out);
Planes sad_block_planes(const StageOutputs& out);
Planes support_planes(const StageOutputs& out);
Planes ground_planes(const StageOutputs& out);
Planes project_planes(const StageOutputs& out);
Planes score_planes(const StageOutputs& out);
Planes polar_histogram_planes(const StageOutputs& out);
Planes frame_planes(const StageOutputs& out);

}  // namespace lakshya
