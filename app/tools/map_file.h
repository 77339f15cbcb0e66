// Navigation maps in files, as they go between commands: our JSON and the grey PGM of map servers.
#pragma once

#include <cstdint>
#include <string>

#include "app/core/image.h"
#include "kernels/base/nav_grid.h"

namespace lakshya {

inline constexpr int kMaxMapSide = 2000;      // cells
inline constexpr double kMaxMapCellM = 10.0;  // m, in whole millimetres

// Planes are rows x cols, row 0 nearest, column 0 leftmost (docs/contract.md section 4).
struct MapFile {
  GridGeometry geometry;
  Image<std::uint8_t> type;  // CellType
  // Empty images where the file does not have them.
  Image<std::uint32_t> count;
  Image<double> mean_height_m;
  Image<std::uint32_t> floor_count;
  Image<std::uint32_t> below_count;
};

// Recognised by content:
//  JSON: {"rows": 200, "cols": 200, "cell_m": 0.1, "type": [[2, 1, 0, ...], ...]} and, if given, "count",
//    "mean_height_m", "floor_count" and "below_count" of the same shape; other keys are ignored.
//  PGM (P5, P2): 0 obstacle, 254 unoccupied, 205 unknown; the top row is the farthest; a cell is pgm_cell_m wide.
// Throws InputError for an unreadable, empty, truncated or oversized file, 0 or more than kMaxMapSide rows or
// columns, a cell that is not 1 mm to kMaxMapCellM in whole millimetres, ragged or wrongly sized planes, numbers of
// the wrong kind and values outside their range.
MapFile read_map(const std::string& path, double pgm_cell_m);

// The same for a file's content; `path` serves the messages.
MapFile parse_map(const std::string& path, const std::string& text, double pgm_cell_m);

// The same JSON with all planes, one map row per line of text. Mean heights in metres with 3 decimals, 0 where no
// points are counted. The grid's planes all have the geometry's size.
std::string write_map_json(const NavGrid& grid);

}  // namespace lakshya
