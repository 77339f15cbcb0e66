#include "app/core/vehicle_config_file.h"

#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <sstream>
#include <string_view>

#include "app/core/file_bytes.h"
#include "app/core/input_error.h"
#include "app/core/vehicle_config_check.h"
#include "app/core/vehicle_config_keys.h"
#include "app/core/vehicle_config_setting.h"

namespace lakshya {
namespace {

constexpr std::size_t kMaxBytes = std::size_t{1} << 20;
constexpr int kMaxIncluded = 4;

using Settings = std::vector<Setting>;

struct ConfigFile {
  std::optional<Setting> include;  // its `text` is the path
  std::optional<Setting> profile;  // its `text` is the name
  Settings groups;
  std::map<std::string, Settings, std::less<>> profiles;
};

std::string location(const std::string& path, const YAML::Mark& mark) {
  return mark.is_null() ? path : path + ":" + std::to_string(mark.line + 1);
}

struct Entry {
  std::string name;
  YAML::Node value;
  std::string where;
};

// The entries of a map in the order of the file; `name` is the map's own, for messages.
std::vector<Entry> entries(const std::string& path, const Entry& map) {
  if (!map.value.IsMap()) {
    throw InputError(map.where, map.name + ": not a map (give \"key: value\" lines, indented below it)");
  }
  std::vector<Entry> result;
  std::set<std::string> seen;
  for (const auto& item : map.value) {
    const std::string where = location(path, item.first.Mark());
    if (!item.first.IsScalar()) throw InputError(where, map.name + ": a key is not a name (write \"key: value\")");
    const std::string name = item.first.Scalar();
    if (!seen.insert(name).second) throw InputError(where, quote(name) + ": given twice (remove one)");
    result.push_back({name, item.second, where});
  }
  return result;
}

Setting scalar(const Entry& entry, const std::string& key) {
  if (!entry.value.IsScalar()) throw InputError(entry.where, key + ": not a single value (write \"key: value\")");
  return {key, entry.value.Scalar(), entry.where, entry.value.Tag() == "!"};
}

bool is_group(std::string_view name) {
  return std::any_of(kGroups.begin(), kGroups.end(), [&](const Group& group) { return group.name == name; });
}

[[noreturn]] void refuse_group(const Entry& entry) {
  std::vector<std::string_view> known{"include", "profile", "profiles"};
  std::string list = "include, profile, profiles";
  for (const Group& group : kGroups) {
    known.push_back(group.name);
    list.append(", ").append(group.name);
  }
  for (const std::string_view key : key_names())
    known.push_back(key);  // a key outside its group
  const std::string hint = did_you_mean(entry.name, known);
  throw InputError(entry.where,
                   quote(entry.name) + ": unknown group (" + (hint.empty() ? "known: " + list : hint) + ")");
}

Settings group_settings(const std::string& path, const Entry& group) {
  if (!is_group(group.name)) refuse_group(group);
  Settings settings;
  for (const Entry& entry : entries(path, group))
    settings.push_back(scalar(entry, group.name + "." + entry.name));
  return settings;
}

Settings profile_settings(const std::string& path, const Entry& profile) {
  Settings settings;
  for (const Entry& group : entries(path, profile)) {
    for (Setting& setting : group_settings(path, group))
      settings.push_back(std::move(setting));
  }
  return settings;
}

void check_profile_name(const std::string& name, const std::string& where) {
  const auto allowed = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-';
  };
  if (name.empty() || name.size() > 64 || !std::all_of(name.begin(), name.end(), allowed)) {
    throw InputError(where,
                     "profiles: " + quote(name) + " is no profile name (1 to 64 letters, digits, '_' or '-')");
  }
}

ConfigFile config_file(const std::string& path, const YAML::Node& root) {
  ConfigFile file;
  for (const Entry& entry : entries(path, {"the file", root, path})) {
    if (entry.name == "include") {
      file.include = scalar(entry, "include");
    } else if (entry.name == "profile") {
      file.profile = scalar(entry, "profile");
    } else if (entry.name == "profiles") {
      for (const Entry& profile : entries(path, entry)) {
        check_profile_name(profile.name, profile.where);
        file.profiles[profile.name] = profile_settings(path, profile);
      }
    } else {
      for (Setting& setting : group_settings(path, entry))
        file.groups.push_back(std::move(setting));
    }
  }
  return file;
}

class NoEvents : public YAML::EventHandler {
 public:
  void OnDocumentStart(const YAML::Mark& /*mark*/) override {}
  void OnDocumentEnd() override {}
  void OnNull(const YAML::Mark& /*mark*/, YAML::anchor_t /*anchor*/) override {}
  void OnAlias(const YAML::Mark& /*mark*/, YAML::anchor_t /*anchor*/) override {}
  void OnScalar(const YAML::Mark& /*mark*/, const std::string& /*tag*/, YAML::anchor_t /*anchor*/,
                const std::string& /*value*/) override {}
  void OnSequenceStart(const YAML::Mark& /*mark*/, const std::string& /*tag*/, YAML::anchor_t /*anchor*/,
                       YAML::EmitterStyle::value /*style*/) override {}
  void OnSequenceEnd() override {}
  void OnMapStart(const YAML::Mark& /*mark*/, const std::string& /*tag*/, YAML::anchor_t /*anchor*/,
                  YAML::EmitterStyle::value /*style*/) override {}
  void OnMapEnd() override {}
};

// Not by YAML::LoadAll(): given a file that begins with a comma, that of yaml-cpp 0.7 adds empty documents until the
// memory is full.
bool has_second_document(const std::string& text) {
  std::istringstream stream(text);
  YAML::Parser parser(stream);
  NoEvents ignored;
  return parser.HandleNextDocument(ignored) && parser.HandleNextDocument(ignored);
}

ConfigFile parse_config_file(const std::string& text, const std::string& path) {
  try {
    const YAML::Node document = YAML::Load(text);
    if (document.IsNull()) {
      throw InputError(path, "the file: no settings in it (`lakshya config` prints a complete file)");
    }
    if (has_second_document(text))
      throw InputError(path, "the file: several YAML documents (keep one, without \"---\")");
    return config_file(path, document);
  } catch (const YAML::Exception& e) {
    throw InputError(location(path, e.mark),
                     "broken YAML: " + e.msg + " (compare with the output of `lakshya config`)");
  }
}

// The file with what it includes, which counts before its own.
ConfigFile with_included(ConfigFile own, const std::string& path, int depth) {
  if (!own.include) return own;
  const Setting& include = *own.include;
  if (include.text.empty()) throw InputError(include.where, "include: no file (name one, relative to this file)");
  if (depth == kMaxIncluded)
    throw InputError(include.where, "include: " + std::to_string(kMaxIncluded) +
                                        " files include one another already (is one of them this file?)");
  const std::string other = (std::filesystem::path(path).parent_path() / include.text).string();
  std::string text;
  try {
    text = read_text(other, kMaxBytes);
  } catch (const InputError& e) {
    throw InputError(include.where, std::string("include: ") + e.what());
  }
  ConfigFile file = with_included(parse_config_file(text, other), other, depth + 1);
  if (own.profile) file.profile = own.profile;
  file.groups.insert(file.groups.end(), own.groups.begin(), own.groups.end());
  for (const auto& [name, settings] : own.profiles)
    file.profiles[name].insert(file.profiles[name].end(), settings.begin(), settings.end());
  return file;
}

std::vector<std::string_view> profile_names(const ConfigFile& file) {
  std::vector<std::string_view> names(kProfiles.size());
  std::transform(kProfiles.begin(), kProfiles.end(), names.begin(), [](const Profile& p) { return p.name; });
  for (const auto& [name, settings] : file.profiles) {
    if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  }
  return names;
}

void check_profile_known(const ConfigFile& file, const std::string& name, const std::string& where) {
  const std::vector<std::string_view> known = profile_names(file);
  if (std::find(known.begin(), known.end(), name) != known.end()) return;
  std::string list;
  for (const std::string_view k : known)
    list.append(list.empty() ? "" : ", ").append(k);
  throw InputError(where, "profile: " + quote(name) + " is unknown (known: " + list + ")");
}

std::string selected_profile(const ConfigFile& file, const std::string& option) {
  if (file.profile) check_profile_known(file, file.profile->text, file.profile->where);
  if (!option.empty()) {
    check_profile_known(file, option, "--profile " + option);
    return option;
  }
  return file.profile ? file.profile->text : VehicleConfig{}.profile;
}

Settings built_in_settings(std::string_view profile_name) {
  Settings settings;
  for (const Profile& profile : kProfiles) {
    if (profile.name != profile_name) continue;
    for (const Override& o : profile.overrides) {
      settings.push_back(
          {std::string(o.key), std::string(o.value), "built-in profile " + std::string(profile.name)});
    }
  }
  return settings;
}

Settings command_line_settings(const std::vector<std::string>& sets) {
  Settings settings;
  std::set<std::string> seen;
  for (const std::string& text : sets) {
    settings.push_back(parse_set(text));
    if (!seen.insert(settings.back().key).second) {
      throw InputError(settings.back().where, settings.back().key + ": set twice (remove one)");
    }
  }
  return settings;
}

// A mistake in a profile that is not selected today is still a mistake.
void check_every_profile(const ConfigFile& file) {
  for (const auto& [name, settings] : file.profiles) {
    VehicleConfig unused;
    for (const Setting& setting : settings)
      apply(setting, unused);
  }
}

// Names the source of the last value that takes part: the one that a person most likely just changed.
void check_contradictions(const VehicleConfig& config, const Settings& applied, const std::string& path) {
  const std::optional<Contradiction> found = find_contradiction(config);
  if (!found) return;
  const auto involved = [&](const Setting& s) {
    return std::find(found->keys.begin(), found->keys.end(), s.key) != found->keys.end();
  };
  const auto last = std::find_if(applied.rbegin(), applied.rend(), involved);
  throw InputError(last != applied.rend() ? last->where : path, found->reason);
}

VehicleConfig merged(const ConfigFile& file, const std::string& path, const std::string& profile,
                     const std::vector<std::string>& sets) {
  check_every_profile(file);

  VehicleConfig config;
  config.profile = selected_profile(file, profile);
  Settings settings = built_in_settings(config.profile);
  settings.insert(settings.end(), file.groups.begin(), file.groups.end());
  const auto own = file.profiles.find(config.profile);
  if (own != file.profiles.end()) settings.insert(settings.end(), own->second.begin(), own->second.end());
  const Settings last = command_line_settings(sets);
  settings.insert(settings.end(), last.begin(), last.end());

  for (const Setting& setting : settings)
    apply(setting, config);
  check_contradictions(config, settings, path);
  return config;
}

}  // namespace

VehicleConfig load_vehicle_config(const std::string& path, const std::string& profile,
                                  const std::vector<std::string>& sets) {
  if (path.empty()) return merged({}, path, profile, sets);
  return merged(with_included(parse_config_file(read_text(path, kMaxBytes), path), path, 0), path, profile, sets);
}

VehicleConfig parse_vehicle_config(const std::string& text, const std::string& source, const std::string& profile,
                                   const std::vector<std::string>& sets) {
  const ConfigFile file = parse_config_file(text, source);
  if (file.include)
    throw InputError(file.include->where, "include: only a file may include another (leave it out)");
  return merged(file, source, profile, sets);
}

}  // namespace lakshya
