"""The disk's image: partition table, boot partition (FAT), data partition (ext4). The same bytes for the same content."""

import os
import pathlib
import shutil
import uuid

from failure import run

MIB = 1024 * 1024
NAMESPACE = uuid.UUID("5b1c0d1e-6a55-4e4f-9d0a-3f0f6c1c7a10")
EFI_SYSTEM = "C12A7328-F81F-11D2-BA4B-00A0C93EC93B"
LINUX_DATA = "0FC63DAF-8483-4772-8E79-3D69D8477DE4"


def _id(board, what):
    """An identifier of the board's image: always the same one."""
    return str(uuid.uuid5(NAMESPACE, f"{board}/{what}"))


def fat(file, folder, *, mib, label, board, when):
    """`folder` as a FAT file system. Its file names must fit FAT."""
    serial = _id(board, label).replace("-", "")[:8]
    environment = dict(os.environ, SOURCE_DATE_EPOCH=str(when), TZ="UTC", MTOOLS_SKIP_CHECK="1", LC_ALL="C")
    pathlib.Path(file).unlink(missing_ok=True)
    run(["truncate", "--size", f"{mib}M", file])
    run(["mkfs.vfat", "--invariant", "-F", "32", "-S", "512", "-s", "1", "-n", label, "-i", serial, file], env=environment)
    for path in sorted(folder.rglob("*")):
        os.utime(path, (when, when))
    for path in sorted(folder.iterdir()):
        run(["mcopy", "-s", "-m", "-i", file, path, "::/"], env=environment)


def ext4(file, *, mib, label, board, when):
    """An empty ext4 file system: files that mkfs.ext4 copies in would carry the time of the build."""
    environment = dict(os.environ, E2FSPROGS_FAKE_TIME=str(when), SOURCE_DATE_EPOCH=str(when), TZ="UTC", LC_ALL="C")
    pathlib.Path(file).unlink(missing_ok=True)
    run(["mkfs.ext4", "-q", "-L", label, "-U", _id(board, label), "-E",
         f"hash_seed={_id(board, 'hash')},root_owner=0:0,lazy_itable_init=0,lazy_journal_init=0", file, f"{mib}M"], env=environment)


def assemble(file, *, board, table, boot, data, raw, work):
    """raw: (file, offset in bytes) of loaders that lie before the first partition, which then begins at 16 MiB."""
    for folder in ("genimage-root", "genimage-tmp", "genimage-in", "genimage-out"):
        shutil.rmtree(work / folder, ignore_errors=True)
        (work / folder).mkdir()
    for partition in (boot, data, *(source for source, _ in raw)):
        (work / "genimage-in" / pathlib.Path(partition).name).symlink_to(pathlib.Path(partition).resolve())
    start = "16M" if raw else "1M"
    parts = [f'  partition {pathlib.Path(source).stem} {{ image = "{pathlib.Path(source).name}" offset = {offset} in-partition-table = false }}'
             for source, offset in raw]
    if table == "gpt":
        parts.append(f'  partition lakshya-boot {{ image = "{boot.name}" offset = {start} partition-type-uuid = "{EFI_SYSTEM}" '
                     f'partition-uuid = "{_id(board, "boot")}" }}')
        parts.append(f'  partition lakshya-data {{ image = "{data.name}" partition-type-uuid = "{LINUX_DATA}" '
                     f'partition-uuid = "{_id(board, "data")}" }}')
        head = f'disk-uuid = "{_id(board, "disk")}"'
    else:
        parts.append(f'  partition lakshya-boot {{ image = "{boot.name}" offset = {start} partition-type = 0xC bootable = "true" }}')
        parts.append(f'  partition lakshya-data {{ image = "{data.name}" partition-type = 0x83 }}')
        head = f'disk-signature = 0x{_id(board, "disk")[:8]}'
    (work / "genimage.cfg").write_text(
        f"image {file.name} {{\n  hdimage {{ partition-table-type = {table} align = 1M {head} }}\n" + "\n".join(parts) + "\n}\n")
    run(["genimage", "--config", work / "genimage.cfg", "--rootpath", work / "genimage-root", "--tmppath", work / "genimage-tmp",
         "--inputpath", work / "genimage-in", "--outputpath", work / "genimage-out"])
    shutil.move(work / "genimage-out" / file.name, file)


def data_offset(file):
    """Where the data partition of an assembled image or disk begins, in bytes: the second one in its table."""
    with open(file, "rb") as source:
        head = source.read(34 * 512)
    if head[512:520] == b"EFI PART":
        return int.from_bytes(head[1024 + 128 + 32:1024 + 128 + 40], "little") * 512
    return int.from_bytes(head[446 + 16 + 8:446 + 16 + 12], "little") * 512
