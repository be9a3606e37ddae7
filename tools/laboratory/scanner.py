"""A scanner: `scantrove scan` of a demo in a loop."""
import json
import os
import re
import signal
import subprocess
import time

PROGRESS = re.compile(r"^(\d+)(?:/\d+)? frames")
LONGEST_END_S = 1200


class Scanner:
    """Scans `source` into `folder`; begins at once."""

    def __init__(self, program, source, folder, database, options):
        self.program, self.folder, self.database, self.options = program, folder, database, options
        self.name = folder.name
        self.logs = []
        self._begin(["scan", source, "--out", folder])

    def _begin(self, start):
        log = self.folder.parent / f"{self.name}-{len(self.logs) + 1}.log"
        self.logs.append(log)
        command = [self.program, *start, "--database", self.database, *self.options]
        self.began = time.monotonic()
        with open(log, "wb") as file:
            self.process = subprocess.Popen(command, env=environment(self.folder.parent), stdin=subprocess.DEVNULL,
                                            stdout=file, stderr=file)

    def frames(self):
        """Of the present process, as it says."""
        text = self.logs[-1].read_text(errors="replace")
        found = [PROGRESS.match(line) for line in text.splitlines()]
        return max((int(one[1]) for one in found if one), default=0)

    def kill(self):
        self.process.kill()
        self.process.wait()

    def resume(self, source):
        self._begin(["scan", source, "--resume", self.folder])

    def end(self):
        """Asks it to write its results. Result: its exit code; None: it did not end."""
        if self.process.poll() is None:
            self.process.send_signal(signal.SIGINT)
        return self.wait()

    def wait(self):
        try:
            return self.process.wait(LONGEST_END_S)
        except subprocess.TimeoutExpired:
            self.kill()
            return None

    def wait_with_usage(self):
        """(exit code, CPU seconds) of a scan that ends by itself."""
        _, status, usage = os.wait4(self.process.pid, 0)
        self.process.returncode = os.waitstatus_to_exitcode(status)
        return self.process.returncode, usage.ru_utime + usage.ru_stime

    def report(self):
        return json.loads((self.folder / "report.json").read_text(encoding="utf-8"))

    def messages(self):
        """Warnings and errors of its logs."""
        lines = []
        for log in self.logs:
            lines += [line for line in log.read_text(errors="replace").splitlines()
                      if re.search(r"\[(warning|error|critical)\]|^(error|warning)\b|terminate called", line, re.I)]
        return lines


def environment(work):
    """Temporary files and settings of the program stay below `work`. Compiled kernels are shared with other runs."""
    folders = {"TMPDIR": work / "tmp", "XDG_CONFIG_HOME": work / "config", "XDG_DATA_HOME": work / "data"}
    for folder in folders.values():
        folder.mkdir(exist_ok=True)
    return {**os.environ, **{name: str(folder) for name, folder in folders.items()}}
