#include "app/tools/map_file.h"

#include <cmath>
#include <cstddef>
#include <cstdio>
#include <limits>
#include <nlohmann/json.hpp>

#include "app/core/file_bytes.h"
#include "app/core/image_file.h"
#include "app/core/input_error.h"
#include "kernels/base/units.h"

namespace lakshya {
namespace {

using Json = nlohmann::json;

// All planes of the largest map in compact text stay below this.
constexpr std::size_t kMaxMapBytes = std::size_t{128} << 20;
constexpr int kMaxNesting = 4;

constexpr std::uint8_t kPgmObstacle = 0;
constexpr std::uint8_t kPgmUnoccupied = 254;
constexpr std::uint8_t kPgmUnknown = 205;

class JsonMap {
 public:
  JsonMap(const std::string& path, const std::string& text) : path_(path) {
    try {
      const auto limit_nesting = [this](int depth, Json::parse_event_t /*event*/, Json& /*parsed*/) {
        if (depth > kMaxNesting) refuse("map", "is nested too deep (it is not a map)");
        return true;
      };
      json_ = Json::parse(text, limit_nesting);
    } catch (const Json::exception& e) {
      refuse("map", std::string("is not valid JSON: ") + e.what() + " (the file is damaged or cut off)");
    }
    if (!json_.is_object()) refuse("map", "is not a JSON object (it is not a map)");
  }

  MapFile read() const {
    MapFile map;
    map.geometry.rows = side("rows");
    map.geometry.cols = side("cols");
    map.geometry.cell_mm = cell_mm();
    const auto& g = map.geometry;
    if (!json_.contains("type")) refuse("type", "is missing (a map needs rows, cols, cell_m and type)");
    map.type = plane<std::uint8_t>(g, "type", kCellUnknown);
    map.count = plane<std::uint32_t>(g, "count", std::numeric_limits<std::uint32_t>::max());
    map.mean_height_m = plane<double>(g, "mean_height_m", std::numeric_limits<double>::max());
    map.floor_count = plane<std::uint32_t>(g, "floor_count", std::numeric_limits<std::uint32_t>::max());
    map.below_count = plane<std::uint32_t>(g, "below_count", std::numeric_limits<std::uint32_t>::max());
    return map;
  }

 private:
  [[noreturn]] void refuse(const std::string& key, const std::string& why) const {
    throw InputError(path_, key + ": " + why);
  }

  const Json& number(const std::string& key) const {
    const auto found = json_.find(key);
    if (found == json_.end()) refuse(key, "is missing (a map needs rows, cols, cell_m and type)");
    if (!found->is_number()) refuse(key, "is not a number (write one)");
    return *found;
  }

  int side(const std::string& key) const {
    const Json& value = number(key);
    const double cells = value.get<double>();
    if (!value.is_number_integer() || !(1 <= cells && cells <= kMaxMapSide)) {
      refuse(key, value.dump() + " is not an integer from 1 to " + std::to_string(kMaxMapSide) +
                      " (use larger cells or cut the map)");
    }
    return static_cast<int>(cells);
  }

  std::int32_t cell_mm() const {
    const Json& value = number("cell_m");
    const double mm = value.get<double>() * 1000;
    if (!(mm >= 1 && mm <= kMaxMapCellM * 1000) || std::abs(mm - std::round(mm)) > 1e-6) {
      refuse("cell_m",
             value.dump() + " is not 0.001 to 10 m in whole millimetres (give the side of a cell in metres)");
    }
    return static_cast<std::int32_t>(std::lround(mm));
  }

  const Json& array(const Json& value, const std::string& where, int size) const {
    if (!value.is_array()) refuse(where, "is not an array (one array per map row)");
    if (value.size() != static_cast<std::size_t>(size)) {
      refuse(where, "has " + std::to_string(value.size()) + " entries instead of " + std::to_string(size) +
                        " (make it agree with rows and cols)");
    }
    return value;
  }

  template <class T>
  Image<T> plane(const GridGeometry& g, const std::string& key, T largest) const {
    const auto found = json_.find(key);
    if (found == json_.end()) return {};
    array(*found, key, g.rows);
    Image<T> image(g.cols, g.rows);
    for (int r = 0; r < g.rows; ++r) {
      const std::string where = key + "[" + std::to_string(r) + "]";
      const Json& row = array((*found)[static_cast<std::size_t>(r)], where, g.cols);
      for (int c = 0; c < g.cols; ++c)
        image.view().at(c, r) = cell(row[static_cast<std::size_t>(c)], where, c, largest);
    }
    return image;
  }

