"""The programs under test: the scan of the command line, and the window under Xvfb."""
import json
import os
import re
import signal
import subprocess
from pathlib import Path

from soundness import run

LOOPS = 100000  # more than any run needs
PROGRESS = re.compile(r"^(\d+)(?:/(\d+))? frames.*?, (\d+) regions")
LONGEST_END_S = 300


class Scan:
    """`scantrove scan SOURCE --loop N`, which ends by Ctrl+C and writes its results."""

    name = "scan"

    def __init__(self, program, source, options, work):
        self.program, self.work = program, work
        self.folder = work / "scan"
        self.log_path = work / "scan.log"
        self.log = open(self.log_path, "wb")
        self.frames_per_loop = None
        command = [program, "scan", source, "--out", self.folder, "--loop", str(LOOPS), *options]
        self.process = subprocess.Popen(command, env=environment(work), stdin=subprocess.DEVNULL,
                                        stdout=self.log, stderr=self.log)

    def progress(self):
        """(frames, regions) so far; None: nothing yet."""
        with open(self.log_path, "rb") as file:
            file.seek(max(0, os.path.getsize(self.log_path) - 4096))
            lines = file.read().decode(errors="replace").splitlines()
        for line in reversed(lines):
            if found := PROGRESS.match(line):
                if found[2]:  # else the recording does not tell its length
                    self.frames_per_loop = max(1, int(found[2]) // LOOPS)
                return int(found[1]), int(found[3])
        return None

    def end(self):
        """Ends the program. Raises ValueError if it does not end as it should."""
        self.process.send_signal(signal.SIGINT)
        code = self.process.wait(LONGEST_END_S)
        self.log.close()
        if code != 0:
            raise ValueError(f"the scan ended with exit code {code}; see {self.log_path}")

    def results(self):
        return self.folder, self.folder / "catalogue.sqlite"


class Window:
    """The window with the same recording. SIGTERM ends it at any moment; the scan on disk must be sound then."""

    name = "window"

    def __init__(self, program, source, options, work, frames_per_loop):
        self.program, self.work = program, work
        self.frames_per_loop = frames_per_loop
        self.project = work / "project"
        run(program, "project", "create", self.project)
        self.log = open(work / "window.log", "wb")
        reading, writing = os.pipe()
        self.display = subprocess.Popen(
            ["Xvfb", "-displayfd", str(writing), "-screen", "0", "1400x900x24", "-nolisten", "tcp"],
            pass_fds=(writing,), stdout=self.log, stderr=self.log)
        os.close(writing)
        with os.fdopen(reading) as pipe:
            number = pipe.readline().strip()
        if not number:
            raise ValueError(f"Xvfb does not start; see {work / 'window.log'}")
        command = [program, "--project", self.project, "--loop", str(LOOPS), *options, source]
        self.process = subprocess.Popen(
            command, env={**environment(work), "DISPLAY": f":{number}", "LIBGL_ALWAYS_SOFTWARE": "1"},
            stdin=subprocess.DEVNULL, stdout=self.log, stderr=self.log)

    def scan(self):
        scans = json.loads(run(self.program, "project", "list", self.project, "--json"))
        return scans[0] if scans else None

    def progress(self):
        scan = self.scan()
        return (scan["frames"], scan["regions"]) if scan else None

    def end(self):
        self.process.send_signal(signal.SIGTERM)
        try:
            code = self.process.wait(LONGEST_END_S)
        finally:  # a window that hangs leaves no display behind
            self.display.terminate()
            self.display.wait(LONGEST_END_S)
            self.log.close()
        if code not in (0, -signal.SIGTERM):
            raise ValueError(f"the window ended with exit code {code}; see {self.work / 'window.log'}")

    def results(self):
        scan = self.scan()
        if not scan:
            raise ValueError("the window stored no scan")
        return Path(scan["path"]), self.project / "catalogue.sqlite"


def environment(work):
    """Temporary files, settings and data of the program stay below `work`."""
    folders = {"TMPDIR": work / "tmp", "XDG_CONFIG_HOME": work / "config", "XDG_DATA_HOME": work / "data"}
    for folder in folders.values():
        folder.mkdir(exist_ok=True)
    return {**os.environ, **{name: str(folder) for name, folder in folders.items()}}
