#!/usr/bin/env python3
"""Builds a board's image: out/BOARD/lakshya-VERSION-BOARD.img.zst, .bmap, .lku (signed update), .spdx.json, .sizes.txt.

    build.py BOARD --firmware-program LAKSHYAD --sysroot DIR [--rt] [--update-key FILE]

Called by ./dev image, which builds the program first. Exit code 1: WHAT: REASON (WHAT TO DO), and nothing is left in out/BOARD.
"""

import argparse
import os
import pathlib
import re
import shutil
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
sys.path.insert(0, str(ROOT / "packaging"))

import board  # noqa: E402
import bundle  # noqa: E402
import disk  # noqa: E402
import elf_closure  # noqa: E402
import initramfs  # noqa: E402
import sbom  # noqa: E402
import uki  # noqa: E402
from failure import ImageError, run  # noqa: E402
from kernel import Kernel  # noqa: E402
from packages import Packages  # noqa: E402

EFI_NAMES = {"arm64": "aa64", "amd64": "x64"}


def say(text):
    print(f"image: {text}", file=sys.stderr, flush=True)


def version_and_time():
    """0.1.0.COMMITS, and the last commit's time: the same for the same sources, and greater for later ones."""
    project = re.search(r"project\(lakshya VERSION ([0-9.]+)", (ROOT / "CMakeLists.txt").read_text()).group(1)
    count = run(["git", "-C", ROOT, "rev-list", "--count", "HEAD"], hint="images are built from a git checkout").strip()
    when = int(os.environ.get("SOURCE_DATE_EPOCH") or run(["git", "-C", ROOT, "log", "-1", "--format=%ct"]))
    return f"{project}.{count}", when


def copy_program(source, root, sysroot, strip, name):
    """A program with the libraries that it loads, all stripped."""
    target = root / "usr/bin" / name
    target.parent.mkdir(parents=True, exist_ok=True)
    run([strip, "-o", target, source])
    target.chmod(0o755)
    for library, file in elf_closure.closure(sysroot, [source]).items():
        # The loader's path is part of every program; the others are found in /lib.
        place = root / "lib" / library
        place.parent.mkdir(parents=True, exist_ok=True)
        if not place.exists():
            run([strip, "-o", place, file.resolve()])
            place.chmod(0o755)


def build_root(root, settings, packages, kernel, version, options):
    shutil.copytree(ROOT / "packaging/rootfs", root)
    prefix = board.TRIPLETS[settings["architecture"]] + "-"
    busybox = root / "bin/busybox"
    busybox.parent.mkdir()
    shutil.copyfile(packages.unpacked("busybox-static") / "bin/busybox", busybox)
    busybox.chmod(0o755)
    (root / "bin/sh").symlink_to("busybox")
    (root / "sbin").symlink_to("bin")
    if settings["architecture"] == "amd64":
        (root / "lib64").symlink_to("lib")
    copy_program(options.firmware_program, root, options.sysroot, prefix + "strip", "lakshyad")
    etc = root / "etc/lakshya"
    etc.mkdir(parents=True)
    if options.update_key:
        # signify's libraries come from its packages: what runs on the machine that builds knows no sysroot of them.
        merged = packages.folder / "merged"
        shutil.rmtree(merged, ignore_errors=True)
        for name in ("signify-openbsd", "libbsd0", "libmd0", "libc6"):
            shutil.copytree(packages.unpacked(name), merged, symlinks=True, dirs_exist_ok=True)
        copy_program(merged / "bin/signify-openbsd", root, merged, prefix + "strip", "signify-openbsd")
        shutil.copyfile(bundle.public_key(options.update_key), etc / "update.pub")
    built_in = kernel.copy_modules(settings["kernel.modules"] + [settings["watchdog.module"]], root)
    loaded = [name for name in settings["kernel.modules"] + [settings["watchdog.module"]] if name not in built_in]
    (etc / "modules").write_text("".join(f"{name}\n" for name in loaded))
    (etc / "board").write_text(options.board + "\n")
    (etc / "version").write_text(version + "\n")
    (etc / "loader").write_text(settings["boot.loader"] + "\n")
    if options.overlay:
        shutil.copytree(options.overlay, root, symlinks=True, dirs_exist_ok=True)
    boards = root / "usr/share/lakshya/boards"
    for name in {"host", options.board}:
        (boards / name).mkdir(parents=True)
        shutil.copyfile(ROOT / "boards" / name / "vehicle.yaml", boards / name / "vehicle.yaml")


def command_line(settings, slot):
    words = [f"console={settings['boot.console']}", "quiet", "loglevel=3", "panic=5", f"lakshya.slot={slot}",
             settings.get("kernel.options", "")]
    return " ".join(word for word in words if word)


def boot_for_systemd_boot(folder, settings, packages, slot, version):
    efi = EFI_NAMES[settings["architecture"]]
    loader = packages.unpacked(settings["boot.package"]) / f"usr/lib/systemd/boot/efi/systemd-boot{efi}.efi"
    for name in ("EFI/BOOT", "loader/entries", "lakshya"):
        (folder / name).mkdir(parents=True)
    shutil.copyfile(loader, folder / "EFI/BOOT" / f"BOOT{efi.upper()}.EFI")
    (folder / "loader/loader.conf").write_text("timeout 0\neditor no\nauto-entries no\nauto-firmware no\n")
    (folder / "loader/entries/lakshya-a.conf").write_text(
        f"title Lakshya {version}, slot a\nsort-key lakshya\nversion 1\nefi /lakshya/a.efi\noptions {command_line(settings, 'a')}\n")
    shutil.copyfile(slot, folder / "lakshya/a.efi")


