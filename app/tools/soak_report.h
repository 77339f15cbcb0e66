// What the endurance test says of its result: text, JSON, picture.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "app/core/image.h"
#include "app/tools/soak_run.h"

namespace lakshya {

// Kinds of faults with their figures.
std::string fault_table(const SoakResult& result);
// The table, growth and verdict.
std::string soak_text(const SoakResult& result);
nlohmann::ordered_json soak_json(const SoakResult& result);
// Resident memory, handles and time of a frame over the frames.
Image<Rgb8> soak_picture(const SoakResult& result);

}  // namespace lakshya
