# The machine that builds: Debian 12's g++ 12. On x86 the baseline is x86-64-v2, so that one binary runs on
# every board of the last decade; faster instruction sets are chosen at run time, kernel by kernel.
set(CMAKE_CXX_COMPILER g++)
if(CMAKE_HOST_SYSTEM_PROCESSOR STREQUAL "x86_64")
  set(CMAKE_CXX_FLAGS_INIT "-march=x86-64-v2")
endif()
