#include "app/tools/sim/named_worlds.h"

#include <algorithm>
#include <array>

#include "app/core/input_error.h"
#include "app/core/input_text.h"
#include "app/tools/sim/world_file.h"

namespace lakshya::sim {
namespace {

constexpr std::string_view kFigure7 = R"(name: figure-7
indoor: true
ground: {surface: {texture: wood, albedo: 0.4, contrast: 0.5, scale_m: 0.4}, extent: [-2, -4, 9, 4]}
things:
  - {kind: wall, name: south wall, at: [3.25, -2.55], yaw_deg: 0, length_m: 9.7, surface: {texture: plaster, albedo: 0.6, contrast: 0.4, scale_m: 0.8, seed: 11}}
  - {kind: wall, name: north wall, at: [3.25, 2.55], yaw_deg: 0, length_m: 9.7, surface: {texture: plaster, albedo: 0.6, contrast: 0.4, scale_m: 0.8, seed: 12}}
  - {kind: wall, name: west wall, at: [-1.55, 0], yaw_deg: 90, length_m: 5, surface: {texture: plaster, albedo: 0.6, contrast: 0.4, scale_m: 0.8, seed: 13}}
  - {kind: wall, name: east wall, at: [8.05, 0], yaw_deg: 90, length_m: 5, surface: {texture: plaster, albedo: 0.6, contrast: 0.4, scale_m: 0.8, seed: 14}}
  - {kind: ceiling, at: [3.25, 0], length_m: 9.7, width_m: 5.2}
  - {kind: box, at: [3.2, 0.35], yaw_deg: 10, length_m: 0.4, width_m: 0.5, height_m: 0.45}
  - {kind: newspaper, at: [3.2, -0.35], yaw_deg: 15}
light:
  ambient: 0.35
  sky: 0.6
  lamps:
    - {at: [1, 0, 2.35], strength: 2}
    - {at: [5, 0, 2.35], strength: 2}
start: {at: [0, 0], yaw_deg: 0}
goals: [[6.5, 0]]
)";

constexpr std::string_view kFigure9 = R"(name: figure-9
indoor: true
ground: {surface: {texture: wood, albedo: 0.4, contrast: 0.5, scale_m: 0.4}, extent: [-2, -4, 9, 4]}
things:
  - {kind: wall, name: south wall, at: [3.25, -2.55], yaw_deg: 0, length_m: 9.7, surface: {texture: plaster, albedo: 0.6, contrast: 0.4, scale_m: 0.8, seed: 11}}
  - {kind: wall, name: north wall, at: [3.25, 2.55], yaw_deg: 0, length_m: 9.7, surface: {texture: plaster, albedo: 0.6, contrast: 0.4, scale_m: 0.8, seed: 12}}
  - {kind: wall, name: west wall, at: [-1.55, 0], yaw_deg: 90, length_m: 5, surface: {texture: plaster, albedo: 0.6, contrast: 0.4, scale_m: 0.8, seed: 13}}
  - {kind: wall, name: east wall, at: [8.05, 0], yaw_deg: 90, length_m: 5, surface: {texture: plaster, albedo: 0.6, contrast: 0.4, scale_m: 0.8, seed: 14}}
  - {kind: ceiling, at: [3.25, 0], length_m: 9.7, width_m: 5.2}
  - {kind: table, at: [3.4, 0.5], yaw_deg: 90, length_m: 1.4, width_m: 0.8}
  - {kind: chair, at: [2.9, -0.75], yaw_deg: 40}
light:
  ambient: 0.35
  sky: 0.6
  lamps:
    - {at: [1, 0, 2.35], strength: 2}
    - {at: [5, 0, 2.35], strength: 2}
start: {at: [0, 0], yaw_deg: 0}
goals: [[6.5, 0]]
)";

