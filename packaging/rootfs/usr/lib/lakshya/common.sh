# shellcheck shell=sh
# What the scripts of the image share. Slots are a and b; one of them was booted.

say() { echo "lakshya: $*" >/dev/console; }

word_of_cmdline() { sed -n "s/.*\\b$1=\\([^ ]*\\).*/\\1/p" /proc/cmdline; }
slot() { word_of_cmdline lakshya.slot; }
board() { cat /etc/lakshya/board; }
version() { cat /etc/lakshya/version; }

other_slot() {
  case $1 in a) echo b ;; *) echo a ;; esac
}

uptime_s() { cut -d. -f1 /proc/uptime; }

# wait_for LABEL SECONDS: the device of a file system, as soon as the kernel has found its disk.
wait_for() {
  until device=$(findfs "LABEL=$1" 2>/dev/null); do
    [ "$(uptime_s)" -lt "$2" ] || return 1
    sleep 0.1
  done
  echo "$device"
}

# The boot partition is mounted for reading, and for writing only while something is written.
boot_writable() { mount -o remount,rw /boot; }
boot_read_only() {
  sync
  mount -o remount,ro /boot
}

good=/boot/lakshya/good.tar # the last configuration with which the loop was well

mount_boot_and_data() {
  if device=$(wait_for LAKSHYA 20); then
    mount -t vfat -o ro,noatime,nosuid,nodev,noexec "$device" /boot || say "boot partition: cannot be mounted: no updates"
  else
    say "boot partition: not found: no updates"
  fi
  if device=$(wait_for LAKSHYA-DATA 20) && mount -t ext4 -o noatime,nosuid,nodev,noexec "$device" /data; then
    mkdir -p /data/config /data/recordings && return
  fi
  say "data partition: broken or missing: nothing is recorded, the last good configuration is used"
  mount -t tmpfs -o nosuid,nodev,noexec,mode=0755,size=64m tmpfs /data
  mkdir -p /data/config /data/recordings
  [ ! -f $good ] || tar -x -f $good -C /data/config || say "$good: cannot be read: the board's own configuration is used"
}

# The user's where there is one, else the board's.
config() {
  if [ -f /data/config/vehicle.yaml ]; then
    echo /data/config/vehicle.yaml
  else
    echo "/usr/share/lakshya/boards/$(board)/vehicle.yaml"
  fi
}

keep_good_config() {
  (cd /data/config && tar -c -f /tmp/good.tar .) || return
  if cmp -s /tmp/good.tar $good; then
    rm /tmp/good.tar
    return
  fi
  cp /tmp/good.tar $good.new && sync && mv $good.new $good
  rm /tmp/good.tar
}

# The machine starts again; the drives are stopped first.
restart() {
  killall -TERM lakshyad
  sleep 1
  lakshyad stop-motors --config "$(config)"
  sync
  reboot -f
}