def sizes(files, root):
    """Lines for people: the delivered files, and what the slot's memory is made of."""
    lines = [f"{file.stat().st_size / 1e6:9.2f} MB  {file.name}" for file in files]
    parts = {}
    for file in root.rglob("*"):
        if file.is_file() and not file.is_symlink():
            top = file.relative_to(root).as_posix()
            part = "kernel modules" if top.startswith("lib/modules") else "libraries" if top.startswith("lib/") else top
            if file.stat().st_size < 20000 and part not in ("kernel modules", "libraries"):
                part = "scripts and settings"
            parts[part] = parts.get(part, 0) + file.stat().st_size
    lines += ["", "in the initramfs, unpacked:"]
    lines += [f"{size / 1e6:9.2f} MB  {part}" for part, size in sorted(parts.items(), key=lambda item: -item[1])]
    return "\n".join(lines) + "\n"


def check(options):
    """The board's settings. ImageError for whatever can be known before anything is fetched or removed."""
    settings = board.of(options.board)
    if settings.get("boot.loader") != "systemd-boot":
        raise ImageError(f"{options.board}: boot.loader {settings.get('boot.loader', 'is not given')}: images with it cannot be built yet "
                         "(boards with systemd-boot: docs/image.md)")
    if options.rt and "kernel.rt_package" not in settings:
        raise ImageError(f"--rt: boards/{options.board}/board.yaml names no kernel.rt_package")
    if options.update_key:
        bundle.public_key(options.update_key)
    if options.overlay and not os.path.isdir(options.overlay):
        raise ImageError(f"--overlay: {options.overlay}: no folder")
    if options.version and not re.fullmatch(r"[0-9]+(\.[0-9]+)*", options.version):
        raise ImageError(f"--version: {options.version} is not numbers with dots between")
    return settings


def build(options, settings, work, out):
    version, when = version_and_time()
    version = options.version or version
    name = f"lakshya-{version}-{options.board}"
    say(f"{name}: Debian's packages for {settings['architecture']}")
    packages = Packages(settings["architecture"], ROOT / "build/packages" / settings["architecture"])
    package = settings["kernel.rt_package"] if options.rt else settings["kernel.package"]
    kernel = Kernel(packages, package)
    say(f"kernel {kernel.version}")
    root = work / "root"
    build_root(root, settings, packages, kernel, version, options)
    memory = initramfs.pack(root, work / "initramfs.zst", when)
    efi = EFI_NAMES[settings["architecture"]]
    slot = work / "slot"
    uki.build(slot, prefix=board.TRIPLETS[settings["architecture"]] + "-",
              stub=packages.unpacked(settings["boot.package"]) / f"usr/lib/systemd/boot/efi/linux{efi}.efi.stub",
              kernel=kernel.image, initramfs=memory, command_line=command_line(settings, "a"),
              os_release=f"ID=lakshya\nNAME=Lakshya\nVERSION_ID={version}\nPRETTY_NAME=\"Lakshya {version}\"\n", work=work)
    boot_for_systemd_boot(work / "boot", settings, packages, slot, version)
    say("partitions")
    disk.fat(work / "boot.vfat", work / "boot", mib=settings["image.boot_mib"], label="LAKSHYA", board=options.board, when=when)
    disk.ext4(work / "data.ext4", mib=settings["image.data_mib"], label="LAKSHYA-DATA", board=options.board, when=when)
    image = work / f"{name}.img"
    disk.assemble(image, board=options.board, table=settings["image.table"], boot=work / "boot.vfat", data=work / "data.ext4",
                  raw=[], work=work)
    say("map of blocks, compression")
    made = work / "made"
    made.mkdir()
    run(["bmaptool", "create", "-o", made / f"{name}.bmap", image])
    run(["zstd", "--quiet", "--force", "-10", "-T1", image, "-o", made / f"{name}.img.zst"])
    if options.update_key:
        bundle.build(made / f"{name}.lku", slot=slot, board=options.board, version=version, secret=options.update_key, when=when,
                     work=work)
    else:
        say("no --update-key: the image takes no updates, and there is no bundle")
    sbom.write(made / f"{name}.spdx.json", board=options.board, version=version, when=when, packages=packages,
               own_licence="Apache-2.0")
    report = sizes([*sorted(made.iterdir()), slot, memory, kernel.image], root)
    (made / f"{name}.sizes.txt").write_text(report)
    shutil.rmtree(out, ignore_errors=True)
    out.parent.mkdir(parents=True, exist_ok=True)
    shutil.move(made, out)
    print(report, end="")
    say(f"{os.path.relpath(out)}/{name}.img.zst")


def main():
    parser = argparse.ArgumentParser(prog="./dev image", description="Builds a board's image into out/BOARD.")
    parser.add_argument("board", help="a folder of boards/")
    parser.add_argument("--rt", action="store_true", help="the kernel with PREEMPT_RT")
    parser.add_argument("--update-key", metavar="FILE", help="secret key that signs the update; KEY.pub beside it goes into the image")
    parser.add_argument("--overlay", metavar="DIR", help="files of your own for the slot; usr/lib/lakshya/start.d/* are started")
    parser.add_argument("--version", help="instead of the sources' own")
    parser.add_argument("--out", metavar="DIR", help="instead of out/BOARD")
    parser.add_argument("--firmware-program", required=True, help=argparse.SUPPRESS)
    parser.add_argument("--sysroot", required=True, help=argparse.SUPPRESS)
    options = parser.parse_args()
    out = pathlib.Path(options.out).resolve() if options.out else ROOT / "out" / options.board
    try:
        settings = check(options)
        work = ROOT / "build/image" / options.board
        shutil.rmtree(work, ignore_errors=True)
        work.mkdir(parents=True)
        build(options, settings, work, out)
    except (ImageError, board.BoardError, elf_closure.ClosureError) as error:
        print(f"image: {error}", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
