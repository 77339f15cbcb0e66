#include "app/core/file_bytes.h"

#include <cerrno>
#include <filesystem>
#include <fstream>
#include <system_error>

#include "app/core/input_error.h"

namespace lakshya {
namespace {

namespace fs = std::filesystem;

std::string last_system_error() {
  return std::generic_category().message(errno);
}

// A file may have any size on disk, so the size is judged before anything is allocated.
std::size_t checked_size(const std::string& path, std::size_t max_bytes) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (status.type() == fs::file_type::not_found) {
    throw InputError(path, "file: does not exist (check the path)");
  }
  if (fs::is_directory(status)) throw InputError(path, "file: is a directory (name a file inside it)");
  if (status.type() == fs::file_type::none) {
    throw InputError(path,
                     "file: cannot be examined: " + error.message() + " (check the path and its permissions)");
  }
  if (!fs::is_regular_file(status)) {
    throw InputError(path, "file: is not a regular file (copy its content into one)");
  }
  const std::uintmax_t size = fs::file_size(path, error);
  if (error) throw InputError(path, "file: has no size: " + error.message() + " (check the path)");
  if (size == 0) throw InputError(path, "file: is empty (was it written to the end?)");
  if (size > max_bytes) {
    throw InputError(path, "file: has " + std::to_string(size) + " bytes, more than the " +
                               std::to_string(max_bytes) + " that are accepted here (is it the right file?)");
  }
  return static_cast<std::size_t>(size);
}

template <class Bytes>
Bytes read_all(const std::string& path, std::size_t max_bytes) {
  const std::size_t size = checked_size(path, max_bytes);
  errno = 0;
  std::ifstream in(path, std::ios::binary);
  if (!in) throw InputError(path, "file: cannot be opened: " + last_system_error() + " (check its permissions)");
  Bytes bytes(size, {});
  in.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(size));
  if (static_cast<std::size_t>(in.gcount()) != size) {
    throw InputError(path, "file: ends after " + std::to_string(in.gcount()) + " of " + std::to_string(size) +
                               " bytes (was it changed while being read?)");
  }
  return bytes;
}

}  // namespace

std::vector<std::uint8_t> read_file(const std::string& path, std::size_t max_bytes) {
  return read_all<std::vector<std::uint8_t>>(path, max_bytes);
}

std::string read_text(const std::string& path, std::size_t max_bytes) {
  return read_all<std::string>(path, max_bytes);
}

void write_file_atomically(const std::string& path, std::string_view bytes) {
  const std::string part = path + ".part";
  errno = 0;
  std::ofstream out(part, std::ios::binary | std::ios::trunc);
  if (!out) {
    throw InputError(
        path, "file: cannot be created: " + last_system_error() + " (does its folder exist, is it writable?)");
  }
  out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  out.close();
  std::string reason = out ? "" : last_system_error();
  std::error_code error;
  if (out) {
    fs::rename(part, path, error);
    if (!error) return;
    reason = error.message();
  }
  fs::remove(part, error);
  throw InputError(path, "file: cannot be written: " + reason + " (check the free space and the name)");
}

}  // namespace lakshya
