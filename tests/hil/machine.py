"""A board's image in a virtual machine: its console, a port on which the image for tests takes commands, power switch, sticks."""

import pathlib
import queue
import re
import shutil
import socket
import subprocess
import threading
import time
import json


class HilError(Exception):
    """What should have happened and did not."""


FIRMWARE = {
    "arm64": ("/usr/share/AAVMF/AAVMF_CODE.fd", "/usr/share/AAVMF/AAVMF_VARS.fd"),
    "amd64": ("/usr/share/OVMF/OVMF_CODE_4M.fd", "/usr/share/OVMF/OVMF_VARS_4M.fd"),
}


class Machine:
    """Started by start(), ended by power_off() or with the block. `folder` gets the disk, the console's log and the sockets."""

    def __init__(self, architecture, disk, folder, extra=()):
        self.architecture = architecture
        self.disk = pathlib.Path(disk)
        self.folder = pathlib.Path(folder)
        self.extra = list(extra)
        self.lines = queue.Queue()
        self.heard = []  # (seconds since the start, line)
        self.process = None
        self.variables = self.folder / "uefi-variables.fd"
        if not self.variables.exists():
            shutil.copyfile(FIRMWARE[architecture][1], self.variables)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.power_off()

    def _words(self):
        code = FIRMWARE[self.architecture][0]
        if self.architecture == "arm64":
            machine = ["qemu-system-aarch64", "-machine", "virt", "-cpu", "cortex-a72"]
        else:
            # Not with KVM: it is there on many machines, does not work on all of them, and the times would not be the same.
            # And not as a processor with AVX2: qemu 7.2 computes something else with it, which the self-test finds.
            machine = ["qemu-system-x86_64", "-machine", "q35", "-cpu", "Westmere"]
        return machine + [
            "-smp", "2", "-m", "512", "-nographic", "-nodefaults", "-serial", "stdio",
            "-drive", f"if=pflash,format=raw,readonly=on,file={code}", "-drive", f"if=pflash,format=raw,file={self.variables}",
            "-drive", f"if=virtio,format=raw,file={self.disk}", "-device", "i6300esb", "-action", "watchdog=reset",
            "-device", "virtio-serial-pci", "-chardev", f"socket,id=agent,path={self.folder}/agent.sock,server=on,wait=off",
            "-device", "virtserialport,chardev=agent,nr=1", "-device", "qemu-xhci,id=usb",
            "-qmp", f"unix:{self.folder}/qmp.sock,server=on,wait=off", *self.extra,
        ]

    def start(self):
        self.begin = time.monotonic()
        self.heard = []
        self.lines = queue.Queue()
        self.process = subprocess.Popen(self._words(), stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
        threading.Thread(target=self._listen, args=(self.process,), daemon=True).start()
        self.agent = self._connect("agent.sock")
        self.agent_rest = b""
        self.qmp = self._connect("qmp.sock")
        self.qmp_rest = b""
        self._qmp_line()
        self.qmp_command("qmp_capabilities")
        return self

    def _connect(self, name):
        path = self.folder / name
        for _ in range(200):
            try:
                connection = socket.socket(socket.AF_UNIX)
                connection.connect(str(path))
                return connection
            except OSError:
                time.sleep(0.05)
        raise HilError(f"the emulator does not start: {self.text()[-500:]}")

    def _listen(self, process):
        with open(self.folder / "console.log", "ab") as log:
            for raw in process.stdout:
                log.write(raw)
                log.flush()
                line = re.sub(r"\x1b\[[0-9;?=]*[A-Za-z]", "", raw.decode(errors="replace")).strip("\r\n\0")
                self.heard.append((time.monotonic() - self.begin, line))
                self.lines.put(line)

    def text(self):
        return "\n".join(line for _, line in self.heard)

    def wait_for(self, pattern, seconds, what=None):
        """The match of the first new line of the console that has the pattern, and how many seconds it took."""
        begin = time.monotonic()
        while True:
            left = begin + seconds - time.monotonic()
            try:
                line = self.lines.get(timeout=max(left, 0.001))
            except queue.Empty:
                last = "\n    ".join(line for _, line in self.heard[-12:])
                raise HilError(f"{what or pattern}: not within {seconds:.0f} s; the console's last lines:\n    {last}") from None
            match = re.search(pattern, line)
            if match:
                return match, time.monotonic() - begin

    def drain(self):
        while not self.lines.empty():
            self.lines.get()

    def run(self, command, seconds=30, check=True):
        """A command in the machine: (exit code, what it said). One line; the shell is busybox's."""
        self.agent.sendall(command.encode() + b"\n")
        self.agent.settimeout(seconds)
        said = self.agent_rest
        while True:
            match = re.search(rb"(?:^|\n)agent: exit (\d+)\n", said)
            if match:
                self.agent_rest = said[match.end():]
                code, text = int(match.group(1)), said[:match.start()].decode(errors="replace")
                break
            try:
                chunk = self.agent.recv(65536)
            except TimeoutError:
                raise HilError(f"{command}: no end within {seconds} s") from None
            if not chunk:
                raise HilError(f"{command}: the machine is gone")
            said += chunk
        if check and code != 0:
            raise HilError(f"{command}: exit code {code}: {text}")
        return code, text

    def _qmp_line(self):
        while b"\n" not in self.qmp_rest:
            self.qmp_rest += self.qmp.recv(65536)
        line, _, self.qmp_rest = self.qmp_rest.partition(b"\n")
        return json.loads(line)

    def qmp_command(self, name, **arguments):
        self.qmp.sendall(json.dumps({"execute": name, "arguments": arguments}).encode() + b"\n")
        while True:
            answer = self._qmp_line()
            if "error" in answer:
                raise HilError(f"{name}: {answer['error']['desc']}")
            if "return" in answer:
                return answer["return"]

    def plug_stick(self, file):
        self.qmp_command("human-monitor-command", **{"command-line": f"drive_add 0 if=none,id=stick,format=raw,file={file}"})
        self.qmp_command("device_add", driver="usb-storage", id="stick-device", drive="stick", bus="usb.0")

    def unplug_stick(self):
        self.qmp_command("device_del", id="stick-device")

    def power_off(self):
        """The plug is pulled."""
        if self.process is None:
            return
        self.process.kill()
        self.process.wait()
        for connection in (self.agent, self.qmp):
            connection.close()
        self.process = None
