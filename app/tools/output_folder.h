// A folder of results that appears complete or not at all.
#pragma once

#include <string>

namespace lakshya {

// Files are written to path(), a temporary folder beside the wanted one; commit() moves them into place. Without a
// commit everything is removed again. Other files that an existing folder holds are left alone.
class OutputFolder {
 public:
  // Throws InputError when `wanted` exists and is no folder, or its parent cannot be written.
  explicit OutputFolder(const std::string& wanted);
  ~OutputFolder();
  OutputFolder(const OutputFolder&) = delete;
  OutputFolder& operator=(const OutputFolder&) = delete;

  std::string file(const std::string& name) const { return temporary_ + "/" + name; }
  // Moves the files; also removes `stale` from an existing folder unless it was written this time.
  void commit(const std::string& stale);

 private:
  std::string wanted_;
  std::string temporary_;
};

}  // namespace lakshya
