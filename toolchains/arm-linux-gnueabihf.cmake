# A 32-bit Arm board with NEON. Highway wants half precision in memory as IEEE 754 has it, and fused multiply-add to exist.
set(triplet arm-linux-gnueabihf)
set(CMAKE_SYSTEM_PROCESSOR armv7l)
set(CMAKE_CXX_FLAGS_INIT "-mfpu=neon-vfpv4 -mfp16-format=ieee")
include(${CMAKE_CURRENT_LIST_DIR}/linux-cross.cmake)
