#include "app/tools/profile_trace.h"

#include <nlohmann/json.hpp>

namespace lakshya {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kProcess = 1;
constexpr int kThread = 1;

Json metadata(const char* name, const char* value) {
  return {{"name", name}, {"ph", "M"}, {"pid", kProcess}, {"tid", kThread}, {"args", {{"name", value}}}};
}

class Events {
 public:
  explicit Events(Nanoseconds start) : start_(start) {}

  void add(const char* name, const char* category, Nanoseconds begin, Nanoseconds took) {
    list.push_back({{"name", name},
                    {"cat", category},
                    {"ph", "X"},
                    {"ts", microseconds(begin - start_)},
                    {"dur", microseconds(took)},
                    {"pid", kProcess},
                    {"tid", kThread}});
  }

  Json list = Json::array({metadata("process_name", "lakshya"), metadata("thread_name", "frame loop")});

 private:
  // Three digits behind the point: as exact as the clock.
  static double microseconds(Nanoseconds t) { return static_cast<double>(t) / 1000.0; }

  Nanoseconds start_;
};

void add_frame(const FrameTimes& f, int number, Events& events) {
  events.add("frame", "frame", f.begin.front(), f.frame());
  events.list.back()["args"] = {{"frame", number}};
  for (int i = 0; i < kStages; ++i) {
    const auto stage = static_cast<std::size_t>(i);
    events.add(to_string(static_cast<Stage>(i)), "stage", f.begin[stage], f.took[stage]);
    if (static_cast<Stage>(i) != Stage::match) continue;
    for (int p = 0; p < kMatchPasses; ++p) {
      const auto pass = static_cast<MatchPass>(p);
      events.add(to_string(pass), "pass", f.match.at[static_cast<std::size_t>(p)], f.pass(pass));
    }
  }
}

}  // namespace

std::string trace_json(std::span<const FrameTimes> frames) {
  Events events(frames.empty() ? 0 : frames.front().begin.front());
  int number = 0;
  for (const FrameTimes& frame : frames)
    add_frame(frame, number++, events);
  return Json{{"traceEvents", std::move(events.list)}, {"displayTimeUnit", "ms"}}.dump() + "\n";
}

}  // namespace lakshya