constexpr std::string_view kFigure10 = R"(name: figure-10
indoor: true
ground: {surface: {texture: wood, albedo: 0.4, contrast: 0.5, scale_m: 0.4}, extent: [-2, -4, 9, 4]}
things:
  - {kind: wall, name: south wall, at: [3.25, -2.55], yaw_deg: 0, length_m: 9.7, surface: {texture: plaster, albedo: 0.6, contrast: 0.4, scale_m: 0.8, seed: 11}}
  - {kind: wall, name: north wall, at: [3.25, 2.55], yaw_deg: 0, length_m: 9.7, surface: {texture: plaster, albedo: 0.6, contrast: 0.4, scale_m: 0.8, seed: 12}}
  - {kind: wall, name: west wall, at: [-1.55, 0], yaw_deg: 90, length_m: 5, surface: {texture: plaster, albedo: 0.6, contrast: 0.4, scale_m: 0.8, seed: 13}}
  - {kind: wall, name: east wall, at: [8.05, 0], yaw_deg: 90, length_m: 5, surface: {texture: plaster, albedo: 0.6, contrast: 0.4, scale_m: 0.8, seed: 14}}
  - {kind: ceiling, at: [3.25, 0], length_m: 9.7, width_m: 5.2}
  - {kind: hanging lamp, at: [2.4, 0], bottom_m: 1.5}
  - {kind: hanging bar, at: [4.2, 0.3], yaw_deg: 90, bottom_m: 0.85, length_m: 1.4}
light:
  ambient: 0.35
  sky: 0.6
  lamps:
    - {at: [1, 0, 2.35], strength: 2}
    - {at: [5, 0, 2.35], strength: 2}
start: {at: [0, 0], yaw_deg: 0}
goals: [[6.5, 0]]
)";

constexpr std::string_view kPaperIndoor = R"(name: paper-indoor
indoor: true
ground: {surface: {texture: wood, albedo: 0.4, contrast: 0.5, scale_m: 0.4}, extent: [-2, -4, 14, 4]}
time_limit_s: 240
things:
  # A corridor, 2.6 m wide, and a room behind a doorway.
  - {kind: wall, name: south wall of the corridor, at: [2.25, -1.35], yaw_deg: 0, length_m: 7.7, surface: {texture: plaster, albedo: 0.6, contrast: 0.4, scale_m: 0.8, seed: 11}}
  - {kind: wall, name: north wall of the corridor, at: [2.25, 1.35], yaw_deg: 0, length_m: 7.7, surface: {texture: plaster, albedo: 0.6, contrast: 0.4, scale_m: 0.8, seed: 12}}
  - {kind: wall, name: west wall of the corridor, at: [-1.55, 0], yaw_deg: 90, length_m: 2.6, surface: {texture: plaster, albedo: 0.6, contrast: 0.4, scale_m: 0.8, seed: 13}}
  - {kind: ceiling, at: [2.25, 0], length_m: 7.7, width_m: 2.8}
  - {kind: wall, name: south wall, at: [9.65, -2.85], yaw_deg: 0, length_m: 7.3, surface: {texture: brick, albedo: 0.45, contrast: 0.6, scale_m: 0.25, seed: 11}}
  - {kind: wall, name: north wall, at: [9.65, 2.85], yaw_deg: 0, length_m: 7.3, surface: {texture: brick, albedo: 0.45, contrast: 0.6, scale_m: 0.25, seed: 12}}
  - {kind: wall, name: east wall, at: [13.25, 0], yaw_deg: 90, length_m: 5.6, surface: {texture: brick, albedo: 0.45, contrast: 0.6, scale_m: 0.25, seed: 14}}
  - {kind: ceiling, at: [9.65, 0], length_m: 7.3, width_m: 5.8}
  - {kind: doorway, at: [6.05, 0.2], yaw_deg: 90, length_m: 1.6, opening_m: 1.3}
  - {kind: wall, name: beside the doorway 1, at: [6.05, -1.75], yaw_deg: 90, length_m: 2.3}
  - {kind: wall, name: beside the doorway 2, at: [6.05, 1.95], yaw_deg: 90, length_m: 1.9}
  - {kind: box, at: [2.2, 0.5], yaw_deg: 20, length_m: 0.45, width_m: 0.4, height_m: 0.5}
  - {kind: newspaper, at: [2.4, -0.5], yaw_deg: 30}
  - {kind: hanging lamp, at: [4.2, 0.1], bottom_m: 1.6}
  - {kind: table, at: [8.6, 0.2], yaw_deg: 80, length_m: 1.4, width_m: 0.8}
  - {kind: chair, at: [8.2, -1.7], yaw_deg: 70}
  - {kind: hanging bar, at: [10.4, 1.2], yaw_deg: 90, bottom_m: 0.9, length_m: 1.2}
  - {kind: shelf, at: [12.95, -1.9], yaw_deg: 180, length_m: 1.2}
  - {kind: person, walk: {points: [[10.2, -2.2], [11.9, -0.9]], speed_mps: 0.6}}
