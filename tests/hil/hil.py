#!/usr/bin/env python3
"""Hardware in the loop without the hardware: a board's image boots in a virtual machine and is treated badly. Called by ./dev hil.

    hil.py BOARD [--cuts N] [--only CASE...] -- BUILD-ARGUMENT...      (the rest goes to packaging/image/build.py)

Every case says what it saw; exit code 1: one failed. Everything is left in build/hil/BOARD: console.log, disk.img.
"""

import argparse
import pathlib
import random
import re
import shutil
import subprocess
import sys
import time

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
sys.path[:0] = [str(ROOT / "packaging"), str(ROOT / "packaging/image"), str(pathlib.Path(__file__).resolve().parent)]

import board  # noqa: E402
import bundle  # noqa: E402
import scene  # noqa: E402
from machine import HilError, Machine  # noqa: E402

BOOT_S = 20
CASES = {}


def case(function):
    CASES[function.__name__] = function
    return function


class Bench:
    """The images, bundles and keys that the cases share, and the disk that they work on."""

    def __init__(self, name, build_arguments):
        self.name = name
        self.settings = board.of(name)
        self.folder = ROOT / "build/hil" / name
        self.build_arguments = build_arguments
        shutil.rmtree(self.folder, ignore_errors=True)
        self.folder.mkdir(parents=True)
        self.key = self.folder / "key.sec"
        self.other_key = self.folder / "other.sec"
        for key in (self.key, self.other_key):
            subprocess.run(["signify-openbsd", "-G", "-n", "-c", "hil", "-p", key.with_suffix(".pub"), "-s", key], check=True)
        self.overlay = self.folder / "overlay"
        shutil.copytree(ROOT / "tests/hil/overlay", self.overlay)
        scene.write(self.overlay / "usr/share/lakshya/scene")
        # Emulated processors are slow: limits of time are stretched, and the report says by how much.
        self.scale = 8
        self.vehicle = self.folder / "vehicle.yaml"
        self.vehicle.write_text(scene.vehicle(name, self.scale))
        self.disk = self.folder / "disk.img"

    def build(self, version, overlay=None):
        out = self.folder / f"image-{version}"
        if not out.is_dir():
            say(f"image {version}")
            done = subprocess.run([str(ROOT / "packaging/image/build.py"), self.name, "--version", version, "--out", str(out), "--update-key",
                                   str(self.key), "--overlay", str(overlay or self.overlay), *self.build_arguments],
                                  capture_output=True, text=True, check=False)
            if done.returncode != 0:
                raise HilError(f"image {version}: {done.stderr}")
        return out

    def bundle(self, version, overlay=None):
        return next(self.build(version, overlay).glob("*.lku"))

    def flash(self, version="1.0"):
        done = subprocess.run([str(ROOT / "packaging/image/flash.py"), self.name, str(self.disk), "--yes", "--images",
                               str(self.build(version)), "--inject", str(self.vehicle)], capture_output=True, text=True, check=False)
        if done.returncode != 0:
            raise HilError(done.stderr)

    def machine(self, *extra):
        return Machine(self.settings["architecture"], self.disk, self.folder, extra)

    def stick(self, name, files):
        """A FAT file system with these files (name there -> file or text)."""
        stick = self.folder / name
        stick.unlink(missing_ok=True)
        subprocess.run(["truncate", "--size", "192M", str(stick)], check=True)
        subprocess.run(["mkfs.vfat", "-F", "32", str(stick)], check=True, stdout=subprocess.DEVNULL)
        for there, source in files.items():
            if isinstance(source, str):
                text = self.folder / "stick-text"
                text.write_text(source)
                source = text
            subprocess.run(["mcopy", "-i", str(stick), str(source), f"::{there}"], check=True)
        return stick


def say(text):
    print(f"hil: {text}", flush=True)


