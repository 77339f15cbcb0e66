# The machine that builds, with clang: libFuzzer comes with it, and a ThreadSanitizer that understands OpenMP.
include(${CMAKE_CURRENT_LIST_DIR}/host.cmake)
set(CMAKE_CXX_COMPILER clang++-14)
