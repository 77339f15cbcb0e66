"""The kernel of an image, and the modules that its board names, with those that they need."""

import pathlib
import shutil

from failure import ImageError, run


class Kernel:
    """Of a kernel package: linux-image-arm64 stands for the present one."""

    def __init__(self, packages, name):
        real = next((n for n in packages.depends(name) if n.startswith("linux-image-")), name)
        self.package = real
        self.version = real.removeprefix("linux-image-").replace("-unsigned", "")
        self.folder = packages.unpacked(real)
        self.image = self.folder / "boot" / f"vmlinuz-{self.version}"
        if not self.image.is_file():
            raise ImageError(f"{real}: no /boot/vmlinuz-{self.version} in the package")

    def device_tree(self, name):
        file = self.folder / "usr/lib" / f"linux-image-{self.version}" / name
        if not file.is_file():
            raise ImageError(f"{self.package}: no device tree {name} (boot.device_tree in board.yaml)")
        return file

    def copy_modules(self, wanted, root):
        """The modules and what they need below root/lib/modules, with an index. Returns those that are built in."""
        source = self.folder / "lib/modules" / self.version
        if not (source / "modules.dep").is_file():
            run(["depmod", "-b", self.folder, self.version])
        built_in = {_name(line) for line in (source / "modules.builtin").read_text().split()}
        files = {}
        needs = {}
        for line in (source / "modules.dep").read_text().splitlines():
            file, _, others = line.partition(":")
            files[_name(file)] = file
            needs[_name(file)] = others.split()
        target = root / "lib/modules" / self.version
        target.mkdir(parents=True)
        missing = [name for name in wanted if name not in files and name not in built_in]
        if missing:
            raise ImageError(f"kernel.modules: {', '.join(missing)}: not in {self.package} (remove or rename it in board.yaml)")
        for name in wanted:
            if name in built_in:
                continue
            for file in [files[name], *needs[name]]:
                (target / file).parent.mkdir(parents=True, exist_ok=True)
                shutil.copyfile(source / file, target / file)
        for index in ("modules.order", "modules.builtin", "modules.builtin.modinfo"):
            shutil.copyfile(source / index, target / index)
        run(["depmod", "-b", root, self.version])
        for index in target.glob("modules.*"):  # busybox reads these alone
            if index.name not in ("modules.dep", "modules.alias", "modules.symbols"):
                index.unlink()
        return [name for name in wanted if name in built_in]


def _name(path):
    return pathlib.PurePath(path).name.split(".")[0].replace("-", "_")
