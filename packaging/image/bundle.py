"""A signed update: a tar archive of the slot and a manifest, which is signed with signify (Ed25519).

Why not RAUC: what it adds to this (D-Bus, a service, X.509, HTTP streaming) costs a system of 10 MB more memory than the whole slot, and
its slot handling would still have to be told about systemd-boot's counters. Signature and hash are checked by tools that exist.
"""

import hashlib
import pathlib
import tarfile

from failure import ImageError, run


def public_key(secret):
    """The file beside a secret key that has its public half: KEY.sec, KEY.pub."""
    secret = pathlib.Path(secret)
    public = secret.with_suffix(".pub")
    for file in (secret, public):
        if not file.is_file():
            raise ImageError(f"--update-key: {file}: not there (./dev update-key {secret} makes both)")
        if not file.read_text(errors="replace").startswith("untrusted comment:"):
            raise ImageError(f"--update-key: {file}: no key of signify's (./dev update-key makes one)")
    return public


def build(file, *, slot, board, version, secret, when, work):
    data = slot.read_bytes()
    manifest = work / "manifest"
    manifest.write_text(f"format: 1\nboard: {board}\nversion: {version}\nsize: {len(data)}\n"
                        f"sha256: {hashlib.sha256(data).hexdigest()}\n")
    run(["signify-openbsd", "-S", "-e", "-s", secret, "-m", manifest, "-x", work / "manifest.sig"],
        hint="is it a secret key without a passphrase?")
    with tarfile.open(file, "w", format=tarfile.USTAR_FORMAT) as archive:
        for source, name in ((work / "manifest.sig", "manifest.sig"), (slot, "slot")):
            info = tarfile.TarInfo(name)
            info.size = source.stat().st_size
            info.mtime = when
            info.mode = 0o644
            with source.open("rb") as content:
                archive.addfile(info, content)