def booted(machine, slot, version, seconds=BOOT_S * 3):
    machine.wait_for(rf"Lakshya {re.escape(version)}, slot {slot}", seconds, f"start of version {version} in slot {slot}")
    return machine.wait_for(r"READY ([0-9.]+) s after the kernel's start", seconds, "READY")[0].group(1)


def good_configuration(machine):
    """Waits until it has been kept: 30 s of a healthy loop."""
    deadline = time.monotonic() + 170
    while machine.run("test -f /boot/lakshya/good.tar", check=False)[0] != 0:
        if time.monotonic() > deadline:
            raise HilError("no good configuration was kept within 170 s")
        time.sleep(2)


@case
def reproducible(bench):
    """Two builds give the same bytes."""
    first = bench.build("1.0")
    again = bench.folder / "again"
    first.rename(again)
    for file in sorted(bench.build("1.0").iterdir()):
        if file.read_bytes() != (again / file.name).read_bytes():
            raise HilError(f"{file.name} differs from one build to the next")
    return f"{len(list(again.iterdir()))} files, the same twice"


@case
def boots(bench):
    """READY within 20 s of switching on; the kernels equal their reference; frames are processed; nothing listens."""
    bench.flash()
    with bench.machine().start() as machine:
        equal, _ = machine.wait_for(r"self-test passed: (.*)", BOOT_S, "self-test")
        machine.wait_for(r"READY .* s after the kernel's start, slot a, version 1.0", BOOT_S, "READY")
        took = time.monotonic() - machine.begin
        if took > BOOT_S:
            raise HilError(f"READY after {took:.1f} s, and not {BOOT_S} s")
        frames = [int(machine.wait_for(r": RUN .* frame (\d+) ", 15, "status")[0].group(1)) for _ in range(2)]
        if frames[1] <= frames[0]:
            raise HilError(f"no frames processed: {frames}")
        _, sockets = machine.run("cat /proc/net/tcp /proc/net/tcp6 /proc/net/udp /proc/net/udp6 2>/dev/null | grep -v local_address | wc -l")
        if sockets.strip() != "0":
            raise HilError(f"{sockets.strip()} open ports")
        _, memory = machine.run("awk '/^MemTotal|^MemAvailable/ {print $2}' /proc/meminfo")
        total, free = (int(word) for word in memory.split())
        code, _ = machine.run("touch /usr/x", check=False)
        if code == 0:
            raise HilError("the root file system can be written")
        return (f"READY {took:.1f} s after switching on, {equal.group(1)}, {frames[1] - frames[0]} frames in 5 s, "
                f"{(total - free) / 1024:.0f} MB of RAM used, no open port")


@case
def killed(bench):
    """kill -9: the drives are told to stop, and the firmware starts again."""
    bench.flash()
    with bench.machine().start() as machine:
        booted(machine, "a", "1.0")
        machine.drain()
        machine.run("killall -9 lakshyad")
        _, stopped = machine.wait_for("the drives have confirmed zero speed", 3 * bench.scale, "stop-motors")
        _, again = machine.wait_for("-> RUN: ", 20, "RUN again")
        return f"drives stopped after {stopped:.1f} s, driving again {again:.1f} s later"


@case
def hangs(bench):
    """SIGSTOP: the hardware watchdog resets the machine, and it boots again."""
    bench.flash()
    with bench.machine().start() as machine:
        booted(machine, "a", "1.0")
        machine.drain()
        machine.run("killall -STOP lakshyad")
        _, reset = machine.wait_for(r"Lakshya 1.0, slot a", 60, "reset by the watchdog")
        booted_again = machine.wait_for(r"READY", BOOT_S * 2, "READY again")[1]
        return f"reset and started again after {reset:.1f} s, READY {booted_again:.1f} s later"


