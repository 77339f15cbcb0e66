// What `lakshya process` prints: counts, decision, time.
#pragma once

#include <array>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>

#include "app/core/pipeline.h"

namespace lakshya {

// Cells by type, index CellType.
std::array<std::uint32_t, 3> count_cells(const NavGrid& grid);

nlohmann::ordered_json frame_json(const FrameResult& frame, const PlannerParams& planner);
std::string frame_text(const FrameResult& frame);

}  // namespace lakshya
