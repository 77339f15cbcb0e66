#include "app/loop/stepped_clock.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/eventfd.h>
#include <unistd.h>

#include <chrono>

namespace lakshya {
namespace {

class EventFile {
 public:
  ~EventFile() { ::close(fd_); }
  int fd() const { return fd_; }
  void ring() const {
    const std::uint64_t one = 1;
    ASSERT_EQ(::write(fd_, &one, sizeof one), ssize_t{sizeof one});
  }

 private:
  int fd_ = ::eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC);
};

TEST(SteppedClock, TimePassesOnlyWhenSomebodyWaits) {
  SteppedClock clock;
  const Nanoseconds start = clock.now();
  EXPECT_GT(start, 0);
  EXPECT_EQ(clock.now(), start);
  clock.sleep_until(start + 7);
  EXPECT_EQ(clock.now(), start + 7);
  clock.sleep_until(start + 3);  // never back
  EXPECT_EQ(clock.now(), start + 7);
}

TEST(SteppedClock, AnHourIsOverAtOnce) {
  SteppedClock clock;
  const auto begin = std::chrono::steady_clock::now();
  clock.sleep_until(clock.now() + 3600 * kSecond);
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(10));
}

TEST(SteppedClock, AFileThatIsReadyTakesNoTime) {
  SteppedClock clock;
  const Nanoseconds start = clock.now();
  const EventFile file;
  file.ring();
  EXPECT_EQ(clock.wait_for(file.fd(), Ready::to_read, start + kSecond), Status::ok);
  EXPECT_EQ(clock.wait_for(file.fd(), Ready::to_write, start + kSecond), Status::ok);
  EXPECT_EQ(clock.now(), start);
}

TEST(SteppedClock, AFileThatHasNothingIsWaitedForUntilTheDeadline) {
  SteppedClock clock;
  const Nanoseconds start = clock.now();
  const EventFile file;
  EXPECT_EQ(clock.wait_for(file.fd(), Ready::to_read, start + 5), Status::timeout);
  EXPECT_EQ(clock.now(), start + 5);
  EXPECT_EQ(clock.wait_for(file.fd(), Ready::to_read, start), Status::timeout);  // it has passed
  EXPECT_EQ(clock.now(), start + 5);
}

TEST(SteppedClock, TheOtherEndThatHasGoneIsSomethingToTell) {
  SteppedClock clock;
  const Nanoseconds start = clock.now();
  int ends[2];
  ASSERT_EQ(::pipe2(ends, O_CLOEXEC), 0);
  ::close(ends[1]);
  EXPECT_EQ(clock.wait_for(ends[0], Ready::to_read, start + kSecond), Status::ok);
  ::close(ends[0]);
  EXPECT_EQ(clock.now(), start);
}

TEST(SteppedClock, AFileThatIsNotOpenIsRefused) {
  SteppedClock clock;
  const Nanoseconds start = clock.now();
  int closed = 0;
  {
    const EventFile file;
    closed = file.fd();
  }
  EXPECT_EQ(clock.wait_for(closed, Ready::to_read, start + kSecond), Status::bad_argument);
  EXPECT_EQ(clock.wait_for(-1, Ready::to_read, start + kSecond), Status::bad_argument);
  EXPECT_EQ(clock.now(), start);
}

}  // namespace
}  // namespace lakshya