@case
def updates(bench):
    """A bundle on a stick: installed, tried, confirmed after 30 s of a healthy loop; configuration kept; a stick without the file is left alone."""
    bench.flash()
    stick = bench.stick("stick.img", {"lakshya-update.lku": bench.bundle("1.1"), "lakshya-install": "yes"})
    with bench.machine().start() as machine:
        booted(machine, "a", "1.0")
        machine.wait_for("RUN ", 20)
        good_configuration(machine)
        machine.plug_stick(stick)
        machine.wait_for("version 1.1 is in slot b and will be tried", 60, "installed")
        booted(machine, "b", "1.1")
        _, confirmed = machine.wait_for("slot b has proved itself", 170, "confirmed")
        _, entries = machine.run("ls /boot/loader/entries; ls /data/config")
        if "lakshya-b.conf" not in entries or "vehicle.yaml" not in entries:
            raise HilError(f"after the update there are: {entries.split()}")
    with bench.machine().start() as machine:
        booted(machine, "b", "1.1")
    return f"1.0 to 1.1, confirmed {confirmed:.0f} s after READY, kept after a power cut"


@case
def falls_back(bench):
    """A slot that never gets well: three tries, then the other one comes back."""
    broken = bench.folder / "broken"
    shutil.copytree(bench.overlay, broken, dirs_exist_ok=True)
    crash = broken / "usr/lib/lakshya/start.d/crash"
    crash.write_text("#!/bin/sh\necho 'lakshya: TRY' >/dev/console\nreboot -f\n")
    crash.chmod(0o755)
    stick = bench.stick("stick.img", {"u.lku": bench.bundle("1.2", broken)})
    bench.flash()
    with bench.machine("-drive", f"if=virtio,format=raw,file={stick}").start() as machine:
        booted(machine, "a", "1.0")
        machine.run("mkdir -p /run/s && mount -t vfat /dev/vdb /run/s && lakshya-update /run/s/u.lku && umount /run/s", 60)
        machine.run("reboot -f &")
        for attempt in range(3):
            machine.wait_for("Lakshya 1.2, slot b", BOOT_S * 3, f"try {attempt + 1}")
        booted(machine, "a", "1.0")
        return "3 tries of slot b, then slot a again"


