# A PC, against the libraries of a sysroot instead of those of the machine that builds. As in host.cmake the baseline is x86-64-v2; what is
# faster is chosen at run time.
set(triplet x86_64-linux-gnu)
set(CMAKE_SYSTEM_PROCESSOR x86_64)
set(CMAKE_CXX_FLAGS_INIT "-march=x86-64-v2")
include(${CMAKE_CURRENT_LIST_DIR}/linux-cross.cmake)
