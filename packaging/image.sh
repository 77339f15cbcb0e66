# shellcheck shell=sh
# shellcheck disable=SC2154,SC2086  # root and command are ./dev's; lists of arguments are split on purpose
# `./dev image`, `./dev flash` and `./dev update-key`: read by ./dev after packaging/cross.sh.

# The firmware of a board that an image can be made for, and its arguments for packaging/image/build.py in $build_arguments.
firmware_for_image() {
  board check "$1" >/dev/null || exit
  arch=$(board get "$1" architecture)
  [ "$(board get "$1" deliver)" = image ] || die "$command: $1 is delivered as a package on the vendor's system, not as an image"
  require build image "image-$arch"
  configure_board "$1"
  cmake --build "build/cross/$1" --target lakshyad
  build_arguments="--firmware-program $root/build/cross/$1/app/lakshyad/lakshyad --sysroot $root/build/sysroot/$arch"
}

run_image() {
  require boards
  [ -n "${1:-}" ] || wrong_use "image: which board? $(board list | tr '\n' ' ')"
  firmware_for_image "$1"
  "$root/packaging/image/build.py" "$@" $build_arguments
}

# The image in a virtual machine, treated badly: docs/image.md.
run_hil() {
  require boards
  [ -n "${1:-}" ] || set -- qemu-arm64
  firmware_for_image "$1"
  require "hil-$arch"
  "$root/tests/hil/hil.py" "$@" -- $build_arguments
}

run_flash() {
  require boards image
  "$root/packaging/image/flash.py" "$@"
}

# A pair of keys for signed updates, without a passphrase: for the machine that builds, in a folder that only its user can read.
run_update_key() {
  secret=${1:-}
  case $secret in *.sec) ;; *) wrong_use "update-key: name the secret key's file, NAME.sec; NAME.pub is made beside it" ;; esac
  [ ! -e "$secret" ] || die "update-key: $secret is there already; images that have its public key take only its updates"
  require image
  (umask 077 && signify-openbsd -G -n -c "Lakshya updates" -p "${secret%.sec}.pub" -s "$secret") || die "update-key: cannot write $secret"
  say "update-key: $secret signs updates and must stay secret; ${secret%.sec}.pub goes into images"
}
