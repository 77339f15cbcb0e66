"""A slot for UEFI: kernel, initramfs and command line in one EFI program (a "unified kernel image", systemd-stub(7))."""

import pathlib
import re
import struct

from failure import ImageError, run

ALIGNMENT = 0x10000  # of sections: the largest page of any processor


def _end_of_image(objdump, stub):
    """ImageBase, and the first address behind the stub's sections."""
    base = int(re.search(r"ImageBase\s+([0-9a-fA-F]+)", run([objdump, "-p", stub])).group(1), 16)
    ends = [int(m.group(2), 16) + int(m.group(1), 16)
            for m in re.finditer(r"^\s*\d+ \S+\s+([0-9a-f]{8})\s+([0-9a-f]{8,16})\s", run([objdump, "-h", stub]), re.MULTILINE)]
    if not ends:
        raise ImageError(f"{stub}: no EFI program")
    return base, max(ends)


def _normalise(file):
    """Takes out what differs from one build to the next: the header's time, and the checksum, which nothing reads."""
    data = bytearray(file.read_bytes())
    header = struct.unpack_from("<I", data, 0x3C)[0]
    if data[header:header + 4] != b"PE\0\0":
        raise ImageError(f"{file}: no EFI program")
    struct.pack_into("<I", data, header + 8, 0)
    struct.pack_into("<I", data, header + 24 + 64, 0)
    file.write_bytes(data)


def build(file, *, prefix, stub, kernel, initramfs, command_line, os_release, work):
    """prefix: of the binutils, "aarch64-linux-gnu-"; the texts are strings, the rest files."""
    objcopy, objdump = prefix + "objcopy", prefix + "objdump"
    base, address = _end_of_image(objdump, stub)
    texts = {}
    for name, text in (("osrel", os_release), ("cmdline", command_line + "\0")):
        texts[name] = work / name
        texts[name].write_text(text)
    words = [objcopy]
    for section, content in ((".osrel", texts["osrel"]), (".cmdline", texts["cmdline"]), (".linux", kernel),
                             (".initrd", initramfs)):
        address = max(address, base)
        address += -address % ALIGNMENT
        words += ["--add-section", f"{section}={content}", "--change-section-vma", f"{section}={address:#x}"]
        address += pathlib.Path(content).stat().st_size
    run([*words, stub, file])
    _normalise(file)
