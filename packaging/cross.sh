# shellcheck shell=sh
# shellcheck disable=SC2154  # root is ./dev's
# `./dev sysroot` and `./dev cross`: read by ./dev, whose say, die, require and run_ctest it uses.

board() { python3 "$root/packaging/board.py" "$@"; }

triplet_of() {
  case $1 in
    amd64) echo x86_64-linux-gnu ;;
    arm64) echo aarch64-linux-gnu ;;
    armhf) echo arm-linux-gnueabihf ;;
    *) wrong_use "sysroot: $1 is no processor that images are built for: amd64, arm64, armhf" ;;
  esac
}

# What a program for a board is linked with. The simulator's ray tracer is not built for 32-bit Arm.
sysroot_packages() {
  echo libc6-dev libstdc++-12-dev libgcc-12-dev libgomp1
  packages libraries | sed "s/ libembree-dev/$([ "$1" = armhf ] || echo ' &')/"
}

# Debian's libraries and headers for another processor, unpacked and not installed: no program of that processor runs for it.
make_sysroot() {
  arch=$1
  triplet=$(triplet_of "$arch") || exit
  sysroot=build/sysroot/$arch
  contents=$(sysroot_packages "$arch" | xargs)
  if [ "$(cat "$sysroot/.packages" 2>/dev/null)" = "$contents" ]; then return; fi
  require sysroot
  say "sysroot: unpacking Debian 12's libraries for $arch (once, some minutes, 700 MB)"
  mkdir -p build/sysroot
  rm -rf "$sysroot" "$sysroot.part"
  as_root mmdebstrap --quiet --mode=root --variant=extract --architectures="$arch" --include="$(echo "$contents" | tr ' ' ,)" \
    --hook-dir=/usr/share/mmdebstrap/hooks/merged-usr bookworm "$sysroot.part" ||
    die "sysroot: mmdebstrap failed; is there a network, and does /etc/apt/sources.list name Debian 12?"
  # Programs under qemu-user look here first: they must find libraries, and not the devices and folders of a system that is none.
  find "$sysroot.part" -mindepth 1 -maxdepth 1 ! -name usr ! -name 'lib*' -exec rm -rf {} +
  # Absolute links would lead to the machine that builds. BLAS and LAPACK are links that a package's installation makes.
  find "$sysroot.part" -type l -lname '/*' | while read -r link; do
    ln -sfnr "$sysroot.part$(readlink "$link")" "$link"
  done
  for library in blas lapack; do
    ln -sfn "$library/lib$library.so.3" "$sysroot.part/usr/lib/$triplet/lib$library.so.3"
  done
  echo "$contents" >"$sysroot.part/.packages"
  mv "$sysroot.part" "$sysroot"
  say "sysroot: $sysroot is ready"
}

# The build folder of a board: build/cross/NAME. The host command is left out where its ray tracer is not made for the processor.
configure_board() {
  arch=$(board get "$1" architecture)
  require "cross-$arch"
  make_sysroot "$arch"
  emulator=
  emulated=$(board get "$1" cpu.emulate)
  if [ -n "$emulated" ]; then
    case $arch in arm64) qemu="qemu-aarch64-static" ;; *) qemu="qemu-arm-static" ;; esac
    emulator="$qemu;-L;$root/build/sysroot/$arch;-cpu;$emulated" # a list of CMake's
  fi
  tools=ON
  [ "$arch" != armhf ] || tools=OFF
  cmake -S . -B "build/cross/$1" -G Ninja --toolchain "$root/toolchains/$(board get "$1" triplet).cmake" \
    -DLAKSHYA_SYSROOT="$root/build/sysroot/$arch" -DCMAKE_CXX_FLAGS="$(board get "$1" cpu.flags) -ffile-prefix-map=$root=." \
    -DCMAKE_CROSSCOMPILING_EMULATOR="$emulator" -DLAKSHYA_EXPECT_ISA="$(board get "$1" cpu.isa)" -DLAKSHYA_TOOLS=$tools -Wno-dev >/dev/null
}

run_sysroot() { make_sysroot "${1:-}"; }

# A board's programs, and all tests; where its processor is another than this machine's they run under qemu, with more time.
run_cross() {
  name=${1:-}
  [ -n "$name" ] || wrong_use "cross: which board? $(board list | tr '\n' ' ')"
  require build boards
  board check "$name" >/dev/null || exit
  configure_board "$name"
  cmake --build "build/cross/$name"
  say "cross: what lakshyad loads"
  "$root/packaging/elf_closure.py" --limit 8 "build/sysroot/$arch" "build/cross/$name/app/lakshyad/lakshyad"
  run_ctest "cross/$name"
}
