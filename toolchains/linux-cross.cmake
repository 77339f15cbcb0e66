# What the toolchains for other processors share; they set `triplet` (the compiler's prefix) and `debian` (Debian's name of the
# processor), then include this. With LAKSHYA_SYSROOT (`./dev sysroot`) everything is built, against the libraries there. Without it
# only the kernels are: Debian's cross compiler looks into /usr/include by itself, where the headers are that are the same for every
# processor (Highway's, GoogleTest's). Which processor of the family is the preset's or the board's choice.
set(CMAKE_SYSTEM_NAME Linux)
set(CMAKE_LIBRARY_ARCHITECTURE ${triplet})
set(CMAKE_CXX_COMPILER ${triplet}-g++)
if(NOT DEFINED LAKSHYA_SYSROOT AND NOT "$ENV{LAKSHYA_SYSROOT}" STREQUAL "")
  set(LAKSHYA_SYSROOT $ENV{LAKSHYA_SYSROOT})
endif()
list(APPEND CMAKE_TRY_COMPILE_PLATFORM_VARIABLES LAKSHYA_SYSROOT)
if(LAKSHYA_SYSROOT)
  set(CMAKE_SYSROOT ${LAKSHYA_SYSROOT})
  set(CMAKE_FIND_ROOT_PATH ${LAKSHYA_SYSROOT})
  # Libraries that are not named on the linker's command line, but needed by one that is.
  foreach(folder lib/${triplet} usr/lib/${triplet} usr/lib/${triplet}/blas usr/lib/${triplet}/lapack)
    string(APPEND CMAKE_EXE_LINKER_FLAGS_INIT " -Wl,-rpath-link,${LAKSHYA_SYSROOT}/${folder}")
  endforeach()
  set(ENV{PKG_CONFIG_SYSROOT_DIR} ${LAKSHYA_SYSROOT})
  set(ENV{PKG_CONFIG_LIBDIR} ${LAKSHYA_SYSROOT}/usr/lib/${triplet}/pkgconfig:${LAKSHYA_SYSROOT}/usr/share/pkgconfig)
else()
  set(CMAKE_FIND_ROOT_PATH /usr/${triplet})
endif()
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
set(CMAKE_FIND_ROOT_PATH_MODE_LIBRARY ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_INCLUDE ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_PACKAGE ONLY)
