// The arrows between the folders, checked on made-up mistakes and then on the repository.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "tests/layering_rules.h"

namespace lakshya {
namespace {

namespace fs = std::filesystem;

// ---- made-up mistakes

TEST(LayeringRules, ArrowsThatTheTableAllows) {
  const std::string standard = "#include <cstdint>\n#include <array>\n";
  EXPECT_EQ(check_source("kernels/a/a.h", standard + "#include \"kernels/base/status.h\"\n"), Findings{});
  EXPECT_EQ(check_source("kernels/a/a_simd.cc", "#include \"hwy/highway.h\"\n#include <hwy/base.h>\n"), Findings{});
  EXPECT_EQ(check_source("kernels/a/b_simd-inl.h", "#include \"hwy/highway.h\"\n"), Findings{});
  EXPECT_EQ(check_source("kernels/a/a_simd.cc", "#include \"kernels/a/b_simd-inl.h\"\n"), Findings{});
  EXPECT_EQ(check_source("hal/c/c.cc", "#include \"kernels/base/units.h\"\n#include <termios.h>\n"), Findings{});
  EXPECT_EQ(check_source("app/nav/n.cc", "#include \"kernels/prune/prune.h\"\n"), Findings{});
  EXPECT_EQ(
      check_source("app/core/p.cc", "#include \"app/nav/n.h\"\n#include \"hal/c.h\"\n#include <Eigen/Core>\n"),
      Findings{});
  EXPECT_EQ(check_source("app/tools/m.cc", "#include <opencv2/core.hpp>\n#include \"app/core/p.h\"\n"), Findings{});
}

TEST(LayeringRules, WrongArrows) {
  const std::map<std::string, std::vector<std::string>> cases = {
      {"kernels/a/a.h", {"\"hal/c.h\"", "\"hwy/highway.h\"", "<hwy/base.h>", "<opencv2/core.hpp>", "<Eigen/Core>"}},
      {"kernels/a/a.cc",
       {"\"kernels/a/b_simd-inl.h\"", "\"app/core/image.h\"", "\"a.h\"", "\"kernels/../hal/c.h\"",
        "<kernels/../hal/c.h>"}},
      {"kernels/a/a_simd.cc", {"<immintrin.h>", "\"hal/c.h\""}},
      {"kernels/a/a-inl.h", {"\"hwy/highway.h\""}},
      {"hal/c.cc", {"\"kernels/census/census.h\"", "\"app/core/image.h\"", "<yaml-cpp/yaml.h>"}},
      {"app/nav/n.cc", {"\"app/core/image.h\"", "\"hal/clock.h\"", "<yaml-cpp/yaml.h>", "<opencv2/core.hpp>"}},
      {"app/core/p.cc", {"\"app/tools/sheet.h\"", "<opencv2/core.hpp>", "\"opencv2/core.hpp\""}},
      {"app/loop/l.cc",
       {"\"app/tools/sheet.h\"", "\"app/lakshyad/options.h\"", "<opencv2/core.hpp>", "<CLI/CLI.hpp>"}},
      {"app/lakshyad/m.cc", {"\"app/tools/sheet.h\"", "<opencv2/core.hpp>"}},
      {"app/tools/m.cc", {"\"tests/fake.h\"", "<hwy/highway.h>"}},
      {"app/extra/e.cc", {"<cstdint>"}},
  };
  for (const auto& [path, includes] : cases) {
    for (const std::string& include : includes) {
      const std::string text = std::string("// a comment\n  #  include ").append(include).append("\n");
      EXPECT_EQ(check_source(path, text).size(), 1U) << path << " including " << include;
    }
  }
}

TEST(LayeringRules, CommentsAndStringsIncludeNothing) {
  EXPECT_EQ(check_source("hal/c.cc", "// #include \"app/core/p.h\"\n/* \n#include <opencv2/core.hpp>\n*/\n"),
            Findings{});
  EXPECT_EQ(check_source("hal/c.cc", "auto s = R\"x(\n#include \"app/core/p.h\"\n)x\";\n"), Findings{});
  EXPECT_EQ(check_source("hal/c.cc", "auto s = \"http://\";\n#include \"app/core/p.h\"\n").size(), 1U);
  EXPECT_EQ(check_source("hal/c.cc", "auto s = \"/*\";\n#include \"app/core/p.h\"\nauto e = \"*/\";\n").size(), 1U);
}

TEST(LayeringRules, WhatKernelsMayNotDo) {
  for (const char* statement : {"auto* p = new int;", "malloc(4);", "throw 1;", "std::printf(\"x\");",
                                "std::vector<int> v;", "std::string s;", "std::cout << 1;", "abort();",
                                "#include <iostream>", "#include <vector>\nstd::vector<int> v;"}) {
    EXPECT_EQ(check_source("kernels/a/a.cc", statement).size(), 1U) << statement;
    EXPECT_EQ(check_source("app/nav/n.cc", statement), Findings{}) << statement;
  }
  EXPECT_EQ(check_source("kernels/a/a.cc", "std::string_view s; int new_row = 1'000; // new, throw\n"), Findings{});
  EXPECT_EQ(check_source("kernels/a/a.cc", "char q = '\"'; const char* s = \"new \\\" throw\"; int vector = 0;"),
            Findings{});
}

TEST(LayeringRules, BoardsAndLinks) {
  for (const char* name : {"boards/x/main.cc", "boards/x/x.h", "boards/x/x.cmake", "boards/x/CMakeLists.txt"}) {
    EXPECT_EQ(check_board_file(name).size(), 1U) << name;
  }
  EXPECT_EQ(check_board_file("boards/host/vehicle.yaml"), Findings{});
  EXPECT_TRUE(cmake_names_opencv("target_link_libraries(a PRIVATE ${OpenCV_LIBS}) # why\n"));
  EXPECT_FALSE(cmake_names_opencv("# No OpenCV.\nlakshya_library(a)\n"));
  EXPECT_TRUE(names_opencv(" 0x01 (NEEDED)  Shared library: [libopencv_core.so.406]"));
}

// ---- the repository

class Layering : public testing::Test {
 protected:
  void SetUp() override {
    const char* root = std::getenv("LAKSHYA_ROOT");
    if (root == nullptr) GTEST_SKIP() << "LAKSHYA_ROOT is not set: no source tree to read";
    root_ = root;
  }

