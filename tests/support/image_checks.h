// Shared by the image tests: what an image holds, how a refusal reads, and what damage does to a file.
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <functional>
#include <random>
#include <string>
#include <vector>

#include "app/core/image_file.h"
#include "app/core/input_error.h"
#include "tests/support/temp_folder.h"

namespace lakshya {

using FileBytes = std::vector<std::uint8_t>;

template <class T>
std::vector<int> pixels(const Image<T>& image) {
  const auto area = static_cast<std::ptrdiff_t>(image.width()) * image.height();
  return {image.view().data, image.view().data + area};
}

// The reason of the refusal, without the path; empty when the file is accepted.
inline std::string refusal(const std::string& path, const std::function<void(const std::string&)>& reader) {
  try {
    reader(path);
    return "";
  } catch (const InputError& e) {
    const std::string message = e.what();
    EXPECT_EQ(message.find(path + ": "), 0U) << message;
    return message.substr(path.size() + 2);
  }
}

inline std::string gray_refusal(const std::string& path) {
  return refusal(path, read_gray);
}
inline std::string gray16_refusal(const std::string& path) {
  return refusal(path, read_gray16);
}

#define EXPECT_CONTAINS(text, part) EXPECT_PRED_FORMAT2(testing::IsSubstring, part, text)

inline void expect_every_cut_refused(const FileBytes& bytes,
                                     const std::function<std::string(const std::string&)>& check) {
  const TempFolder folder;
  for (std::size_t length = 0; length < bytes.size(); ++length) {
    const std::string path =
        folder.write("cut", FileBytes(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(length)));
    EXPECT_NE(check(path), "") << "cut to " << length << " of " << bytes.size() << " bytes";
  }
}

// Damages one to four bytes, `rounds` times from a fixed seed; `repair` may mend checksums, so that the damage gets
// past them. The reader must return or throw InputError; the count of files that were accepted is returned.
inline int accepted_after_damage(const FileBytes& bytes, int rounds, void (*repair)(FileBytes&) = nullptr) {
  const TempFolder folder;
  std::mt19937 random(7);  // the same damage every time
  int accepted = 0;
  for (int round = 0; round < rounds; ++round) {
    FileBytes damaged = bytes;
    for (auto flips = 1 + random() % 4; flips > 0; --flips) {
      damaged[random() % damaged.size()] ^= static_cast<std::uint8_t>(1 + random() % 255);
    }
    if (repair != nullptr) repair(damaged);
    const std::string path = folder.write("damaged", damaged);
    if (gray_refusal(path).empty()) ++accepted;
    gray16_refusal(path);
  }
  return accepted;
}

}  // namespace lakshya
