#!/usr/bin/env python3
"""Writes a board's image onto a memory card, a disk, or into a file for an emulator.

    flash.py BOARD DEVICE [--force] [--yes] [--inject FILE...]

Refuses what is mounted, read-only, too small, or no removable disk (--force: a disk that is not removable). Shows what will be
overwritten and asks once (--yes: does not). Reads everything back. --inject: vehicle.yaml and calibration files, into the data
partition's folder config. Exit code 1: refused or failed, with the reason.
"""

import argparse
import hashlib
import json
import os
import pathlib
import stat
import subprocess
import sys
import xml.etree.ElementTree

import disk
from failure import ImageError, run

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
CONFIG_FILES = (".yaml", ".yml", ".txt", ".xml", ".csv")


def say(text):
    print(f"flash: {text}", file=sys.stderr, flush=True)


def built_image(name, folder):
    folder = pathlib.Path(folder) if folder else ROOT / "out" / name
    images = sorted(folder.glob(f"lakshya-*-{name}.img.zst"))
    if not images:
        raise ImageError(f"{os.path.relpath(folder)}: no image (./dev image {name} builds it)")
    return images[-1]


def checks_of(bmap):
    """Size in bytes, and (first byte, bytes, SHA-256) of everything that is written."""
    root = xml.etree.ElementTree.parse(bmap).getroot()
    block = int(root.findtext("BlockSize"))
    size = int(root.findtext("ImageSize"))
    ranges = []
    for item in root.find("BlockMap"):
        first, _, last = item.text.strip().partition("-")
        begin = int(first) * block
        end = min((int(last or first) + 1) * block, size)
        ranges.append((begin, end - begin, item.get("chksum")))
    return size, ranges


def examine(path, size, force):
    """What the target is, for people. ImageError where it must not be overwritten."""
    try:
        mode = os.stat(path).st_mode
    except FileNotFoundError as error:
        if str(path).startswith("/dev/"):
            raise ImageError(f"{path}: no such device (lsblk lists them)") from error
        return "a new file"
    if stat.S_ISREG(mode):
        return f"a file of {os.stat(path).st_size / 1e6:.0f} MB"
    if not stat.S_ISBLK(mode):
        raise ImageError(f"{path}: neither a disk nor a file")
    found = json.loads(run(["lsblk", "--json", "--bytes", "--output", "PATH,TYPE,RM,HOTPLUG,RO,SIZE,MODEL,MOUNTPOINTS", path]))
    whole = found["blockdevices"][0]
    if whole["type"] not in ("disk", "loop"):
        raise ImageError(f"{path}: a {whole['type']}, not a whole disk (its disk has a shorter name)")
    for part in [whole, *whole.get("children", [])]:
        mounted = [point for point in part["mountpoints"] if point]
        if mounted:
            raise ImageError(f"{path}: {part['path']} is mounted at {mounted[0]} (umount {part['path']})")
    if whole["ro"]:
        raise ImageError(f"{path}: can only be read (is the card's lock on?)")
    if whole["size"] < size:
        raise ImageError(f"{path}: {whole['size'] / 1e6:.0f} MB, and the image needs {size / 1e6:.0f} MB")
    if not (whole["rm"] or whole["hotplug"] or force):
        raise ImageError(f"{path}: no removable disk: {whole['model'] or 'unknown'} (--force writes it all the same)")
    return f"{whole['model'] or 'unknown model'}, {whole['size'] / 1e9:.1f} GB"


def ask(path, what):
    if not sys.stdin.isatty():
        raise ImageError(f"{path}: nobody there to ask (--yes overwrites it without asking)")
    print(f"{path}: {what}. Everything on it will be lost. Type yes: ", end="", file=sys.stderr, flush=True)
    if sys.stdin.readline().strip() != "yes":
        raise ImageError("not confirmed: nothing was written")


def verify(path, ranges):
    total = sum(count for _, count, _ in ranges)
    done = 0
    with open(path, "rb", buffering=0) as device:
        os.posix_fadvise(device.fileno(), 0, 0, os.POSIX_FADV_DONTNEED)  # from the card, not from memory
        for begin, count, expected in ranges:
            device.seek(begin)
            digest = hashlib.sha256()
            while count > 0:
                chunk = device.read(min(count, 1 << 20))
                if not chunk:
                    raise ImageError(f"{path}: ends too early when it is read back (is it worn out?)")
                digest.update(chunk)
                count -= len(chunk)
                done += len(chunk)
                if sys.stderr.isatty():
                    print(f"\rflash: read back {100 * done // total} %", end="", file=sys.stderr)
            if digest.hexdigest() != expected:
                raise ImageError(f"{path}: bytes {begin} on are not what was written (is it worn out?)")
    if sys.stderr.isatty():
        print(file=sys.stderr)


def inject(path, files):
    """Into the data partition, which begins where the boot partition ends."""
    offset = disk.data_offset(path)
    script = "mkdir config\ncd config\n" + "".join(f"rm {file.name}\nwrite {file} {file.name}\n" for file in files)
    done = subprocess.run(["debugfs", "-w", "-f", "-", f"{path}?offset={offset}"], input=script, capture_output=True, text=True,
                          check=False)
    listed = run(["debugfs", "-R", "ls -p /config", f"{path}?offset={offset}"])
    for file in files:
        if f"/{file.name}/" not in listed:
            raise ImageError(f"{file}: could not be written into the data partition: {done.stderr.strip()}")


def flash(options):
    image = built_image(options.board, options.images)
    size, ranges = checks_of(image.with_suffix("").with_suffix(".bmap"))
    files = [pathlib.Path(file).resolve() for file in options.inject]
    for file in files:
        if not file.is_file() or file.suffix not in CONFIG_FILES:
            raise ImageError(f"--inject {file}: no file of {', '.join(CONFIG_FILES)}")
    what = examine(options.device, size, options.force)
    if not options.yes:
        ask(options.device, what)
    say(f"{image.name} -> {options.device} ({what})")
    if not str(options.device).startswith("/dev/"):
        with open(options.device, "wb") as target:
            target.truncate(size)
    done = subprocess.run(["bmaptool", "--quiet" if not sys.stderr.isatty() else "--debug", "copy", "--bmap",
                           str(image.with_suffix("").with_suffix(".bmap")), str(image), str(options.device)],
                          stdout=subprocess.DEVNULL, stderr=None if sys.stderr.isatty() else subprocess.PIPE, check=False)
    if done.returncode != 0:
        raise ImageError(f"{options.device}: could not be written: {(done.stderr or b'').decode().strip()[-300:]}")
    verify(options.device, ranges)
    if files:
        inject(options.device, files)
    say(f"{options.device}: written and read back" + (f", with {', '.join(file.name for file in files)}" if files else ""))


def main():
    parser = argparse.ArgumentParser(prog="./dev flash", description="Writes a board's image onto a disk, or into a file.")
    parser.add_argument("board")
    parser.add_argument("device", help="/dev/sdX, /dev/mmcblkN, or a file")
    parser.add_argument("--images", metavar="DIR", help="where the image is, instead of out/BOARD")
    parser.add_argument("--force", action="store_true", help="also a disk that is not removable")
    parser.add_argument("--yes", action="store_true", help="do not ask")
    parser.add_argument("--inject", nargs="+", default=[], metavar="FILE", help="vehicle.yaml and what it names")
    try:
        flash(parser.parse_args())
    except ImageError as error:
        print(f"flash: {error}", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
