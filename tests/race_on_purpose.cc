// A counter that threads share without a lock: the tsan preset must find it, or its silence elsewhere means nothing.
#include <cstdio>

int main() {
  int count = 0;
#pragma omp parallel for schedule(static) num_threads(4)
  for (int i = 0; i < 100000; ++i)
    count += 1;
  std::printf("%d of 100000\n", count);
}
