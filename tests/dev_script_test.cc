// The entry script in a made-up checkout, with stand-ins for the commands that would change the machine.
#include <gtest/gtest.h>
#include <stdlib.h>  // mkdtemp
#include <sys/wait.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

namespace {

namespace fs = std::filesystem;

struct Result {
  int status = -1;
  std::string output;  // stdout and stderr together
};

class DevScript : public testing::Test {
 protected:
  void SetUp() override {
    const char* root = std::getenv("LAKSHYA_ROOT");
    if (root == nullptr) GTEST_SKIP() << "LAKSHYA_ROOT is not set: no script to run";
    std::string name = (fs::temp_directory_path() / "lakshya-dev-XXXXXX").string();
    ASSERT_NE(mkdtemp(name.data()), nullptr);
    folder_ = name;
    fs::create_directories(folder_ / "stand-ins");
    fs::copy_file(fs::path(root) / "dev", folder_ / "dev");
    stand_in("apt-get", "echo \"$@\" >>'" + calls() + "'");
    stand_in("id", "echo 0");
    stand_in("dpkg-query", "for a; do case $a in -* | *{*) ;; *) echo \"installed $a\" ;; esac; done");
  }

  void TearDown() override {
    if (!folder_.empty()) fs::remove_all(folder_);
  }

  void stand_in(const std::string& name, const std::string& body) const {
    const fs::path file = folder_ / "stand-ins" / name;
    std::ofstream(file) << "#!/bin/sh\n" << body << "\n";
    fs::permissions(file, fs::perms::owner_all);
  }

  void add_file(const std::string& path) const {
    fs::create_directories((folder_ / path).parent_path());
    std::ofstream(folder_ / path) << "x";
  }

  void add_program(const std::string& path, const std::string& body) const {
    const fs::path file = folder_ / path;
    fs::create_directories(file.parent_path());
    std::ofstream(file) << "#!/bin/sh\n" << body << "\n";
    fs::permissions(file, fs::perms::owner_all);
  }

  void add_target(const std::string& reader, const std::string& body) const {
    add_program("build/fuzz/tests/fuzz/fuzz_" + reader, body);
  }

  // From another folder than the checkout.
  Result dev(const std::string& arguments, const std::string& variable = "LAKSHYA_NO_DEPS=0") const {
    const std::string command = "cd / && env " + variable + " PATH='" + (folder_ / "stand-ins").string() +
                                "':\"$PATH\" '" + (folder_ / "dev").string() + "' " + arguments +
                                " 2>&1 </dev/null";
    Result result;
    FILE* pipe = popen(command.c_str(), "r");
    if (pipe == nullptr) return result;
    std::array<char, 4096> buffer{};
    while (std::fgets(buffer.data(), buffer.size(), pipe) != nullptr)
      result.output += buffer.data();
    result.status = WEXITSTATUS(pclose(pipe));
    return result;
  }

  std::string calls() const { return (folder_ / "calls").string(); }

  std::string apt_calls() const {
    std::ifstream file(calls());
    return {std::istreambuf_iterator<char>(file), {}};
  }

  static bool contains(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
  }

  static bool is_debian_12() { return std::system("grep -qs 'VERSION=\"12 (bookworm)\"' /etc/os-release") == 0; }

