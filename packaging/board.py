#!/usr/bin/env python3
"""Reads boards/NAME/board.yaml: what a board is, for whatever builds for it.

    board.py check [NAME...]   every board, or these: one line each, or what is wrong with file, line, key and reason; a name with a
                               slash is a file
    board.py get NAME KEY      one value (cpu.flags), a list as one line per item; nothing where a key that may be left out is
    board.py list              the names

Exit code 1: a board is not as it should be.
"""

import pathlib
import re
import sys

import yaml

ROOT = pathlib.Path(__file__).resolve().parent.parent


class BoardError(Exception):
    """Message: FILE:LINE: KEY: REASON (WHAT TO DO)."""


def text(pattern, meaning):
    def check(value):
        if not isinstance(value, str) or not re.fullmatch(pattern, value):
            return f"{value!r} is not {meaning}"
        return None

    return check


def one_of(*names):
    def check(value):
        return None if value in names else f"{value!r} is unknown (known: {', '.join(names)})"

    return check


def whole(least, most):
    def check(value):
        if isinstance(value, bool) or not isinstance(value, int) or not least <= value <= most:
            return f"{value!r} is not a whole number from {least} to {most}"
        return None

    return check


def list_of(check_one):
    def check(value):
        if not isinstance(value, list):
            return "is not a list (write \"[a, b]\")"
        return next((reason for reason in map(check_one, value) if reason), None)

    return check


PACKAGE = text(r"[a-z0-9][a-z0-9+.-]+", "a Debian package's name")
MODULE = text(r"[a-z0-9_]+", "a kernel module's name (with _, not -)")
FLAGS = text(r"(-[A-Za-z0-9+=._-]+)( -[A-Za-z0-9+=._-]+)*", "compiler flags")
CORES = text(r"\d+(-\d+)?(,\d+(-\d+)?)*", "a list of cores such as 1 or 2-3")

# Key: (check, must be there). The meaning of each: docs/boards.md.
KEYS = {
    "title": (text(r".{3,80}", "3 to 80 characters"), True),
    "architecture": (one_of("amd64", "arm64", "armhf"), True),
    "deliver": (one_of("image", "deb"), True),
    "cpu.flags": (FLAGS, True),
    "cpu.emulate": (text(r"[a-z0-9,=-]+", "a processor of qemu-user"), False),
    "cpu.isa": (one_of("sse4", "avx2", "neon", "sve"), False),
    "kernel.package": (PACKAGE, False),
    "kernel.rt_package": (PACKAGE, False),
    "kernel.modules": (list_of(MODULE), False),
    "kernel.options": (text(r"[ -~]*", "one line of ASCII"), False),
    "boot.loader": (one_of("systemd-boot", "u-boot", "raspberry-pi"), False),
    "boot.package": (PACKAGE, False),
    "boot.device_tree": (text(r"[A-Za-z0-9_.+/-]+\.dtb", "a device tree such as rockchip/rk3399-rock-pi-4b.dtb"), False),
    "boot.console": (text(r"tty[A-Z]+\d+(,\d+n8)?", "a console such as ttyS0,115200n8"), False),
    "image.table": (one_of("gpt", "mbr"), False),
    "image.boot_mib": (whole(32, 4096), False),
    "image.data_mib": (whole(16, 65536), False),
    "watchdog.module": (MODULE, False),
    "watchdog.seconds": (whole(1, 60), False),
    "cores.control": (CORES, False),
    "cores.perception": (CORES, False),
}
GROUPS = sorted({key.split(".")[0] for key in KEYS if "." in key})
# What an image cannot be built without.
IMAGE_KEYS = ("kernel.package", "kernel.modules", "boot.loader", "boot.package", "boot.console", "image.table", "image.boot_mib",
              "image.data_mib", "watchdog.module", "watchdog.seconds")
TRIPLETS = {"amd64": "x86_64-linux-gnu", "arm64": "aarch64-linux-gnu", "armhf": "arm-linux-gnueabihf"}