@case
def refuses(bench):
    """Bundles that are not right are refused with a reason, and nothing is written."""
    good = bench.bundle("1.1")
    tampered = bench.folder / "tampered.lku"
    data = bytearray(good.read_bytes())
    data[len(data) // 2] ^= 1
    tampered.write_bytes(data)
    slot = bench.folder / "slot"
    slot.write_bytes(b"nothing")
    files = {"tampered.lku": tampered}
    for name, board_name, version, key in (("foreign.lku", bench.name, "2.0", bench.other_key), ("board.lku", "rpi9", "2.0", bench.key),
                                           ("older.lku", bench.name, "0.9", bench.key), ("same.lku", bench.name, "1.0", bench.key)):
        bundle.build(bench.folder / name, slot=slot, board=board_name, version=version, secret=key, when=0, work=bench.folder)
        files[name] = bench.folder / name
    unsigned = bench.folder / "unsigned.lku"
    unsigned.write_bytes(b"\0" * 10240)
    files["unsigned.lku"] = unsigned
    stick = bench.stick("stick.img", files)
    bench.flash()
    reasons = {"tampered.lku": "damaged", "foreign.lku": "not signed with this image's key", "board.lku": "for board rpi9",
               "older.lku": "0.9 is not newer than 1.0", "same.lku": "1.0 is not newer", "unsigned.lku": "no update bundle"}
    with bench.machine("-drive", f"if=virtio,format=raw,file={stick}").start() as machine:
        booted(machine, "a", "1.0")
        machine.run("mkdir -p /run/s && mount -t vfat -o ro /dev/vdb /run/s")
        before = machine.run("find /boot -type f | xargs sha256sum")[1]
        for name, reason in reasons.items():
            code, text = machine.run(f"lakshya-update /run/s/{name}", 60, check=False)
            if code != 1 or reason not in text:
                raise HilError(f"{name}: exit code {code}: {text}")
        if machine.run("find /boot -type f | xargs sha256sum")[1] != before:
            raise HilError("a refused bundle has changed the boot partition")
    return ", ".join(name.removesuffix(".lku") for name in reasons)


@case
def power_cuts(bench):
    """The plug is pulled at random moments of an update: it always starts again, configuration intact, one slot or the other."""
    chance = random.Random(8)
    stick = bench.stick("stick.img", {"u.lku": bench.bundle("1.1"), "v.lku": bench.bundle("1.0")})
    bench.flash()
    found = {}
    for cut in range(bench.cuts):
        with bench.machine("-drive", f"if=virtio,format=raw,file={stick}").start() as machine:
            match, _ = machine.wait_for(r"Lakshya (1\.[01]), slot ([ab])", BOOT_S * 3, f"start after cut {cut}")
            machine.wait_for("READY", BOOT_S * 3, f"READY after cut {cut}")
            found[match.group(0)] = found.get(match.group(0), 0) + 1
            if "scale" not in machine.run("head -c 4 /data/config/vehicle.yaml; echo scale")[1]:
                raise HilError(f"the configuration is gone after cut {cut}")
            machine.run("cmp /data/config/vehicle.yaml /usr/share/lakshya/scene/vehicle.yaml")
            # A slot on trial takes no update: it is confirmed as it would be after 30 s.
            machine.run(". /usr/lib/lakshya/common.sh; . /usr/lib/lakshya/slots-systemd-boot.sh; boot_writable; "
                        "! slot_is_on_trial $(slot) || confirm_slot $(slot); boot_read_only")
            machine.run("mkdir -p /run/s && mount -t vfat -o ro /dev/vdb /run/s")
            name = "v" if match.group(1) == "1.1" else "u"
            machine.agent.sendall(f"lakshya-update --force /run/s/{name}.lku && reboot -f\n".encode())
            time.sleep(chance.uniform(0.2, 9))
    with bench.machine().start() as machine:
        machine.wait_for("READY", BOOT_S * 3, "READY after the last cut")
    return f"{bench.cuts} cuts; started as " + ", ".join(f"{name} x {count}" for name, count in sorted(found.items()))


@case
def broken_data(bench):
    """The data partition is overwritten: the vehicle runs with the last good configuration."""
    bench.flash()
    with bench.machine().start() as machine:
        booted(machine, "a", "1.0")
        good_configuration(machine)
    with open(bench.disk, "r+b") as disk_file:
        import disk  # noqa: PLC0415
        disk_file.seek(disk.data_offset(bench.disk))
        disk_file.write(b"\xff" * (4 << 20))
    with bench.machine().start() as machine:
        machine.wait_for("data partition: broken or missing", 60, "notice of the broken partition")
        booted_after = machine.wait_for("READY", BOOT_S * 2, "READY")[1]
        machine.run("cmp /data/config/vehicle.yaml /usr/share/lakshya/scene/vehicle.yaml")
        return f"READY {booted_after:.1f} s after the notice, with the configuration that was kept"


def main():
    words = sys.argv[1:]
    at = words.index("--") if "--" in words else len(words)
    parser = argparse.ArgumentParser(prog="./dev hil")
    parser.add_argument("board")
    parser.add_argument("--cuts", type=int, default=20, help="power cuts (default 20)")
    parser.add_argument("--only", nargs="+", choices=sorted(CASES), help="these cases")
    options = parser.parse_args(words[:at])
    bench = Bench(options.board, words[at + 1:])
    bench.cuts = options.cuts
    shutil.copyfile(bench.vehicle, bench.overlay / "usr/share/lakshya/scene/vehicle.yaml")
    say(f"{options.board}: limits of time are {bench.scale} times the usual ones")
    failed = []
    for name, function in CASES.items():
        if options.only and name not in options.only:
            continue
        begin = time.monotonic()
        try:
            said = function(bench)
            say(f"{name}: {said} ({time.monotonic() - begin:.0f} s)")
        except HilError as error:
            failed.append(name)
            say(f"{name}: FAILED: {error}")
    say(f"failed: {', '.join(failed)}" if failed else "passed")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
