// Facts in words: the camera, the command, the time of each stage.
#include <algorithm>

#include "app/nav/sectors.h"
#include "app/tools/picture_colors.h"
#include "app/tools/picture_panels.h"

namespace lakshya {
namespace {

constexpr int kFactRow = 22;
constexpr int kNameWidth = 150;

std::string pair_text(double left, double right, int places, const std::string& unit) {
  return "left " + decimal(left, places) + ", right " + decimal(right, places) + " " + unit;
}

std::vector<Fact> command_facts(const PictureInput& input) {
  const Plan& plan = input.frame.plan;
  const std::string end = plan.clear_end == ClearEnd::obstacle ? ", then an obstacle" : ", then unknown";
  return {{"target", degrees_text(input.target_rad)},
          {"speed", decimal(plan.speed_mps, 2) + " m/s"},
          {"turn rate", decimal(degrees(plan.turn_rate_rps), 1) + " deg/s"},
          {"wheels", pair_text(plan.wheels.left_mps, plan.wheels.right_mps, 2, "m/s")},
          {"clear distance", plan.blocked ? "none" : decimal(plan.clear_distance_m, 2) + " m" + end}};
}

double milliseconds(Nanoseconds time) {
  return static_cast<double>(time) * 1e-6;
}

std::string stage_name(int stage) {
  std::string name = to_string(static_cast<Stage>(stage));
  std::replace(name.begin(), name.end(), '_', ' ');
  return name;
}

void draw_stage_times(Canvas& sheet, const Box& box, const FrameResult& frame) {
  double total = 0;
  for (const Nanoseconds time : frame.times.took)
    total += milliseconds(time);
  sheet.text({static_cast<double>(box.x), box.y + kHeadText}, "Time: " + decimal(total, 1) + " ms", kHeadText,
             kInk);
  const int bar_left = box.x + kNameWidth;
  const int bar_width = box.width - kNameWidth - 110;
  for (int stage = 0; stage < kStages; ++stage) {
    const double time = milliseconds(frame.times.took[static_cast<std::size_t>(stage)]);
    const int y = box.y + 26 + stage * kFactRow;
    const double baseline = y + (kFactRow + kBodyText) / 2;
    sheet.text({static_cast<double>(box.x), baseline}, stage_name(stage), kBodyText, kFaintInk);
    const int width = total > 0 ? static_cast<int>(bar_width * time / total) : 0;
    sheet.fill({bar_left, y + 5, std::max(width, 1), kFactRow - 10}, kActiveColor);
    sheet.text({static_cast<double>(box.right()), baseline}, decimal(time, 2) + " ms", kBodyText, kInk,
               Align::right);
  }
}

}  // namespace

std::string command_text(const Plan& plan) {
  if (!plan.blocked) return "Steer " + degrees_text(plan.direction);
  return plan.recovery == Side::left ? "BLOCKED: turn left" : "BLOCKED: turn right";
}

void draw_facts(Canvas& sheet, const Box& box, const std::vector<Fact>& facts) {
  int y = box.y;
  for (const Fact& fact : facts) {
    const double baseline = y + (kFactRow + kBodyText) / 2;
    sheet.text({static_cast<double>(box.x), baseline}, fact.name, kBodyText, kFaintInk);
    sheet.text({box.x + kNameWidth + 0.0, baseline}, text_that_fits(fact.value, kBodyText, box.width - kNameWidth),
               kBodyText, kInk);
    y += kFactRow;
  }
}

std::vector<Fact> camera_facts(const PictureInput& input) {
  const RectifiedGeometry& camera = input.camera;
  const CameraConfig& mount = input.config.camera;
  const MatcherConfig& matcher = input.config.matcher;
  const int first = matcher.min_disparity;
  return {{"image", std::to_string(camera.width) + " x " + std::to_string(camera.height) + " px, focal length " +
                        decimal(camera.focal_px, 1) + " px"},
          {"baseline", decimal(camera.baseline_m, 3) + " m"},
          {"mount", "height " + decimal(mount.height_m, 2) + " m, pitch " + decimal(mount.pitch_deg, 1) +
                        ", roll " + decimal(mount.roll_deg, 1) + ", yaw " + decimal(mount.yaw_deg, 1) + " deg"},
          {"matcher", matcher.name + ", disparities " + std::to_string(first) + " to " +
                          std::to_string(first + matcher.disparities - 1) + " px"},
          {"profile", input.config.profile}};
}

void draw_command(Canvas& sheet, const Box& box, const PictureInput& input) {
  const Plan& plan = input.frame.plan;
  sheet.text({static_cast<double>(box.x), box.y + kTitleText}, command_text(plan), kTitleText,
             plan.blocked ? kBlockedColor : kChosenColor, Align::left, 2);
  const std::vector<Fact> facts = command_facts(input);
  draw_facts(sheet, {box.x, box.y + 38, box.width, 0}, facts);
  const int below = box.y + 38 + static_cast<int>(facts.size()) * kFactRow + 24;
  draw_stage_times(sheet, {box.x, below, box.width, 0}, input.frame);
}

}  // namespace lakshya
