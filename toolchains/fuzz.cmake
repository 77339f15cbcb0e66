# libFuzzer and its coverage come with clang.
include(${CMAKE_CURRENT_LIST_DIR}/host.cmake)
set(CMAKE_CXX_COMPILER clang++-14)