light:
  ambient: 0.35
  sky: 0.6
  lamps:
    - {at: [1, 0, 2.35], strength: 2}
    - {at: [4.5, 0, 2.35], strength: 2}
    - {at: [8, 0, 2.35], strength: 2}
    - {at: [11.5, 0, 2.35], strength: 2}
start: {at: [0, 0], yaw_deg: 0}
goals: [[12, 0.8]]
)";

constexpr std::string_view kPaperOutdoor = R"(name: paper-outdoor
indoor: false
ground: {surface: {texture: grass, albedo: 0.35, contrast: 0.8, scale_m: 0.25}, extent: [-30, -30, 45, 30]}
patches:
  - {kind: path, rect: [-2, -1.8, 17, 1.8], surface: {texture: gravel, albedo: 0.45, contrast: 0.8, scale_m: 0.2}}
  - {kind: kerb, rect: [5, -2.6, 12, -1.8], height_m: 0.12, surface: {texture: concrete, albedo: 0.5, contrast: 0.5, scale_m: 0.5}}
things:
  - {kind: hedge, name: north hedge, at: [7.5, 3.4], length_m: 20, seed: 1}
  - {kind: fence, name: south fence, at: [7.5, -3.3], length_m: 20}
  - {kind: bush, at: [3.2, 0.4], diameter_m: 0.9, height_m: 0.8, seed: 3}
  - {kind: rock, at: [5.8, -0.8], diameter_m: 0.7, height_m: 0.4, seed: 4}
  - {kind: newspaper, at: [5.4, 0.6], yaw_deg: 20}
  - {kind: pole, at: [8, 0.2], diameter_m: 0.08, height_m: 2.4}
  - {kind: bush, at: [8.4, 2.2], diameter_m: 1, height_m: 1, seed: 5}
  - {kind: crate, at: [11.6, -0.5], yaw_deg: 25}
  - {kind: tree, at: [12.6, 2], seed: 6}
  - {kind: person, walk: {points: [[9.8, 1.5], [9.8, -1.2]], speed_mps: 0.7}}
light: {ambient: 0.45, sun: 0.8, sun_direction: [0.4, -0.6, 0.8], sky: 0.9, clouds: true}
start: {at: [0, 0]}
goals: [[14, 0]]
time_limit_s: 240
)";

constexpr std::string_view kEmptyRoom = R"(name: empty-room
indoor: true
ground: {surface: {texture: wood, albedo: 0.4, contrast: 0.5, scale_m: 0.4}, extent: [-2, -4, 11, 4]}
things:
  - {kind: wall, name: south wall, at: [4.25, -3.05], yaw_deg: 0, length_m: 11.7, surface: {texture: plaster, albedo: 0.6, contrast: 0.4, scale_m: 0.8, seed: 11}}
  - {kind: wall, name: north wall, at: [4.25, 3.05], yaw_deg: 0, length_m: 11.7, surface: {texture: plaster, albedo: 0.6, contrast: 0.4, scale_m: 0.8, seed: 12}}
  - {kind: wall, name: west wall, at: [-1.55, 0], yaw_deg: 90, length_m: 6, surface: {texture: plaster, albedo: 0.6, contrast: 0.4, scale_m: 0.8, seed: 13}}
  - {kind: wall, name: east wall, at: [10.05, 0], yaw_deg: 90, length_m: 6, surface: {texture: plaster, albedo: 0.6, contrast: 0.4, scale_m: 0.8, seed: 14}}
  - {kind: ceiling, at: [4.25, 0], length_m: 11.7, width_m: 6.2}
