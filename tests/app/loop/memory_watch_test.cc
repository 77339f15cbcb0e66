#include "app/loop/memory_watch.h"

#include <gtest/gtest.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cstdlib>
#include <memory>
#include <thread>

namespace lakshya {
namespace {

// The compiler leaves out what nobody can see.
void allocate_and_free(std::size_t bytes = 100) {
  void* volatile memory = std::malloc(bytes);
  std::free(memory);
}

// Memory that nobody has touched yet, one page fault for each page.
class FreshPages {
 public:
  explicit FreshPages(std::size_t pages)
      : bytes_(pages * page()),
        memory_(static_cast<volatile char*>(
            ::mmap(nullptr, bytes_, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0))) {
    (void)::madvise(const_cast<char*>(memory_), bytes_, MADV_NOHUGEPAGE);
  }
  ~FreshPages() { (void)::munmap(const_cast<char*>(memory_), bytes_); }
  FreshPages(const FreshPages&) = delete;
  FreshPages& operator=(const FreshPages&) = delete;

  void touch() {
    for (std::size_t i = 0; i < bytes_; i += page())
      memory_[i] = 1;
  }

 private:
  static std::size_t page() { return static_cast<std::size_t>(::sysconf(_SC_PAGESIZE)); }
  std::size_t bytes_;
  volatile char* memory_;
};

// The first test: what is armed stays armed.
TEST(MemoryWatch, NothingIsCountedBeforeItIsArmed) {
  ASSERT_FALSE(memory_watch_armed());
  {
    const MemoryWatch watch(WatchedPlace::loop);
    allocate_and_free();
    FreshPages(50).touch();
  }
  EXPECT_EQ(allocations_at(WatchedPlace::loop), 0U);
  EXPECT_EQ(page_faults_at(WatchedPlace::loop), 0U);
  arm_memory_watch();
  EXPECT_TRUE(memory_watch_armed());
}

class Armed : public testing::Test {
 protected:
  void SetUp() override {
    allocate_and_free();
    if (!allocations_are_counted()) GTEST_SKIP() << "a sanitizer has its own malloc, and memory beside ours";
    arm_memory_watch();
  }
};

using Allocations = Armed;
using PageFaults = Armed;

TEST_F(Allocations, TakingAndGivingBackCountInTheWatchedScopeOnly) {
  allocate_and_free();
  EXPECT_EQ(allocations_at(WatchedPlace::loop), 0U);
  {
    const MemoryWatch watch(WatchedPlace::loop);
    allocate_and_free();
  }
  EXPECT_EQ(allocations_at(WatchedPlace::loop), 2U);
  EXPECT_EQ(allocations_at(WatchedPlace::decoding), 0U);
  allocate_and_free();
  EXPECT_EQ(allocations_at(WatchedPlace::loop), 2U);
}

TEST_F(Allocations, EveryWayToTakeMemoryCounts) {
  std::uint64_t counted = 0;
  const auto counts = [&](const char* what, std::uint64_t calls) {
    EXPECT_EQ(allocations_at(WatchedPlace::loop) - counted, calls) << what;
    counted = allocations_at(WatchedPlace::loop);
  };
  const MemoryWatch watch(WatchedPlace::loop);
  void* volatile memory = std::calloc(3, 5);
  counts("calloc", 1);
  memory = std::realloc(memory, 5000);
  counts("realloc", 1);
  std::free(memory);
  counts("free", 1);
  std::free(nullptr);
  counts("free of nothing", 0);
  memory = std::aligned_alloc(64, 640);
  counts("aligned_alloc", 1);
  EXPECT_EQ(reinterpret_cast<std::uintptr_t>(memory) % 64, 0U);
  std::free(memory);
  counts("free of aligned", 1);
  void* taken = nullptr;
  EXPECT_EQ(::posix_memalign(&taken, 4096, 100), 0);
  counts("posix_memalign", 1);
  EXPECT_EQ(reinterpret_cast<std::uintptr_t>(taken) % 4096, 0U);
  std::free(taken);
  counts("free of posix", 1);
  {
    const std::unique_ptr<volatile int> owned(new volatile int(3));
    counts("new", 1);
  }
  counts("delete", 1);
  struct alignas(128) Wide {
    int value;
  };
  auto* volatile wide = new Wide{3};
  counts("aligned new", 1);
  delete wide;
  counts("aligned delete", 1);
}

TEST_F(Allocations, AnInnerScopeCountsForItsOwnPlace) {
  {
    const MemoryWatch loop(WatchedPlace::loop);
    {
      const MemoryWatch decoding(WatchedPlace::decoding);
      allocate_and_free();
      const MemoryWatch nowhere(WatchedPlace::nowhere);
      allocate_and_free();
      allocate_and_free();
    }
    allocate_and_free();
    allocate_and_free();
  }
  EXPECT_EQ(allocations_at(WatchedPlace::decoding), 2U);
  EXPECT_EQ(allocations_at(WatchedPlace::loop), 4U);
  EXPECT_EQ(allocations_at(WatchedPlace::nowhere), 0U);
}

TEST_F(Allocations, EachThreadIsWatchedByItself) {
  std::thread other;
  {
    other = std::thread([] { allocate_and_free(); });
    other.join();
    const MemoryWatch watch(WatchedPlace::loop);
  }
  EXPECT_EQ(allocations_at(WatchedPlace::loop), 0U);
  other = std::thread([] {
    watch_this_thread(WatchedPlace::decoding);
    allocate_and_free();
    watch_this_thread(WatchedPlace::nowhere);  // what follows is the end of the thread
  });
  other.join();
  EXPECT_EQ(allocations_at(WatchedPlace::decoding), 2U);
}

TEST_F(Allocations, ArmingBeginsWithZero) {
  const MemoryWatch watch(WatchedPlace::loop);
  allocate_and_free();
  EXPECT_GT(allocations_at(WatchedPlace::loop), 0U);
  arm_memory_watch();
  EXPECT_EQ(allocations_at(WatchedPlace::loop), 0U);
}

TEST_F(PageFaults, CountInTheWatchedScopeOnly) {
  FreshPages before(100);
  before.touch();
  FreshPages inside(100);
  FreshPages after(100);
  {
    const MemoryWatch watch(WatchedPlace::loop);
    before.touch();  // again: they are there
    inside.touch();
  }
  after.touch();
  EXPECT_GE(page_faults_at(WatchedPlace::loop), 100U);
  EXPECT_LT(page_faults_at(WatchedPlace::loop), 150U);
  EXPECT_EQ(page_faults_at(WatchedPlace::decoding), 0U);
}

TEST_F(PageFaults, OfAnInnerScopeAreNotTheOuterOnes) {
  FreshPages loop(100);
  FreshPages decoding(200);
  FreshPages nowhere(400);
  FreshPages rest(100);
  {
    const MemoryWatch outer(WatchedPlace::loop);
    loop.touch();
    {
      const MemoryWatch inner(WatchedPlace::decoding);
      decoding.touch();
      const MemoryWatch innermost(WatchedPlace::nowhere);
      nowhere.touch();
    }
    rest.touch();
  }
  EXPECT_GE(page_faults_at(WatchedPlace::loop), 200U);
  EXPECT_LT(page_faults_at(WatchedPlace::loop), 250U);
  EXPECT_GE(page_faults_at(WatchedPlace::decoding), 200U);
  EXPECT_LT(page_faults_at(WatchedPlace::decoding), 250U);
  EXPECT_EQ(page_faults_at(WatchedPlace::nowhere), 0U);
}

}  // namespace
}  // namespace lakshya
