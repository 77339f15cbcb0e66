// Whole files in and out: the one place that asks the file system for a file's bytes. Start-up and host tools only.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace lakshya {

// The content of a regular file of 1..max_bytes bytes. Throws InputError when the file is missing, a directory or
// another special file, unreadable, empty or larger than max_bytes (nothing is allocated then).
std::vector<std::uint8_t> read_file(const std::string& path, std::size_t max_bytes);

// The same as text, byte for byte: no encoding or line-end conversion.
std::string read_text(const std::string& path, std::size_t max_bytes);

// Writes path + ".part" in the same folder and renames it to `path`, so that a reader sees the old file or the
// whole new one. On failure the part is removed, an old file stays as it was, and InputError is thrown. There is no
// sync: a power cut may still lose the new file. One writer per path at a time.
void write_file_atomically(const std::string& path, std::string_view bytes);

}  // namespace lakshya