light:
  ambient: 0.35
  sky: 0.6
  lamps:
    - {at: [1, 0, 2.35], strength: 2}
    - {at: [4.5, 0, 2.35], strength: 2}
    - {at: [8, 0, 2.35], strength: 2}
start: {at: [0, 0], yaw_deg: 0}
goals: [[8, 0]]
)";

constexpr std::string_view kCorridor = R"(name: corridor
indoor: true
ground: {surface: {texture: wood, albedo: 0.4, contrast: 0.5, scale_m: 0.4}, extent: [-2, -2, 13, 2]}
things:
  - {kind: wall, name: south wall, at: [5.25, -1.15], yaw_deg: 0, length_m: 13.7, surface: {texture: plaster, albedo: 0.6, contrast: 0.4, scale_m: 0.8, seed: 11}}
  - {kind: wall, name: north wall, at: [5.25, 1.15], yaw_deg: 0, length_m: 13.7, surface: {texture: plaster, albedo: 0.6, contrast: 0.4, scale_m: 0.8, seed: 12}}
  - {kind: wall, name: west wall, at: [-1.55, 0], yaw_deg: 90, length_m: 2.2, surface: {texture: plaster, albedo: 0.6, contrast: 0.4, scale_m: 0.8, seed: 13}}
  - {kind: wall, name: east wall, at: [12.05, 0], yaw_deg: 90, length_m: 2.2, surface: {texture: plaster, albedo: 0.6, contrast: 0.4, scale_m: 0.8, seed: 14}}
  - {kind: ceiling, at: [5.25, 0], length_m: 13.7, width_m: 2.4}
  - {kind: box, at: [3.5, -0.75], length_m: 0.6, width_m: 0.5, height_m: 0.7}
  - {kind: pole, at: [5.8, 0.7], diameter_m: 0.05, height_m: 2}
  - {kind: shelf, at: [8, -0.92], yaw_deg: 90, length_m: 1.2, height_m: 1.7, board_height_m: 0.6, overhang_m: 0.25}
light:
  ambient: 0.35
  sky: 0.6
  lamps:
    - {at: [1, 0, 2.35], strength: 2}
    - {at: [5, 0, 2.35], strength: 2}
    - {at: [9, 0, 2.35], strength: 2}
start: {at: [0, 0], yaw_deg: 0}
goals: [[10.5, 0]]
)";

constexpr std::string_view kStairs = R"(name: stairs
indoor: true
ground: {surface: {texture: tiles, albedo: 0.5, contrast: 0.5, scale_m: 0.4}, extent: [-2, -4, 11, 4]}
patches:
  - {kind: stairs, rect: [3.5, -0.6, 5, 2.4], down: east, steps: 5, rise_m: 0.17}
things:
  - {kind: wall, name: south wall, at: [4.25, -2.55], yaw_deg: 0, length_m: 11.7, surface: {texture: plaster, albedo: 0.6, contrast: 0.4, scale_m: 0.8, seed: 11}}
  - {kind: wall, name: north wall, at: [4.25, 2.55], yaw_deg: 0, length_m: 11.7, surface: {texture: plaster, albedo: 0.6, contrast: 0.4, scale_m: 0.8, seed: 12}}
  - {kind: wall, name: west wall, at: [-1.55, 0], yaw_deg: 90, length_m: 5, surface: {texture: plaster, albedo: 0.6, contrast: 0.4, scale_m: 0.8, seed: 13}}
  - {kind: wall, name: east wall, at: [10.05, 0], yaw_deg: 90, length_m: 5, surface: {texture: plaster, albedo: 0.6, contrast: 0.4, scale_m: 0.8, seed: 14}}
  - {kind: ceiling, at: [4.25, 0], length_m: 11.7, width_m: 5.2}
light:
  ambient: 0.35
  sky: 0.6
  lamps:
    - {at: [1, 0, 2.35], strength: 2}
    - {at: [4.5, 0, 2.35], strength: 2}
    - {at: [8, 0, 2.35], strength: 2}
start: {at: [0, 0], yaw_deg: 0}
goals: [[8, 0]]
)";