  template <class T>
  T cell(const Json& value, const std::string& row, int c, T largest) const {
    constexpr bool kInteger = std::numeric_limits<T>::is_integer;
    const double smallest = kInteger ? 0.0 : -static_cast<double>(largest);
    const bool kind = kInteger ? value.is_number_integer() : value.is_number();
    const double read = kind ? value.get<double>() : 0.0;
    if (!kind || !(smallest <= read && read <= static_cast<double>(largest)))
      refuse(row + "[" + std::to_string(c) + "]", value.dump() + " is not " + range_text(largest));
    return static_cast<T>(read);
  }

  static std::string range_text(double /*largest*/) { return "a number (write metres)"; }
  static std::string range_text(std::uint8_t /*largest*/) {
    return "a cell type (0 obstacle, 1 unoccupied, 2 unknown)";
  }
  static std::string range_text(std::uint32_t /*largest*/) {
    return "a count (write an integer from 0 to 2^32 - 1)";
  }

  std::string path_;
  Json json_;
};

CellType type_of_grey(const std::string& path, std::uint8_t grey, int u, int v) {
  if (grey == kPgmObstacle) return kCellObstacle;
  if (grey == kPgmUnoccupied) return kCellUnoccupied;
  if (grey == kPgmUnknown) return kCellUnknown;
  throw InputError(path, "pgm: " + std::to_string(grey) + " at column " + std::to_string(u) + ", row " +
                             std::to_string(v) +
                             " from the top is no cell type (0 obstacle, 254 unoccupied, 205 unknown, maxval 255)");
}

MapFile parse_pgm_map(const std::string& path, const std::string& text, double cell_m) {
  const Image<std::uint8_t> grey =
      decode_gray(path, {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
  if (grey.width() > kMaxMapSide || grey.height() > kMaxMapSide) {
    throw InputError(path, "pgm: " + std::to_string(grey.width()) + " x " + std::to_string(grey.height()) +
                               " cells are more than " + std::to_string(kMaxMapSide) +
                               " a side (use larger cells or cut the map)");
  }
  MapFile map;
  map.geometry = {grey.height(), grey.width(), static_cast<std::int32_t>(std::lround(cell_m * 1000))};
  map.type = Image<std::uint8_t>(grey.width(), grey.height());
  for (int v = 0; v < grey.height(); ++v) {
    for (int u = 0; u < grey.width(); ++u)
      map.type.view().at(u, grey.height() - 1 - v) = type_of_grey(path, grey.view().at(u, v), u, v);
  }
  return map;
}

// Calls text_of(column, row) for every cell and appends `"key":[` newline `[..],` newline ... `]`.
template <class TextOf>
void append_plane(std::string& out, const GridGeometry& g, const char* key, TextOf text_of) {
  out += std::string(",\n\"") + key + "\":[";
  for (int r = 0; r < g.rows; ++r) {
    out += r == 0 ? "\n[" : ",\n[";
    for (int c = 0; c < g.cols; ++c) {
      if (c > 0) out += ',';
      out += text_of(c, r);
    }
    out += ']';
  }
  out += ']';
}

std::string mean_height_text(std::uint32_t count, std::int64_t sum_mm) {
  if (count == 0) return "0";
  const long long mm = std::llround(static_cast<double>(sum_mm) / count);
  char text[32];
  std::snprintf(text, sizeof text, "%s%lld.%03lld", mm < 0 ? "-" : "", std::abs(mm) / 1000, std::abs(mm) % 1000);
  return text;
}

}  // namespace

MapFile read_map(const std::string& path, double pgm_cell_m) {
  return parse_map(path, read_text(path, kMaxMapBytes), pgm_cell_m);
}

MapFile parse_map(const std::string& path, const std::string& text, double pgm_cell_m) {
  if (text.starts_with("P5") || text.starts_with("P2")) return parse_pgm_map(path, text, pgm_cell_m);
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  if (first == std::string::npos || text[first] != '{')
    throw InputError(path, "map: is neither JSON nor PGM (P5, P2) (give a map that `lakshya process` wrote)");
  return JsonMap(path, text).read();
}

std::string write_map_json(const NavGrid& grid) {
  const GridGeometry& g = grid.geometry;
  std::string out = "{\"rows\":" + std::to_string(g.rows) + ",\"cols\":" + std::to_string(g.cols) +
                    ",\"cell_m\":" + Json(g.cell_mm / 1000.0).dump();
  append_plane(out, g, "type", [&](int c, int r) { return std::to_string(grid.type.at(c, r)); });
  append_plane(out, g, "count", [&](int c, int r) { return std::to_string(grid.count.at(c, r)); });
  append_plane(out, g, "mean_height_m",
               [&](int c, int r) { return mean_height_text(grid.count.at(c, r), grid.height_sum.at(c, r)); });
  append_plane(out, g, "floor_count", [&](int c, int r) { return std::to_string(grid.floor_count.at(c, r)); });
  append_plane(out, g, "below_count", [&](int c, int r) { return std::to_string(grid.below_count.at(c, r)); });
  return out + "}\n";
}

}  // namespace lakshya
