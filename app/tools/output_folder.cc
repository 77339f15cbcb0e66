#include "app/tools/output_folder.h"

#include <cerrno>
#include <cstdlib>
#include <filesystem>
#include <system_error>
#include <vector>

#include "app/core/input_error.h"

namespace lakshya {
namespace fs = std::filesystem;
namespace {

std::string without_trailing_slash(std::string path) {
  while (path.size() > 1 && path.back() == '/')
    path.pop_back();
  return path;
}

[[noreturn]] void refuse(const std::string& path, const std::string& why) {
  throw InputError(path, "cannot write results here: " + why + " (choose another --out)");
}

}  // namespace

OutputFolder::OutputFolder(const std::string& wanted) : wanted_(without_trailing_slash(wanted)) {
  if (wanted_.empty()) refuse("--out", "the name is empty");
  std::error_code error;
  const fs::file_status status = fs::status(wanted_, error);
  if (fs::exists(status) && !fs::is_directory(status)) refuse(wanted_, "it exists and is not a folder");
  const fs::path parent = fs::absolute(wanted_).parent_path();
  fs::create_directories(parent, error);
  if (error) refuse(wanted_, error.message());
  temporary_ = wanted_ + ".part-XXXXXX";
  if (mkdtemp(temporary_.data()) == nullptr)
    refuse(wanted_, std::error_code(errno, std::generic_category()).message());
  fs::permissions(temporary_, fs::perms(0755), error);
}

OutputFolder::~OutputFolder() {
  std::error_code ignored;
  if (!temporary_.empty()) fs::remove_all(temporary_, ignored);
}

void OutputFolder::commit(const std::string& stale) {
  std::error_code error;
  if (!fs::exists(wanted_, error)) {
    fs::rename(temporary_, wanted_, error);
    if (error) refuse(wanted_, error.message());
    temporary_.clear();
    return;
  }
  // Whatever could refuse a file is looked for before the first one moves.
  std::vector<fs::path> files;
  for (fs::directory_iterator it(temporary_, error), end; !error && it != end; it.increment(error)) {
    files.push_back(it->path().filename());
    const fs::path target = fs::path(wanted_) / files.back();
    if (fs::is_directory(target, error)) refuse(target.string(), "a folder of that name is in the way");
    error.clear();  // the target need not exist
  }
  if (error) refuse(wanted_, error.message());
  if (!fs::exists(file(stale), error)) fs::remove(fs::path(wanted_) / stale, error);
  for (const fs::path& name : files) {
    fs::rename(fs::path(temporary_) / name, fs::path(wanted_) / name, error);
    if (error) refuse(wanted_, error.message());
  }
}

}  // namespace lakshya