constexpr std::string_view kRamp = R"(name: ramp
indoor: false
ground: {surface: {texture: grass, albedo: 0.35, contrast: 0.8, scale_m: 0.25}, extent: [-30, -30, 40, 30]}
patches:
  - {kind: path, rect: [-2, -1.5, 14, 1.5], surface: &way {texture: asphalt, albedo: 0.3, contrast: 0.6, scale_m: 0.3}}
  - {kind: ramp, rect: [3, -1.5, 5, 1.5], up: east, to_m: 0.2, surface: *way}
  - {kind: platform, rect: [5, -1.5, 7, 1.5], height_m: 0.2, surface: *way}
  - {kind: ramp, rect: [7, -1.5, 9, 1.5], up: west, to_m: 0.2, surface: *way}
things:
  - {kind: hedge, name: north hedge, at: [6, 2.1], length_m: 16, seed: 1}
  - {kind: hedge, name: south hedge, at: [6, -2.1], length_m: 16, seed: 2}
light: {ambient: 0.45, sun: 0.8, sun_direction: [0.4, -0.6, 0.8], sky: 0.9, clouds: true}
start: {at: [0, 0]}
goals: [[11, 0]]
)";

constexpr std::string_view kGlass = R"(name: glass
indoor: true
ground: {surface: {texture: wood, albedo: 0.4, contrast: 0.5, scale_m: 0.4}, extent: [-2, -4, 11, 4]}
traits: [glass]
things:
  - {kind: wall, name: south wall, at: [4.25, -2.55], yaw_deg: 0, length_m: 11.7, surface: {texture: plaster, albedo: 0.6, contrast: 0.4, scale_m: 0.8, seed: 11}}
  - {kind: wall, name: north wall, at: [4.25, 2.55], yaw_deg: 0, length_m: 11.7, surface: {texture: plaster, albedo: 0.6, contrast: 0.4, scale_m: 0.8, seed: 12}}
  - {kind: wall, name: west wall, at: [-1.55, 0], yaw_deg: 90, length_m: 5, surface: {texture: plaster, albedo: 0.6, contrast: 0.4, scale_m: 0.8, seed: 13}}
  - {kind: wall, name: east wall, at: [10.05, 0], yaw_deg: 90, length_m: 5, surface: {texture: plaster, albedo: 0.6, contrast: 0.4, scale_m: 0.8, seed: 14}}
  - {kind: ceiling, at: [4.25, 0], length_m: 11.7, width_m: 5.2}
  - {kind: glass pane, at: [4, 0.3], yaw_deg: 90, length_m: 2}
light:
  ambient: 0.35
  sky: 0.6
  lamps:
    - {at: [1, 0, 2.35], strength: 2}
    - {at: [4.5, 0, 2.35], strength: 2}
    - {at: [8, 0, 2.35], strength: 2}
start: {at: [0, 0], yaw_deg: 0}
goals: [[8, 0]]
)";

struct Named {
  std::string_view name;
  std::string_view text;
};
constexpr std::array<Named, 10> kWorlds{{
    {"figure-7", kFigure7},
    {"figure-9", kFigure9},
    {"figure-10", kFigure10},
    {"paper-indoor", kPaperIndoor},
    {"paper-outdoor", kPaperOutdoor},
    {"empty-room", kEmptyRoom},
    {"corridor", kCorridor},
    {"stairs", kStairs},
    {"ramp", kRamp},
    {"glass", kGlass},
}};

constexpr auto kNames = [] {
  std::array<std::string_view, kWorlds.size()> names;
  std::transform(kWorlds.begin(), kWorlds.end(), names.begin(), [](const Named& w) { return w.name; });
  return names;
}();

}  // namespace

std::span<const std::string_view> world_names() {
  return kNames;
}

std::string_view named_world_text(std::string_view name) {
  const auto found = std::find_if(kWorlds.begin(), kWorlds.end(), [&](const Named& w) { return w.name == name; });
  if (found != kWorlds.end()) return found->text;
  std::string known;
  for (const std::string_view k : kNames)
    known.append(known.empty() ? "" : ", ").append(k);
  throw InputError("world", shown(name) + " is no world that is built in (known: " + known + ")");
}

World named_world(std::string_view name) {
  return parse_world(named_world_text(name), "built-in world " + std::string(name));
}

}  // namespace lakshya::sim
