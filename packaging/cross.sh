# shellcheck shell=sh
# shellcheck disable=SC2046,SC2086  # lists of packages are split into words on purpose
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
  wanted=$(echo $(sysroot_packages "$arch"))
  if [ "$(cat "$sysroot/.packages" 2>/dev/null)" = "$wanted" ]; then return; fi
  require sysroot
  say "sysroot: unpacking Debian 12's libraries for $arch (once, some minutes, 700 MB)"
  mkdir -p build/sysroot
  rm -rf "$sysroot" "$sysroot.part"
  as_root mmdebstrap --quiet --mode=root --variant=extract --architectures="$arch" --include="$(echo $wanted | tr ' ' ,)" \
    --hook-dir=/usr/share/mmdebstrap/hooks/merged-usr bookworm "$sysroot.part" ||
    die "sysroot: mmdebstrap failed; is there a network, and does /etc/apt/sources.list name Debian 12?"
  # Absolute links would lead to the machine that builds. BLAS and LAPACK are links that a package's installation makes.
  find "$sysroot.part" -type l -lname '/*' | while read -r link; do
    ln -sfnr "$sysroot.part$(readlink "$link")" "$link"
  done
  for library in blas lapack; do
    ln -sfn "$library/lib$library.so.3" "$sysroot.part/usr/lib/$triplet/lib$library.so.3"
  done
  echo "$wanted" >"$sysroot.part/.packages"
  mv "$sysroot.part" "$sysroot"
  say "sysroot: $sysroot is ready"
}

# A board's programs, and all tests; where its processor is another than this machine's they run under qemu, with more time.
run_cross() {
  name=${1:-}
  [ -n "$name" ] || wrong_use "cross: which board? $(board list | tr '\n' ' ')"
  require build boards
  board check "$name" >/dev/null || exit
  arch=$(board get "$name" architecture)
  triplet=$(board get "$name" triplet)
  require "cross-$arch"
  make_sysroot "$arch"
  emulator=
  emulated=$(board get "$name" cpu.emulate)
  if [ -n "$emulated" ]; then
    case $arch in arm64) qemu=qemu-aarch64-static ;; *) qemu=qemu-arm-static ;; esac
    emulator="$qemu;-L;$root/build/sysroot/$arch;-cpu;$emulated"
  fi
  tools=ON
  [ "$arch" != armhf ] || tools=OFF
  cmake -S . -B "build/cross/$name" -G Ninja --toolchain "$root/toolchains/$triplet.cmake" \
    -DLAKSHYA_SYSROOT="$root/build/sysroot/$arch" -DCMAKE_CXX_FLAGS="$(board get "$name" cpu.flags)" \
    -DCMAKE_CROSSCOMPILING_EMULATOR="$emulator" -DLAKSHYA_EXPECT_ISA="$(board get "$name" cpu.isa)" -DLAKSHYA_TOOLS=$tools -Wno-dev >/dev/null
  cmake --build "build/cross/$name"
  run_ctest "cross/$name" --timeout 1500
}
