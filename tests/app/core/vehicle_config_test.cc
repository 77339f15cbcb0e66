#include <gtest/gtest.h>

#include <cstdlib>
#include <limits>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <type_traits>

#include "app/core/vehicle_config_file.h"
#include "app/core/vehicle_config_keys.h"
#include "app/core/vehicle_config_text.h"
#include "tests/support/config_checks.h"

namespace lakshya {
namespace {

// Number of fields of an aggregate: the longest list of initialisers that it accepts.
struct AnyField {
  template <class T>
  operator T() const;  // NOLINT(google-explicit-constructor)
};
template <class T, class... Fields>
constexpr int field_count() {
  if constexpr (requires { T{Fields{}..., AnyField{}}; }) {
    return field_count<T, Fields..., AnyField>();
  } else {
    return static_cast<int>(sizeof...(Fields));
  }
}

TEST(VehicleConfigKeys, EveryFieldHasItsKey) {
  std::map<std::string, int> keys;
  const VehicleConfig config;
  visit_keys(config, [&](const Key& key, const auto&, const auto&) {
    ++keys[std::string(key.name.substr(0, key.name.find('.')))];
  });
  EXPECT_EQ(keys["camera"], field_count<CameraConfig>());
  EXPECT_EQ(keys["matcher"], field_count<MatcherConfig>());
  EXPECT_EQ(keys["prune"], field_count<PruneConfig>());
  EXPECT_EQ(keys["grid"], field_count<GridConfig>());
  EXPECT_EQ(keys["score"], field_count<ScoreConfig>());
  EXPECT_EQ(keys["map"], field_count<MapConfig>());
  EXPECT_EQ(keys["planner"], field_count<PlannerParams>());
  EXPECT_EQ(keys["vehicle"], field_count<VehicleParams>());
  EXPECT_EQ(keys["drivers"], field_count<DriversConfig>());
  EXPECT_EQ(keys["folder"], field_count<FolderConfig>());
  EXPECT_EQ(keys["v4l2"], field_count<V4l2Config>());
  EXPECT_EQ(keys["quicksilver"], field_count<QuicksilverConfig>());
  EXPECT_EQ(keys["os5000"], field_count<Os5000Config>());
  EXPECT_EQ(keys["iio"], field_count<IioConfig>());
  EXPECT_EQ(keys["dc1394"], field_count<Dc1394Config>());
  EXPECT_EQ(keys["record"], field_count<RecordConfig>());
  EXPECT_EQ(keys["pwm"], field_count<PwmConfig>());
  EXPECT_EQ(keys["compass"], field_count<CompassConfig>());
  EXPECT_EQ(keys["odometry"], field_count<OdometryConfig>());
  EXPECT_EQ(keys["estop"], field_count<EstopConfig>());
  EXPECT_EQ(keys["watchdog"], field_count<WatchdogConfig>());
  EXPECT_EQ(keys.size() + 1, static_cast<std::size_t>(field_count<VehicleConfig>()));  // and the profile's name
}

TEST(VehicleConfigKeys, NamesAndFieldsAreDistinct) {
  std::set<std::string_view> names;
  std::set<const void*> fields;
  const VehicleConfig config;
  visit_keys(config, [&](const Key& key, const auto& field, const auto&) {
    EXPECT_TRUE(names.insert(key.name).second) << key.name;
    EXPECT_TRUE(fields.insert(&field).second) << key.name;
    EXPECT_FALSE(key.meaning.empty() || key.meaning.ends_with('.')) << key.name;
    EXPECT_EQ(key.meaning.find('|'), std::string_view::npos) << key.name;  // it goes into a Markdown table
  });
}

TEST(VehicleConfigKeys, EachKeySetsItsOwnField) {
  VehicleConfig config = load_vehicle_config(
      "", "",
      {"camera.pitch_deg=1.5", "camera.roll_deg=-2", "camera.left_m=0.1", "matcher.p1=9", "grid.rows=150",
       "score.min_height_m=0.08", "planner.unknown=slow", "vehicle.latency_s=.5"});
  EXPECT_EQ(config.camera.pitch_deg, 1.5);
  EXPECT_EQ(config.camera.roll_deg, -2.0);
  EXPECT_EQ(config.camera.left_m, 0.1);
  EXPECT_EQ(config.matcher.p1, 9);
  EXPECT_EQ(config.grid.rows, 150);
  EXPECT_EQ(config.score.min_height_m, 0.08);
  EXPECT_EQ(config.planner.unknown, "slow");
  EXPECT_EQ(config.vehicle.latency_s, 0.5);
}

TEST(VehicleConfigKeys, DefaultsAreInsideTheirOwnRanges) {
  const VehicleConfig config;
  visit_keys(config, [](const Key& key, const auto& field, const auto&) {
    std::ostringstream text;
    text << key.name << "=" << field;
    EXPECT_EQ(set_refusal(text.str()), "accepted");
  });
}

// Both ends of every range are accepted or lead to a contradiction; just beyond them is out of range.
TEST(VehicleConfigKeys, RangesIncludeTheirEndsOnly) {
  const auto check = [](const Key& key, double value, bool expected) {
    const std::string message = set_refusal(std::string(key.name) + "=" + number_text(value));
    EXPECT_EQ(!contains(message, "out of range"), expected) << message;
  };
  const VehicleConfig config;
  visit_keys(config, [&](const Key& key, const auto& field, const auto& allowed) {
    if constexpr (std::is_same_v<std::decay_t<decltype(allowed)>, Range>) {
      const double outside = std::is_same_v<std::decay_t<decltype(field)>, int> ? 1 : 1e-6;
      check(key, allowed.min, true);
      check(key, allowed.max, true);
      check(key, allowed.min - outside, false);
      check(key, allowed.max + outside, false);
    } else if constexpr (std::is_same_v<std::decay_t<decltype(allowed)>, Text>) {
      EXPECT_EQ(set_refusal(std::string(key.name) + "=" + std::string(allowed.longest, 'x')), "accepted");
      for (const std::string& text :
           {std::string(allowed.longest + 1, 'x'), std::string("a\"b"), std::string("a\nb")})
        EXPECT_TRUE(contains(set_refusal(std::string(key.name) + "=" + text), "cannot be taken (allowed: text of"));
    } else {
      EXPECT_TRUE(contains(set_refusal(std::string(key.name) + "=nonsense"), "is not known (allowed: "));
    }
  });
}

TEST(VehicleConfigProfiles, BuiltInValues) {
  const VehicleConfig outdoor = load_vehicle_config("", "", {});
  EXPECT_EQ(outdoor.profile, "outdoor");
  EXPECT_EQ(outdoor.prune.max_depth_m, 20.0);
  EXPECT_EQ(outdoor.vehicle.max_speed_mps, 7.0);
  EXPECT_EQ(outdoor.vehicle.contact_time_s, 2.8);
  EXPECT_EQ(outdoor.planner.active_radius_m, 8.0);

  const VehicleConfig indoor = load_vehicle_config("", "indoor", {});
  EXPECT_EQ(indoor.profile, "indoor");
  EXPECT_EQ(indoor.prune.max_depth_m, 8.0);
  EXPECT_EQ(indoor.vehicle.max_speed_mps, 1.0);
  EXPECT_EQ(indoor.vehicle.contact_time_s, 1.5);
  EXPECT_EQ(indoor.planner.active_radius_m, 3.0);
}

TEST(VehicleConfigText, DocumentationHoldsTheTable) {
  if (std::getenv("LAKSHYA_ROOT") == nullptr) GTEST_SKIP() << "LAKSHYA_ROOT does not name the source tree";
  const std::string page = source_file("docs/configuration.md");
  EXPECT_TRUE(page.ends_with(markdown_table())) << "write it again with `lakshya config --markdown`";
}

TEST(VehicleConfigText, NumbersAndRanges) {
  EXPECT_EQ(number_text(0.6), "0.6");
  EXPECT_EQ(number_text(20), "20");
  EXPECT_EQ(number_text(0.0001), "0.0001");
  EXPECT_EQ(number_text(std::numeric_limits<double>::denorm_min()).size(), 326U);
  EXPECT_EQ(number_text(-std::numeric_limits<double>::max()).size(), 310U);
  EXPECT_EQ(allowed_text(Range{0.05, 5}, "m"), "0.05 .. 5 m");
  EXPECT_EQ(allowed_text(Range{16, 512, 16}, "px"), "16 .. 512 px in steps of 16");
  EXPECT_EQ(allowed_text(Range{3, 5, 2}, ""), "3 or 5");
  EXPECT_EQ(allowed_text(Names{kUnknownNames}, ""), "stop or slow");
}

TEST(VehicleConfigText, TextIsWrittenSoThatItIsReadAgain) {
  VehicleConfig config;
  config.folder.path = "/data/a: b #1 'c' \xc3\xa9";
  config.record.path = "yes";
  const VehicleConfig again = parse_vehicle_config(effective_yaml(config), "text", "", {});
  EXPECT_EQ(again.folder.path, config.folder.path);
  EXPECT_EQ(again.record.path, config.record.path);
}

TEST(VehicleConfigSet, Refusals) {
  expect_parts(set_refusal("camera.hieght_m=0.4"),
               {"--set camera.hieght_m=0.4: ", "did you mean camera.height_m?"});
  expect_parts(set_refusal("height_m=0.4"), {"did you mean camera.height_m?"});
  expect_parts(set_refusal("grid.height_m=0.4"), {"did you mean camera.height_m?"});
  expect_parts(set_refusal("wobble.bobble=1"), {"unknown key (`lakshya config` lists all keys)"});
  expect_parts(set_refusal(std::string(5000, 'x') + "=1"), {"unknown key"});
  expect_parts(set_refusal("camera.height_m=9"), {"camera.height_m: \"9\" is out of range (allowed: 0.05 .. 5 m)"});
  for (const char* value : {"", "tall", " 0.5", "0.5 ", "0,5", "0x1", "--1", "+-1", "1_0", "0.5m"}) {
    expect_parts(set_refusal(std::string("camera.height_m=") + value), {"camera.height_m: ", "is not a number"});
  }
  for (const char* value : {"nan", "-nan", "inf", "-inf", "1e999"}) {
    expect_parts(set_refusal(std::string("camera.height_m=") + value), {"is not a finite number (allowed: 0.05"});
  }
  for (const char* value : {"64.0", "6e1", "", "many", "nan"}) {
    expect_parts(set_refusal(std::string("matcher.disparities=") + value), {"is not a whole number"});
  }
  for (const char* value : {"24", "8", "528", "-16", "99999999999999999999", "-99999999999999999999"}) {
    expect_parts(set_refusal(std::string("matcher.disparities=") + value),
                 {"allowed: 16 .. 512 px in steps of 16"});
  }
  expect_parts(set_refusal("matcher.paths=4"), {"allowed: 3 or 5"});
  expect_parts(set_refusal("grid.cols=201"), {"in steps of 2"});
  expect_parts(set_refusal("grid.cell_m=0.1005"), {"in steps of 0.001"});
  EXPECT_EQ(set_refusal("grid.cell_m=0.025"), "accepted");
  expect_parts(set_refusal("planner.unknown=halt"), {"\"halt\" is not known (allowed: stop or slow)"});
  expect_parts(set_refusal("camera.height_m"), {"not of the form key=value"});
  expect_parts(set_refusal("=1"), {"not of the form key=value"});
  expect_parts(set_refusal("profile=indoor"), {"use --profile"});
  EXPECT_TRUE(contains(refusal([] {
                         load_vehicle_config("", "", {"matcher.p1=9", "matcher.p1=9"});
                       }),
                       "--set matcher.p1=9: matcher.p1: set twice"));
}

TEST(VehicleConfigSet, Contradictions) {
  expect_parts(
      set_refusal("prune.floor_tolerance_m=0.6"),
      {"--set prune.floor_tolerance_m=0.6: prune.floor_tolerance_m: 0.6", "less than camera.height_m (0.6)"});
  expect_parts(set_refusal("camera.height_m=0.05"), {"accepted"});
  expect_parts(set_refusal("score.min_height_m=1.2"), {"less than prune.clearance_m (1.2)"});
  expect_parts(set_refusal("matcher.p1=37"), {"not be more than matcher.p2_min (36)"});
  EXPECT_EQ(set_refusal("matcher.p1=36"), "accepted");
  expect_parts(set_refusal("planner.threshold_low=121"), {"not be more than planner.threshold_high (120)"});
  EXPECT_EQ(set_refusal("planner.threshold_low=120"), "accepted");
  expect_parts(set_refusal("planner.cost_target=4"), {"planner.cost_heading: 2 + planner.cost_previous (2)"});
  expect_parts(set_refusal("planner.active_radius_m=0.5"), {"accepted"});
  expect_parts(set_refusal("vehicle.safety_distance_m=2"), {"accepted"});
  const auto load = [](const std::vector<std::string>& sets) {
    return refusal([&] { load_vehicle_config("", "indoor", sets); });
  };
  expect_parts(load({"vehicle.radius_m=2.9"}), {"less than planner.active_radius_m (3)"});
  expect_parts(load({"prune.clearance_m=0.1", "camera.height_m=2", "prune.floor_tolerance_m=0.1"}),
               {"less than prune.clearance_m (0.1)"});
}

}  // namespace
}  // namespace lakshya
