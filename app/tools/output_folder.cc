#include "app/tools/output_folder.h"

#include <cstdlib>
#include <filesystem>
#include <system_error>

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
  if (!fs::exists(wanted_)) {
    fs::rename(temporary_, wanted_, error);
    if (error) refuse(wanted_, error.message());
    temporary_.clear();
    return;
  }
  if (!fs::exists(file(stale))) fs::remove(fs::path(wanted_) / stale, error);
  for (const fs::directory_entry& entry : fs::directory_iterator(temporary_)) {
    fs::rename(entry.path(), fs::path(wanted_) / entry.path().filename(), error);
    if (error) refuse(wanted_, error.message());
  }
}

}  // namespace lakshya
