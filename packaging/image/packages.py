"""Debian packages for a board's processor: downloaded and checked by apt, unpacked without being installed."""

import os
import pathlib
import re
import subprocess
import time

from failure import ImageError, run

LISTS_ARE_FRESH_S = 24 * 3600


class Packages:
    """What was taken of Debian for one image. Everything lies below `folder` and is used again the next time."""

    def __init__(self, architecture, folder):
        self.architecture = architecture
        self.folder = pathlib.Path(folder).resolve()
        self.taken = {}  # name -> version
        for name in ("state/lists/partial", "cache/archives/partial", "unpacked"):
            (self.folder / name).mkdir(parents=True, exist_ok=True)
        (self.folder / "status").touch()
        # The sources and keys are those of the machine that builds; the list of what is installed is empty.
        (self.folder / "apt.conf").write_text(
            f'Dir::State "{self.folder}/state";\nDir::State::status "{self.folder}/status";\nDir::Cache "{self.folder}/cache";\n'
            f'#clear APT::Architectures;\nAPT::Architectures {{ "{architecture}"; }};\nAPT::Architecture "{architecture}";\n'
            'APT::Sandbox::User "root";\nAcquire::Languages "none";\nAcquire::Retries "2";\n'
        )
        self.environment = dict(os.environ, APT_CONFIG=str(self.folder / "apt.conf"), LC_ALL="C")
        lists = list((self.folder / "state/lists").glob("*Packages*"))
        if not lists or time.time() - max(file.stat().st_mtime for file in lists) > LISTS_ARE_FRESH_S:
            self._apt("update", "--quiet=2")

    def _apt(self, *words, folder=None):
        return run(["apt-get", *words], env=self.environment, cwd=folder,
                   hint="is there a network, and do apt's sources name Debian 12?")

    def _show(self, name):
        text = run(["apt-cache", "show", "--no-all-versions", name], env=self.environment,
                   hint=f"Debian 12 has no package {name} for {self.architecture}")
        return dict(re.findall(r"^(\S+): (.*)$", text, re.MULTILINE))

    def depends(self, name):
        """The first names of what a package depends on."""
        return re.findall(r"(?:^|, )([a-z0-9][a-z0-9+.-]+)", self._show(name).get("Depends", ""))

    def file(self, name):
        """The downloaded .deb; apt has checked it against the archive's signature."""
        fields = self._show(name)
        self.taken[name] = fields["Version"]
        version = fields["Version"].replace(":", "%3a")
        archives = self.folder / "cache/archives"
        for architecture in (self.architecture, "all"):
            file = archives / f"{name}_{version}_{architecture}.deb"
            if file.is_file():
                return file
        self._apt("download", "--quiet=2", f"{name}={fields['Version']}", folder=archives)
        for architecture in (self.architecture, "all"):
            file = archives / f"{name}_{version}_{architecture}.deb"
            if file.is_file():
                return file
        raise ImageError(f"{name}: apt-get download left no {name}_{version}_*.deb in {archives}")

    def unpacked(self, name):
        """The folder with the package's files."""
        file = self.file(name)
        folder = self.folder / "unpacked" / file.stem
        if not folder.is_dir():
            part = folder.with_suffix(".part")
            subprocess.run(["rm", "-rf", str(part)], check=True)
            part.mkdir()
            run(["dpkg-deb", "-x", str(file), str(part)], hint="delete the file, it is fetched again")
            part.rename(folder)
        return folder
