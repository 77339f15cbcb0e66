#include "app/loop/memory_watch.h"

#include <array>
#include <atomic>

#include "app/loop/real_time.h"

namespace lakshya {
namespace {

using Counts = std::array<std::atomic<std::uint64_t>, 3>;

thread_local WatchedPlace here = WatchedPlace::nowhere;
thread_local std::uint64_t faults_of_inner = 0;  // page faults in the scopes inside of the present one
std::atomic<bool> armed = false;
std::atomic<bool> ever_armed = false;
std::atomic<bool> hooked = false;
Counts allocations{};
Counts page_faults{};

void add(Counts& counts, WatchedPlace place, std::uint64_t n) {
  if (place != WatchedPlace::nowhere)
    counts[static_cast<std::size_t>(place)].fetch_add(n, std::memory_order_relaxed);
}

}  // namespace

MemoryWatch::MemoryWatch(WatchedPlace place)
    : place_(place), before_(here), faults_of_inner_before_(faults_of_inner), armed_(memory_watch_armed()) {
  here = place;
  faults_of_inner = 0;
  if (armed_) page_faults_ = page_faults_of_thread();
}

MemoryWatch::~MemoryWatch() {
  here = before_;
  const std::uint64_t faults = armed_ ? page_faults_of_thread() - page_faults_ : 0;
  if (armed_) add(page_faults, place_, faults - faults_of_inner);
  faults_of_inner = faults_of_inner_before_ + faults;
}

void watch_this_thread(WatchedPlace place) {
  here = place;
}

void arm_memory_watch() {
  for (Counts* counts : {&allocations, &page_faults}) {
    for (auto& count : *counts)
      count.store(0, std::memory_order_relaxed);
  }
  ever_armed.store(true, std::memory_order_relaxed);
  armed.store(true, std::memory_order_release);
}

void disarm_memory_watch() {
  armed.store(false, std::memory_order_release);
}

bool memory_was_watched() {
  return ever_armed.load(std::memory_order_relaxed);
}

bool memory_watch_armed() {
  return armed.load(std::memory_order_acquire);
}

std::uint64_t allocations_at(WatchedPlace place) {
  return allocations[static_cast<std::size_t>(place)].load(std::memory_order_relaxed);
}

bool allocations_are_counted() {
  return hooked.load(std::memory_order_relaxed);
}

std::uint64_t page_faults_at(WatchedPlace place) {
  return page_faults[static_cast<std::size_t>(place)].load(std::memory_order_relaxed);
}

void count_one_allocation() {
  hooked.store(true, std::memory_order_relaxed);
  if (armed.load(std::memory_order_relaxed)) add(allocations, here, 1);
}

}  // namespace lakshya
