# shellcheck shell=sh
# shellcheck disable=SC2154  # root is ./dev's
# `./dev image`, `./dev flash` and `./dev update-key`: read by ./dev after packaging/cross.sh.

run_image() {
  name=${1:-}
  [ -n "$name" ] || wrong_use "image: which board? $(board list | tr '\n' ' ')"
  require boards
  board check "$name" >/dev/null || exit
  [ "$(board get "$name" deliver)" = image ] ||
    die "image: $name is delivered as a package on the vendor's system: ./dev deb $(board get "$name" architecture)"
  require build image "image-$(board get "$name" architecture)"
  configure_board "$name"
  cmake --build "build/cross/$name" --target lakshyad
  "$root/packaging/image/build.py" "$@" --firmware-program "$root/build/cross/$name/app/lakshyad/lakshyad" \
    --sysroot "$root/build/sysroot/$(board get "$name" architecture)"
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