  // Paths relative to the root, sorted.
  std::vector<fs::path> files_below(const char* folder) const {
    std::vector<fs::path> files;
    if (!fs::exists(root_ / folder)) return files;
    for (const auto& entry : fs::recursive_directory_iterator(root_ / folder)) {
      if (entry.is_regular_file()) files.push_back(fs::relative(entry.path(), root_));
    }
    std::sort(files.begin(), files.end());
    return files;
  }

  std::string read(const fs::path& path) const {
    std::ifstream file(root_ / path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }

  fs::path root_;
};

TEST_F(Layering, EverySourceFile) {
  std::size_t sources = 0;
  for (const char* folder : {"kernels", "hal", "app"}) {
    for (const fs::path& path : files_below(folder)) {
      if (path.extension() != ".cc" && path.extension() != ".h") continue;
      ++sources;
      for (const std::string& finding : check_source(path.string(), read(path)))
        ADD_FAILURE() << finding;
    }
  }
  EXPECT_GT(sources, 10U) << "this is not the source tree";
}

TEST_F(Layering, BoardsAreData) {
  for (const fs::path& path : files_below("boards"))
    EXPECT_EQ(check_board_file(path), Findings{});
}

TEST_F(Layering, FirmwareLinksNoOpenCv) {
  for (const char* folder : {"kernels", "hal", "app/nav", "app/core", "app/loop", "app/lakshyad"}) {
    for (const fs::path& path : files_below(folder)) {
      if (path.filename() != "CMakeLists.txt" && path.extension() != ".cmake") continue;
      EXPECT_FALSE(cmake_names_opencv(read(path))) << path;
    }
  }
}

std::string output_of(const std::string& command) {
  const std::unique_ptr<FILE, int (*)(FILE*)> pipe(popen(command.c_str(), "r"), pclose);
  std::string output;
  std::array<char, 4096> buffer{};
  while (pipe && std::fgets(buffer.data(), buffer.size(), pipe.get()) != nullptr)
    output += buffer.data();
  return output;
}

TEST_F(Layering, TheFirmwareLoadsNoOpenCv) {
  const char* firmware = std::getenv("LAKSHYAD_BIN");
  if (firmware == nullptr) GTEST_SKIP() << "LAKSHYAD_BIN is not set: no build to look at";
  const std::string section = output_of("readelf -d '" + std::string(firmware) + "' 2>/dev/null");
  if (section.find("NEEDED") == std::string::npos) GTEST_SKIP() << "it is not built, or readelf is not installed";
  EXPECT_FALSE(names_opencv(section));
}

// What the linker really wrote. The rectification test compares with OpenCV and is the one exception.
TEST_F(Layering, CoreTestsLoadNoOpenCv) {
  const char* command = std::getenv("LAKSHYA_BIN");
  if (command == nullptr) GTEST_SKIP() << "LAKSHYA_BIN is not set: no build to look at";
  const fs::path tests = (fs::path(command).parent_path() / "../../tests").lexically_normal();
  if (!fs::exists(tests)) GTEST_SKIP() << "no build to look at";
  std::size_t looked_at = 0;
  for (const auto& entry : fs::directory_iterator(tests)) {
    const std::string name = entry.path().filename().string();
    if (!entry.is_regular_file() || !name.starts_with("app_core_") || !name.ends_with("_test")) continue;
    if (name == "app_core_rectification_test") continue;
    const std::string section = output_of("readelf -d '" + entry.path().string() + "' 2>/dev/null");
    if (section.find("NEEDED") == std::string::npos) continue;
    ++looked_at;
    EXPECT_FALSE(names_opencv(section)) << name;
  }
  if (looked_at == 0) GTEST_SKIP() << "no core test is built, or readelf is not installed";
}

}  // namespace
}  // namespace lakshya