  fs::path folder_;
};

TEST_F(DevScript, HelpNamesEveryCommand) {
  const Result help = dev("help");
  EXPECT_EQ(help.status, 0);
  for (const char* command : {"demo", "pair", "test", "test-arm", "build", "paper", "accuracy", "compare", "bench",
                              "fuzz", "data", "format", "tidy", "deps"}) {
    EXPECT_TRUE(contains(help.output, std::string("\n  ") + command)) << command;
  }
  EXPECT_EQ(dev("").output, help.output);
}

TEST_F(DevScript, RefusesWhatItDoesNotKnow) {
  add_file("tests/kernels/census_test.cc");
  add_file("tests/layering_test.cc");
  EXPECT_EQ(dev("demonstrate").status, 2);
  EXPECT_EQ(dev("test --fast").status, 2);
  EXPECT_EQ(dev("test --preset").status, 2);
  EXPECT_EQ(dev("test census layering").status, 2);
  EXPECT_EQ(dev("format --quietly").status, 2);
  for (const char* module : {"nothing", "cen", "kernels.cens", "kernels_census"}) {
    const Result result = dev(std::string("test ") + module);
    EXPECT_EQ(result.status, 2) << module;
    EXPECT_TRUE(contains(result.output, "\nhouse.layering\nkernels.census\n")) << result.output;
  }
}

TEST_F(DevScript, BuildsAndRunsOnlyTheModule) {
  add_file("tests/app/core/census_test.cc");
  add_file("tests/kernels/census_test.cc");
  add_file("tests/kernels/sgm_test.cc");
  stand_in("cmake", "echo cmake \"$@\"");
  stand_in("ctest", "echo ctest \"$@\"");
  if (!is_debian_12()) GTEST_SKIP() << "only Debian 12 is set up by the script";
  const Result one = dev("test --preset asan kernels.census");
  EXPECT_EQ(one.status, 0);
  EXPECT_TRUE(contains(one.output, "cmake --preset asan\n")) << one.output;
  EXPECT_TRUE(contains(one.output, "cmake --build --preset asan --target kernels_census_test\n")) << one.output;
  EXPECT_TRUE(contains(one.output, "--tests-regex ^(kernels\\.census)$\n")) << one.output;
  const Result two = dev("test census");
  EXPECT_TRUE(contains(two.output, "--target app_core_census_test kernels_census_test\n")) << two.output;
  EXPECT_TRUE(contains(two.output, "--tests-regex ^(app\\.core\\.census|kernels\\.census)$\n")) << two.output;
}

TEST_F(DevScript, TestsKernelsOnArmWithEveryVectorLength) {
  add_file("tests/kernels/census_test.cc");
  add_file("tests/kernels/sgm_test.cc");
  add_file("tests/app/core/sgm_test.cc");
  add_file("tests/app/core/pipeline_test.cc");
  stand_in("cmake", "echo cmake \"$@\"");
  stand_in("ctest", "echo \"${QEMU_CPU:-} ${LAKSHYA_EXPECT_VECTOR_BITS:-} ctest $*\"");
  if (!is_debian_12()) GTEST_SKIP() << "only Debian 12 is set up by the script";
  const Result all = dev("test-arm");
  EXPECT_EQ(all.status, 0) << all.output;
  for (const char* line : {"cmake --build --preset arm-neon --target kernels_census_test kernels_sgm_test\n",
                           "cmake --build --preset arm-sve --target kernels_census_test kernels_sgm_test\n",
                           "\n  ctest --test-dir build/arm-neon ",
                           "\nmax,sve-default-vector-length=16 128 ctest --test-dir build/arm-sve ",
                           "\nmax,sve-default-vector-length=32 256 ctest --test-dir build/arm-sve ",
                           "\nmax,sve-default-vector-length=64 512 ctest --test-dir build/arm-sve "}) {
    EXPECT_TRUE(contains(all.output, line)) << line << "\n" << all.output;
  }
  const Result one = dev("test-arm sgm");
  EXPECT_EQ(one.status, 0) << one.output;
  EXPECT_TRUE(contains(one.output, "--target kernels_sgm_test\n")) << one.output;
  EXPECT_TRUE(contains(one.output, "--tests-regex ^(kernels\\.sgm)$\n")) << one.output;
  EXPECT_EQ(dev("test-arm pipeline").status, 2);
  EXPECT_EQ(dev("test-arm nothing").status, 2);
}

TEST_F(DevScript, BenchRunsEverythingBesideOpencvOrAModulesMicroBenchmarks) {
  if (!is_debian_12()) GTEST_SKIP() << "only Debian 12 is set up by the script";
  add_file("perf/kernels/census_bench.cc");
  add_program("build/host/app/tools/lakshya", "echo lakshya \"$@\"");
  add_program("build/host/perf/kernels_census_bench", "echo micro");
  stand_in("cmake", "echo cmake \"$@\"");
  const Result all = dev("bench --quick");
  EXPECT_EQ(all.status, 0);
  EXPECT_TRUE(contains(all.output, "--target lakshya\n")) << all.output;
  EXPECT_TRUE(contains(all.output, "lakshya bench --out out/bench --quick\n")) << all.output;
  EXPECT_FALSE(contains(all.output, "micro")) << all.output;
  const Result one = dev("bench census");
  EXPECT_EQ(one.status, 0);
  EXPECT_TRUE(contains(one.output, "--target kernels_census_bench\n")) << one.output;
  EXPECT_TRUE(contains(one.output, "\nmicro\n")) << one.output;
  EXPECT_EQ(dev("bench nothing").status, 2);
}

TEST_F(DevScript, FuzzesTheReadersAndNamesTheReproducer) {
  if (!is_debian_12()) GTEST_SKIP() << "only Debian 12 is set up by the script";
  for (const char* reader : {"png", "map_json"}) {
    add_file(std::string("tests/fuzz/") + reader + "_fuzz.cc");
    add_target(reader, "echo ran \"$@\"; echo 'Done 12 runs in 1 second(s)'");
  }
  stand_in("cmake", "echo cmake \"$@\"");
  const Result all = dev("fuzz 3");
  EXPECT_EQ(all.status, 0) << all.output;
  EXPECT_TRUE(contains(all.output, "cmake --build --preset fuzz --target fuzz_map_json fuzz_png\n")) << all.output;
  EXPECT_TRUE(contains(all.output, "png: 12 runs, nothing found\n")) << all.output;
  EXPECT_TRUE(contains(all.output, "map_json: 12 runs, nothing found\n")) << all.output;

  add_target("png", "echo ran \"$@\"; echo 'x; Test unit written to build/fuzz/found/png-crash-1'; exit 77");
  const Result one = dev("fuzz png 3");
  EXPECT_EQ(one.status, 1);
  EXPECT_TRUE(contains(one.output, "--target fuzz_png\n")) << one.output;
  EXPECT_TRUE(contains(one.output, "ran build/fuzz/corpus/png -max_total_time=3 ")) << one.output;
  EXPECT_TRUE(contains(one.output, "reproducer: build/fuzz/found/png-crash-1\n")) << one.output;
  EXPECT_TRUE(contains(dev("fuzz png map_json 3").output, "--target fuzz_png fuzz_map_json\n"));
  EXPECT_EQ(dev("fuzz 3").status, 1);

  const Result unknown = dev("fuzz bmp");
  EXPECT_EQ(unknown.status, 2);
  EXPECT_TRUE(contains(unknown.output, "\nmap_json\npng\n")) << unknown.output;
  EXPECT_EQ(dev("fuzz 0").status, 2);
  EXPECT_EQ(dev("fuzz png 3s").status, 2);
}

TEST_F(DevScript, AccuracyNeedsItsData) {
  EXPECT_EQ(dev("accuracy", "LAKSHYA_DATA=").status, 1);
}

TEST_F(DevScript, ComparesTheDemoPairAndTheDataAndFailsWhenOneDiffers) {
  if (!is_debian_12()) GTEST_SKIP() << "only Debian 12 is set up by the script";
  const fs::path lakshya = folder_ / "build/host/app/tools/lakshya";
  fs::create_directories(lakshya.parent_path());
  std::ofstream(lakshya)
      << "#!/bin/sh\necho lakshya \"$@\"\nif [ \"$3\" = perf/compare_demo.json ]; then exit 1; fi\n";
  fs::permissions(lakshya, fs::perms::owner_all);
  stand_in("cmake", "echo cmake \"$@\"");
  for (const char* file :
       {"aloeL.jpg", "aloeR.jpg", "aloeGT.png", "intrinsics.yml", "left_intrinsics.yml", "stereo_calib.xml"})
    add_file(std::string("data/opencv-doc/") + file);
  for (int view = 1; view <= 14; ++view) {
    const std::string number = (view < 10 ? "0" : "") + std::to_string(view) + ".jpg";
    add_file("data/opencv-doc/left" + number);
    add_file("data/opencv-doc/right" + number);
  }
  const Result all = dev("compare --isa avx2", "LAKSHYA_DATA=/some/data");
  EXPECT_EQ(all.status, 1);
  EXPECT_TRUE(contains(all.output,
                       "--pairs perf/compare_demo.json --data . --config boards/demo/vehicle.yaml --isa "
                       "avx2\n"))
      << all.output;
  EXPECT_TRUE(contains(all.output,
                       "--pairs perf/accuracy_pairs.json --pairs perf/compare_pairs.json --data /some/data "
                       "--isa avx2\n"))
      << all.output;
  EXPECT_TRUE(contains(dev("compare", "LAKSHYA_DATA=").output, "only the demo pair was compared\n"));
}

TEST_F(DevScript, ThePapersExperimentsAreToldWhereToDraw) {
  add_file("tests/paper/floor_test.cc");
  add_file("tests/kernels/sgm_test.cc");
  add_file("out/paper/of_an_earlier_run.png");
  stand_in("cmake", "echo cmake \"$@\"");
  stand_in("ctest", "echo ctest \"$@\"; mkdir -p \"$LAKSHYA_PICTURES\"; : >\"$LAKSHYA_PICTURES/floor.png\"");
  if (!is_debian_12()) GTEST_SKIP() << "only Debian 12 is set up by the script";
  const Result result = dev("paper");
  EXPECT_EQ(result.status, 0);
  EXPECT_TRUE(contains(result.output, "--target paper_floor_test\n")) << result.output;
  EXPECT_TRUE(contains(result.output, "--tests-regex ^paper\\.\n")) << result.output;
  EXPECT_TRUE(contains(result.output, " out/paper/floor.png\n")) << result.output;
  EXPECT_FALSE(contains(result.output, "earlier")) << result.output;
}

TEST_F(DevScript, InstallsNothingWhenNothingIsMissing) {
  if (!is_debian_12()) GTEST_SKIP() << "only Debian 12 is set up by the script";
  EXPECT_EQ(dev("deps").status, 0);
  EXPECT_EQ(apt_calls(), "");
}

TEST_F(DevScript, InstallsWhatIsMissing) {
  if (!is_debian_12()) GTEST_SKIP() << "only Debian 12 is set up by the script";
  stand_in("dpkg-query", "for a; do [ \"$a\" = cmake ] || echo \"installed $a\"; done; echo 'config-files cmake'");
  EXPECT_EQ(dev("deps").status, 0);
  const std::string calls = apt_calls();
  EXPECT_TRUE(contains(calls, " update\n")) << calls;
  EXPECT_TRUE(contains(calls, " install -y --no-install-recommends cmake\n")) << calls;
}

TEST_F(DevScript, SaysWhatToRunWithoutTheRight) {
  if (!is_debian_12()) GTEST_SKIP() << "only Debian 12 is set up by the script";
  stand_in("dpkg-query", "exit 1");
  stand_in("id", "echo 1000");
  stand_in("sudo", "exit 1");
  const Result result = dev("deps");
  EXPECT_EQ(result.status, 1);
  EXPECT_TRUE(contains(result.output, "apt-get update && apt-get install -y --no-install-recommends g++ cmake "));
  EXPECT_EQ(apt_calls(), "");
}

TEST_F(DevScript, ChecksNothingWhenToldSo) {
  stand_in("dpkg-query", "exit 1");
  EXPECT_EQ(dev("deps", "LAKSHYA_NO_DEPS=1").status, 0);
  EXPECT_EQ(apt_calls(), "");
}

TEST_F(DevScript, FailedDownloadLeavesNothing) {
  if (fs::exists("/usr/share/doc/opencv-doc/examples/data")) GTEST_SKIP() << "opencv-doc is installed";
  stand_in("apt-get", "exit 100");
  EXPECT_EQ(dev("data").status, 1);
  EXPECT_TRUE(fs::is_empty(folder_ / "data"));
}

}  // namespace
