"""A folder as the archive that the kernel unpacks into its memory: format newc, the same bytes for the same folder."""

import os
import pathlib
import stat

from failure import run


def _entry(number, name, mode, data=b"", device=(0, 0), when=0):
    head = f"070701{number:08x}{mode:08x}{0:08x}{0:08x}{1:08x}{when:08x}{len(data):08x}{0:08x}{0:08x}{device[0]:08x}{device[1]:08x}"
    head = head.encode() + f"{len(name) + 1:08x}{0:08x}{name}\0".encode()
    head += b"\0" * (-len(head) % 4)
    return head + data + b"\0" * (-len(data) % 4)


def pack(root, file, when):
    """Everything of `root`, owned by root, as of `when` (seconds since 1970), and /dev/console, which the kernel opens for init."""
    root = pathlib.Path(root)
    entries = [("dev", stat.S_IFDIR | 0o755, b"", (0, 0)), ("dev/console", stat.S_IFCHR | 0o600, b"", (5, 1))]
    for path in sorted(root.rglob("*"), key=lambda p: p.relative_to(root).as_posix()):
        name = path.relative_to(root).as_posix()
        if path.is_symlink():
            entries.append((name, stat.S_IFLNK | 0o777, os.readlink(path).encode(), (0, 0)))
        elif path.is_dir():
            entries.append((name, stat.S_IFDIR | 0o755, b"", (0, 0)))
        else:
            mode = 0o755 if path.stat().st_mode & stat.S_IXUSR else 0o644
            entries.append((name, stat.S_IFREG | mode, path.read_bytes(), (0, 0)))
    raw = pathlib.Path(file).with_suffix(".cpio")
    with raw.open("wb") as out:
        for number, (name, mode, data, device) in enumerate(entries, start=1):
            out.write(_entry(number, name, mode, data, device, when))
        out.write(_entry(0, "TRAILER!!!", 0))
    run(["zstd", "--quiet", "--force", "-19", "-T1", "--rm", raw, "-o", file])
    return pathlib.Path(file)
