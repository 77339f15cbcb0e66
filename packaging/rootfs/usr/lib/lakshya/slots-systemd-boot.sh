# shellcheck shell=sh
# Slots under systemd-boot: an entry file for each, whose name counts the tries that are left (systemd-boot(7), "boot counting"). An
# entry without a counter has proved itself. Among those that may be booted the one with the highest version comes first.

entries=/boot/loader/entries
slot_file() { echo "/boot/lakshya/$1.efi"; }

entry_of() { find $entries -name "lakshya-$1.conf" -o -name "lakshya-$1+*.conf"; }

slot_is_on_trial() { [ -n "$(find $entries -name "lakshya-$1+*.conf")" ]; }

confirm_slot() { mv "$(entry_of "$1")" "$entries/lakshya-$1.conf"; }

forget_slot() {
  for entry in $(entry_of "$1"); do rm "$entry"; done
  sync
}

# The last step of an update: until the entry has its name, the slot is not booted.
try_slot() {
  last=$(sed -n 's/^version //p' $entries/*.conf | sort -n | tail -n 1)
  sed -e "s/^version .*/version $((${last:-0} + 1))/" -e "s|/lakshya/[ab]\\.efi|/lakshya/$1.efi|" \
    -e "s/lakshya\\.slot=[ab]/lakshya.slot=$1/" -e "s/^title .*/title Lakshya $2, slot $1/" \
    "$(entry_of "$(other_slot "$1")")" >"$entries/lakshya-$1.new"
  sync
  mv "$entries/lakshya-$1.new" "$entries/lakshya-$1+3.conf"
}