def flatten(path, node, prefix=""):
    """(key, value, line) of every setting."""
    if not isinstance(node, yaml.MappingNode):
        raise BoardError(f"{path}:{node.start_mark.line + 1}: {prefix or 'the file'}: not a map (write \"key: value\" lines)")
    seen = set()
    for key_node, value_node in node.value:
        line = key_node.start_mark.line + 1
        if not isinstance(key_node, yaml.ScalarNode):
            raise BoardError(f"{path}:{line}: {prefix or 'the file'}: a key is not a name (write \"key: value\")")
        key = prefix + key_node.value
        if key in seen:
            raise BoardError(f"{path}:{line}: {key}: given twice (remove one)")
        seen.add(key)
        if key in GROUPS:
            yield from flatten(path, value_node, key + ".")
        elif key not in KEYS:
            known = ", ".join(k for k in list(KEYS) + GROUPS if k.startswith(prefix) and (prefix or "." not in k))
            raise BoardError(f"{path}:{line}: {key}: unknown key (known: {known})")
        else:
            yield key, yaml.SafeLoader.construct_object(LOADER, value_node, deep=True), line


LOADER = yaml.SafeLoader("")


def load(path):
    """The settings of a board's file, key -> value, checked."""
    shown = path.relative_to(ROOT) if path.is_relative_to(ROOT) else path
    try:
        node = yaml.compose(path.read_text(encoding="utf-8"), Loader=yaml.SafeLoader)
    except OSError as error:
        raise BoardError(f"{shown}: {error.strerror} (boards: {', '.join(names())})") from error
    except (yaml.YAMLError, UnicodeDecodeError) as error:
        mark = getattr(error, "problem_mark", None)
        raise BoardError(f"{shown}{':' + str(mark.line + 1) if mark else ''}: broken YAML: "
                         f"{getattr(error, 'problem', None) or error}") from error
    if node is None:
        raise BoardError(f"{shown}: the file: empty (boards/qemu-arm64/board.yaml is an example)")
    settings = {}
    lines = {}
    for key, value, line in flatten(shown, node):
        reason = KEYS[key][0](value)
        if reason:
            raise BoardError(f"{shown}:{line}: {key}: {reason}")
        settings[key] = value
        lines[key] = line
    needed = [key for key, (_, must) in KEYS.items() if must]
    if settings.get("deliver") == "image":
        needed += IMAGE_KEYS
    if settings.get("architecture") != "amd64":
        needed += ["cpu.emulate", "cpu.isa"]
    for key in needed:
        if key not in settings:
            raise BoardError(f"{shown}: {key}: missing (docs/boards.md says what it is)")
    if settings["cpu.flags"] and settings["architecture"] == "armhf" and "-mcpu" not in settings["cpu.flags"]:
        raise BoardError(f"{shown}:{lines['cpu.flags']}: cpu.flags: no -mcpu (32-bit Arm needs a processor with NEON named)")
    return settings


def names():
    return sorted(file.parent.name for file in (ROOT / "boards").glob("*/board.yaml"))


def of(name):
    if not re.fullmatch(r"[a-z0-9][a-z0-9_-]*", name):
        raise BoardError(f"{name!r} is no board's name (boards: {', '.join(names())})")
    settings = load(ROOT / "boards" / name / "board.yaml")
    for file in ("vehicle.yaml", "README.md"):
        if not (ROOT / "boards" / name / file).is_file():
            raise BoardError(f"boards/{name}/{file}: missing (every board has one)")
    return settings


def main(arguments):
    if arguments[:1] == ["check"]:
        for name in arguments[1:] or names():
            settings = load(pathlib.Path(name).resolve()) if "/" in name else of(name)
            print(f"{name}: {settings['title']}")
    elif arguments == ["list"]:
        print("\n".join(names()))
    elif len(arguments) == 3 and arguments[0] == "get" and (arguments[2] in KEYS or arguments[2] == "triplet"):
        settings = of(arguments[1])
        value = TRIPLETS[settings["architecture"]] if arguments[2] == "triplet" else settings.get(arguments[2], "")
        print("\n".join(value) if isinstance(value, list) else value)
    else:
        print(__doc__.strip(), file=sys.stderr)
        return 2
    return 0


if __name__ == "__main__":
    try:
        sys.exit(main(sys.argv[1:]))
    except BoardError as error:
        print(f"board: {error}", file=sys.stderr)
        sys.exit(1)
