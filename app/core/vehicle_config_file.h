// Reads vehicle.yaml. The keys, their ranges and the built-in profiles are in vehicle_config_keys.h.
#pragma once

#include <string>
#include <vector>

#include "app/core/vehicle_config.h"

namespace lakshya {

// path: a YAML file of at most 1 MiB; empty: built-in defaults only. It may name another one, relative to itself, with `include: FILE`
// (and that one a third; four at most), whose groups and profiles count before its own.
// profile: a name that the file defines, "outdoor" or "indoor"; empty: the file's `profile`, else "outdoor".
// sets: "group.key=value" each, a key at most once.
// Of two values for one key the later in this list counts: built-in default, built-in profile of the selected name,
// groups of the file, the file's profile of the selected name, sets (in each of the file's: what is included first). So nothing that a file says is overruled by
// something built in.
// Throws InputError ("file:line: key: reason (what to do)", or "--set key=value: ..." and "--profile name: ...")
// for an unreadable, empty or broken file, unknown or repeated keys, groups and profiles, wrong types, values that
// are not finite or out of range, also in profiles that are not selected, and for values that contradict each
// other.
VehicleConfig load_vehicle_config(const std::string& path, const std::string& profile,
                                  const std::vector<std::string>& sets);

// The same for a file's content, which includes nothing; `source` stands for the path in messages.
VehicleConfig parse_vehicle_config(const std::string& text, const std::string& source, const std::string& profile,
                                   const std::vector<std::string>& sets);

}  // namespace lakshya
