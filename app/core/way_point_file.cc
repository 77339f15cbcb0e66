#include "app/core/way_point_file.h"

#include <cmath>
#include <optional>

#include "app/core/file_bytes.h"
#include "app/core/input_error.h"
#include "app/core/input_text.h"

namespace lakshya {
namespace {

constexpr std::size_t kMaxBytes = std::size_t{1} << 20;
constexpr std::size_t kMaxPoints = 10'000;
constexpr double kFarthest = 100'000;
constexpr std::string_view kMetres = "east_m,north_m";
constexpr std::string_view kDegrees = "latitude_deg,longitude_deg";

class WayPointReader {
 public:
  explicit WayPointReader(const std::string& source) : source_(source) {}

  void line(std::string_view raw) {
    ++number_;
    const std::string_view text = trimmed(raw);
    if (text.empty() || text.front() == '#') return;
    if (!degrees_) return head(text);
    const std::size_t comma = text.find(',');
    if (comma == std::string_view::npos) refuse("no two numbers with a comma between: " + shown(text));
    const double first = parse_number(key(), trimmed(text.substr(0, comma)));
    const double second = parse_number(key(), trimmed(text.substr(comma + 1)));
    add(*degrees_ ? from_degrees(first, second) : WayPoint{first, second});
  }

  std::vector<WayPoint> finish() {
    if (!degrees_)
      refuse("an empty file (the first line is " + std::string(kMetres) + " or " + std::string(kDegrees) + ")");
    if (points_.empty()) refuse("no way points");
    return std::move(points_);
  }

 private:
  InputKey key() const { return {source_, "line " + std::to_string(number_)}; }
  [[noreturn]] void refuse(const std::string& why) const { key().refuse(why); }

  void head(std::string_view text) {
    if (text != kMetres && text != kDegrees) {
      refuse(shown(text) + " (the first line is " + std::string(kMetres) + " or " + std::string(kDegrees) + ")");
    }
    degrees_ = text == kDegrees;
  }

  std::optional<WayPoint> from_degrees(double latitude, double longitude) {
    if (std::abs(latitude) > 85 || std::abs(longitude) > 180)
      refuse("no latitude to 85 and longitude to 180 degrees");
    const GeoPoint point{latitude, longitude};
    if (start_) return local_way_point(*start_, point);
    start_ = point;
    return {};
  }

  void add(const std::optional<WayPoint>& point) {
    if (!point) return;
    if (std::hypot(point->east_m, point->north_m) > kFarthest) refuse("farther than 100 km from the start");
    if (points_.size() == kMaxPoints) refuse("more than " + std::to_string(kMaxPoints) + " way points");
    points_.push_back(*point);
  }

  const std::string& source_;
  int number_ = 0;
  std::optional<bool> degrees_;  // what the head says
  std::optional<GeoPoint> start_;
  std::vector<WayPoint> points_;
};

}  // namespace

std::vector<WayPoint> read_way_points(const std::string& path) {
  return parse_way_points(read_text(path, kMaxBytes), path);
}

std::vector<WayPoint> parse_way_points(std::string_view text, const std::string& source) {
  WayPointReader reader(source);
  for_each_line(text, [&](std::string_view line) { reader.line(line); });
  return reader.finish();
}

}  // namespace lakshya
