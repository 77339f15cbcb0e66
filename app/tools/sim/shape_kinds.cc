#include "app/tools/sim/shape_kinds.h"

namespace lakshya::sim {
namespace {

using Of = const ShapeSizes&;

// clang-format off: one line for each kind
constexpr ShapeSize kLong{"length_m", 1, 0.02, 100};
const std::array<ShapeKind, 22> kKinds{{
    {"box",
     {{{"length_m", 0.5, 0.02, 20}, {"width_m", 0.4, 0.02, 20}, {"height_m", 0.4, 0.01, 10}}},
     3,
     [](const Spot& s, Of v) { return box(s, v[0], v[1], v[2]); }},
    {"crate",
     {{{"length_m", 0.6, 0.02, 20}, {"width_m", 0.5, 0.02, 20}, {"height_m", 0.5, 0.01, 10}}},
     3,
     [](const Spot& s, Of v) { return crate(s, v[0], v[1], v[2]); }},
    {"wall",
     {{kLong, {"thickness_m", 0.1, 0.01, 2}, {"height_m", kCeilingM, 0.1, 10}}},
     3,
     [](const Spot& s, Of v) { return wall(s, v[0], v[1], v[2]); }},
    {"doorway",
     {{{"length_m", 3, 0.8, 100}, {"opening_m", 1.2, 0.5, 10}, {"height_m", kCeilingM, 2, 10}}},
     3,
     [](const Spot& s, Of v) { return doorway(s, v[0], v[1], v[2]); }},
    {"ceiling",
     {{{"length_m", 6, 0.1, 100}, {"width_m", 4, 0.1, 100}}},
     2,
     [](const Spot& s, Of v) { return ceiling(s, v[0], v[1]); }},
    {"glass pane",
     {{{"length_m", 1.5, 0.1, 20}, {"height_m", 2.1, 0.3, 6}}},
     2,
     [](const Spot& s, Of v) { return glass_pane(s, v[0], v[1]); }},
    {"pole",
     {{{"diameter_m", 0.05, 0.005, 1}, {"height_m", 2, 0.1, 20}}},
     2,
     [](const Spot& s, Of v) { return pole(s, v[0], v[1]); }},
    {"column",
     {{{"diameter_m", 0.4, 0.05, 5}, {"height_m", kCeilingM, 0.1, 20}}},
     2,
     [](const Spot& s, Of v) { return column(s, v[0], v[1]); }},
    {"lamp", {{{"height_m", 1.6, 0.6, 4}}}, 1, [](const Spot& s, Of v) { return floor_lamp(s, v[0]); }},
    {"chair", {{{"seat_height_m", 0.45, 0.2, 1}}}, 1, [](const Spot& s, Of v) { return chair(s, v[0]); }},
    {"table",
     {{{"length_m", 1.4, 0.3, 6}, {"width_m", 0.8, 0.3, 4}, {"height_m", 0.72, 0.2, 1.5}}},
     3,
     [](const Spot& s, Of v) { return table(s, v[0], v[1], v[2]); }},
    {"shelf",
     {{{"length_m", 1, 0.2, 10},
       {"height_m", 1.6, 0.2, 4},
       {"board_height_m", 0.7, 0.05, 3},
       {"overhang_m", 0.3, 0.02, 2}}},
     4,
     [](const Spot& s, Of v) { return shelf(s, v[0], v[1], v[2], v[3]); }},
    {"bench", {{{"length_m", 1.4, 0.7, 6}}}, 1, [](const Spot& s, Of v) { return bench(s, v[0]); }},
    {"hanging bar",
     {{{"length_m", 1.2, 0.2, 10}, {"thickness_m", 0.06, 0.01, 1}}},
     2,
     [](const Spot& s, Of v) { return hanging_bar(s, v[0], v[1]); }},
    {"hanging lamp",
     {{{"diameter_m", 0.45, 0.05, 2}}},
     1,
     [](const Spot& s, Of v) { return hanging_lamp(s, v[0]); }},
    {"newspaper",
     {{{"length_m", 0.6, 0.05, 3}, {"width_m", 0.42, 0.05, 3}}},
     2,
     [](const Spot& s, Of v) { return newspaper(s, v[0], v[1]); }},
    {"person", {{{"height_m", 1.7, 0.8, 2.2}}}, 1, [](const Spot& s, Of v) { return person(s, v[0]); }},
    {"bush",
     {{{"diameter_m", 0.8, 0.2, 5}, {"height_m", 0.8, 0.2, 5}}},
     2,
     [](const Spot& s, Of v) { return bush(s, v[0], v[1]); }},
    {"tree",
     {{{"diameter_m", 0.25, 0.05, 2}, {"height_m", 3.5, 2.5, 12}}},
     2,
     [](const Spot& s, Of v) { return tree(s, v[0], v[1]); }},
    {"rock",
     {{{"diameter_m", 0.6, 0.05, 5}, {"height_m", 0.4, 0.03, 5}}},
     2,
     [](const Spot& s, Of v) { return rock(s, v[0], v[1]); }},
    {"hedge",
     {{kLong, {"thickness_m", 0.6, 0.1, 5}, {"height_m", 1.5, 0.2, 6}}},
     3,
     [](const Spot& s, Of v) { return hedge(s, v[0], v[1], v[2]); }},
    {"fence", {{kLong, {"height_m", 1.2, 0.3, 4}}}, 2, [](const Spot& s, Of v) { return fence(s, v[0], v[1]); }},
}};
// clang-format on

}  // namespace

std::span<const ShapeKind> shape_kinds() {
  return kKinds;
}

}  // namespace lakshya::sim
