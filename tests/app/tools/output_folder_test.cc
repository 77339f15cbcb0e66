#include "app/tools/output_folder.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <set>
#include <string>
#include <vector>

#include "app/core/input_error.h"
#include "tests/support/run_command.h"
#include "tests/support/temp_folder.h"

namespace lakshya {
namespace {

namespace fs = std::filesystem;
using Names = std::set<std::string>;

Names names_in(const std::string& folder) {
  Names names;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder))
    names.insert(entry.path().filename().string());
  return names;
}

void put(const std::string& path, const std::string& text) {
  std::ofstream(path, std::ios::binary) << text;
}

class OutputFolderTest : public ::testing::Test {
 protected:
  // The message of the refusal, or "accepted".
  static std::string refusal(const std::string& wanted) {
    try {
      const OutputFolder folder(wanted);
      return "accepted";
    } catch (const InputError& e) {
      return e.what();
    }
  }

  TempFolder parent_;
  std::string out_ = parent_.path("out");
};

TEST_F(OutputFolderTest, NothingIsVisibleBeforeCommit) {
  OutputFolder folder(out_);
  put(folder.file("map.json"), "new");
  EXPECT_FALSE(fs::exists(out_));
  folder.commit("points.ply");
  EXPECT_EQ(names_in(out_), Names{"map.json"});
  EXPECT_EQ(bytes_of(out_ + "/map.json"), "new");
  EXPECT_EQ(names_in(parent_.path("")), Names{"out"});
}

TEST_F(OutputFolderTest, WithoutCommitNothingRemains) {
  {
    const OutputFolder folder(out_);
    put(folder.file("map.json"), "new");
  }
  EXPECT_EQ(names_in(parent_.path("")), Names{});
}

TEST_F(OutputFolderTest, NewFolderIsReadableByOthers) {
  OutputFolder(out_).commit("points.ply");
  EXPECT_EQ(fs::status(out_).permissions(), fs::perms(0755));
}

TEST_F(OutputFolderTest, MakesParentsAndIgnoresTrailingSlashes) {
  OutputFolder folder(parent_.path("a/b/out//"));
  put(folder.file("map.json"), "new");
  folder.commit("points.ply");
  EXPECT_EQ(names_in(parent_.path("a/b")), Names{"out"});
  EXPECT_EQ(names_in(parent_.path("a/b/out")), Names{"map.json"});
}

TEST_F(OutputFolderTest, ExistingFolderKeepsOtherFiles) {
  fs::create_directories(out_ + "/notes");
  put(out_ + "/map.json", "old");
  put(out_ + "/mine.txt", "mine");
  OutputFolder folder(out_);
  put(folder.file("map.json"), "new");
  put(folder.file("map.png"), "picture");
  EXPECT_EQ(bytes_of(out_ + "/map.json"), "old");
  EXPECT_FALSE(fs::exists(out_ + "/map.png"));

  folder.commit("points.ply");
  EXPECT_EQ(names_in(out_), (Names{"map.json", "map.png", "mine.txt", "notes"}));
  EXPECT_EQ(bytes_of(out_ + "/map.json"), "new");
  EXPECT_EQ(bytes_of(out_ + "/mine.txt"), "mine");
}

TEST_F(OutputFolderTest, NoTemporaryRemainsBesideAnExistingFolder) {
  fs::create_directory(out_);
  {
    OutputFolder folder(out_);
    put(folder.file("map.json"), "new");
    folder.commit("points.ply");
  }
  EXPECT_EQ(names_in(parent_.path("")), Names{"out"});
}

TEST_F(OutputFolderTest, StaleFileGoesUnlessItIsWrittenAgain) {
  fs::create_directory(out_);
  put(out_ + "/points.ply", "old");
  OutputFolder again(out_);
  put(again.file("points.ply"), "new");
  again.commit("points.ply");
  EXPECT_EQ(bytes_of(out_ + "/points.ply"), "new");

  OutputFolder without(out_);
  put(without.file("map.json"), "new");
  without.commit("points.ply");
  EXPECT_EQ(names_in(out_), Names{"map.json"});
}

TEST_F(OutputFolderTest, WithoutCommitAnExistingFolderStaysAsItWas) {
  fs::create_directory(out_);
  put(out_ + "/points.ply", "old");
  put(out_ + "/map.json", "old");
  {
    const OutputFolder folder(out_);
    put(folder.file("map.json"), "new");
  }
  EXPECT_EQ(names_in(parent_.path("")), Names{"out"});
  EXPECT_EQ(names_in(out_), (Names{"map.json", "points.ply"}));
  EXPECT_EQ(bytes_of(out_ + "/map.json"), "old");
}

TEST_F(OutputFolderTest, TwoAtOnceDoNotMeet) {
  OutputFolder one(out_);
  OutputFolder two(out_);
  put(one.file("map.json"), "one");
  put(two.file("map.json"), "two");
  one.commit("points.ply");
  EXPECT_EQ(bytes_of(out_ + "/map.json"), "one");
  two.commit("points.ply");
  EXPECT_EQ(bytes_of(out_ + "/map.json"), "two");
}

TEST_F(OutputFolderTest, RefusesWhereAFileIsInTheWay) {
  put(out_, "a file");
  const std::string message = refusal(out_);
  EXPECT_TRUE(message.starts_with(out_ + ": cannot write results here: it exists and is not a folder")) << message;
  EXPECT_TRUE(refusal(out_ + "/").starts_with(out_ + ": "));
  EXPECT_EQ(bytes_of(out_), "a file");
  EXPECT_EQ(names_in(parent_.path("")), Names{"out"});
}

TEST_F(OutputFolderTest, RefusesAParentThatCannotBeMade) {
  put(out_, "a file");
  for (const std::string& wanted : {out_ + "/inside", out_ + "/deep/inside"}) {
    const std::string message = refusal(wanted);
    EXPECT_TRUE(message.starts_with(wanted + ": cannot write results here: ")) << message;
    EXPECT_TRUE(message.ends_with("(choose another --out)")) << message;
  }
  EXPECT_EQ(bytes_of(out_), "a file");
  EXPECT_EQ(names_in(parent_.path("")), Names{"out"});
}

TEST_F(OutputFolderTest, RefusesAFolderInPlaceOfAResult) {
  fs::create_directories(out_ + "/map.json");
  OutputFolder folder(out_);
  put(folder.file("map.json"), "new");
  EXPECT_THROW(folder.commit("points.ply"), InputError);
  EXPECT_TRUE(fs::is_directory(out_ + "/map.json"));
}

TEST_F(OutputFolderTest, RefusesAnEmptyName) {
  EXPECT_TRUE(refusal("").starts_with("--out: cannot write results here: the name is empty"));
}

}  // namespace
}  // namespace lakshya
