#!/usr/bin/env python3
"""Which shared libraries programs load, and what all of it weighs.

    elf_closure.py SYSROOT PROGRAM...                   the libraries' paths below SYSROOT, one a line
    elf_closure.py --limit MB SYSROOT PROGRAM...        a table of sizes as if stripped; exit code 1 above MB (the C library aside)

Exit code 1 also where a library is not in SYSROOT.
"""

import pathlib
import re
import subprocess
import sys

LIBC = re.compile(r"(libc|libm|libpthread|libdl|librt|ld-linux[a-z0-9_-]*)\.so\.\d+")


class ClosureError(Exception):
    """Message: FILE: REASON (WHAT TO DO)."""


def readelf(option, file):
    done = subprocess.run(["readelf", "--wide", option, str(file)], capture_output=True, text=True, check=False,
                          env={"LC_ALL": "C", "PATH": "/usr/bin:/bin"})
    if done.returncode != 0 or done.stderr:
        raise ClosureError(f"{file}: not a program or library ({done.stderr.strip().splitlines()[:1]})")
    return done.stdout


def needed(file):
    return re.findall(r"\(NEEDED\).*\[(.+)\]", readelf("-d", file))


def machine(file):
    return re.search(r"Machine:\s+(.+)", readelf("-h", file)).group(1)


def library_folders(sysroot):
    triplets = sorted(folder.name for folder in (sysroot / "usr/lib").glob("*-linux-gnu*"))
    return [sysroot / base / triplet for triplet in triplets for base in ("usr/lib", "lib")] + [sysroot / "usr/lib", sysroot / "lib"]


def find(name, wanted_machine, folders, needed_by):
    for folder in folders:
        file = folder / name
        if file.is_file() and machine(file) == wanted_machine:
            return file
    raise ClosureError(f"{needed_by}: needs {name}, which is not in the sysroot (add its package to what the sysroot has)")


def closure(sysroot, programs):
    """Name -> file of every library that the programs load, and those that these load."""
    sysroot = pathlib.Path(sysroot)
    folders = library_folders(sysroot)
    found = {}
    open_files = [pathlib.Path(program) for program in programs]
    while open_files:
        file = open_files.pop()
        for name in needed(file):
            if name not in found:
                found[name] = find(name, machine(file), folders, file)
                open_files.append(found[name])
    return found


def loaded_bytes(file):
    """Its size without symbols and debugging: of the sections that are loaded."""
    total = 0
    for line in readelf("-S", file).splitlines():
        match = re.match(r"\s*\[\s*\d+\]\s+(\S+)\s+(\S+)\s+[0-9a-f]+\s+[0-9a-f]+\s+([0-9a-f]+)\s+[0-9a-f]+\s+([A-Za-z]*)", line)
        if match and "A" in match.group(4) and match.group(2) != "NOBITS":
            total += int(match.group(3), 16)
    return total


def weigh(limit_mb, sysroot, programs):
    found = closure(sysroot, programs)
    total = 0
    for name, file in [(pathlib.Path(p).name, pathlib.Path(p)) for p in programs] + sorted(found.items()):
        size = loaded_bytes(file)
        counts = not LIBC.fullmatch(name)
        total += size if counts else 0
        print(f"{size / 1e6:8.2f} MB  {name}{'' if counts else '  (C library: not counted)'}")
    print(f"{total / 1e6:8.2f} MB  in all; at most {limit_mb:g} MB")
    return 0 if total <= limit_mb * 1e6 else 1


def main(arguments):
    if len(arguments) >= 4 and arguments[0] == "--limit":
        return weigh(float(arguments[1]), arguments[2], arguments[3:])
    if len(arguments) >= 2 and not arguments[0].startswith("-"):
        print("\n".join(str(file) for _, file in sorted(closure(arguments[0], arguments[1:]).items())))
        return 0
    print(__doc__.strip(), file=sys.stderr)
    return 2


if __name__ == "__main__":
    try:
        sys.exit(main(sys.argv[1:]))
    except ClosureError as error:
        print(f"elf_closure: {error}", file=sys.stderr)
        sys.exit(1)
