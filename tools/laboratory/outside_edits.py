"""Renames, merges and deletions by the command line while scanners run."""
import random
import subprocess
import threading
import time


class OutsideEdits(threading.Thread):
    """Makes `count` edits within `seconds`. `done` lists each with what the program answered. `newest`: gives the ids of
    the newest visible objects, those that the scanners work with."""

    def __init__(self, program, database, newest, count, seconds, seed):
        super().__init__()
        self.program, self.database, self.newest = program, database, newest
        self.count, self.seconds, self.random = count, seconds, random.Random(seed)
        self.done, self.unreadable = [], 0
        self.is_stopped = threading.Event()

    def run(self):
        start = time.monotonic()
        for number in range(self.count):
            due = start + self.seconds * number / self.count
            if self.is_stopped.wait(max(0.0, due - time.monotonic())):
                return
            while not self.edit(number):
                self.unreadable += 1
                if self.is_stopped.wait(1):
                    return

    def edit(self, number):
        """False: the catalogue is empty, or the server is away."""
        try:
            objects = self.newest()
        except ValueError:
            objects = []
        if not objects:
            return False
        kind = self.random.choices(("rename", "merge", "delete"), (60, 20, 20))[0]
        if len(objects) < 4:
            kind = "rename"
        chosen = self.random.sample(objects, 2 if kind == "merge" else 1)
        name = f"thing {number}" if kind == "rename" else None
        command = [self.program, "objects", kind, *map(str, chosen), *([name] if name else []),
                   "--database", self.database, "--json"]
        answer = subprocess.run(command, capture_output=True, text=True, stdin=subprocess.DEVNULL, check=False)
        self.done.append({"kind": kind, "objects": chosen, "name": name, "is_done": answer.returncode == 0,
                          "answer": (answer.stderr or answer.stdout).strip()[-300:]})
        return True
