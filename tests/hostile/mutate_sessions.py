#!/usr/bin/env python3
"""Damages copies of a small session at random and checks how the program handles them.

    mutate_sessions.py PROGRAM [--count N] [--seed S] [--verbose]

Each copy gets one change: flipped bits, truncated, emptied, removed or swapped files, changed, removed, doubled or
swapped rows. `session show`, `session regions` and `export` must end in time and without a signal; a result that is
not that of the sound session must come with a sentence on stderr, or an exit code. Prints a table; exit 1 if any
change was taken silently, crashed or hung. The same seed gives the same changes.
"""
import argparse
import collections
import hashlib
import json
import pathlib
import random
import re
import shutil
import sqlite3
import subprocess
import sys
import tempfile

LIMIT_S = 120
FORMATS = ["coco", "tum", "ply", "masks"]
DATE = re.compile(rb"\d{4}-\d\d-\d\dT\d\d:\d\d:\d\d[.\d]*Z")  # the date of a data set
# Commands that are run, but whose output is not compared.
NOT_RESULT = {"damages"}


def run(arguments):
    """Exit code (negative: a signal; None: it hung), stdout and messages about damage."""
    try:
        done = subprocess.run(arguments, stdin=subprocess.DEVNULL, capture_output=True, timeout=LIMIT_S)
    except subprocess.TimeoutExpired:
        return None, "", []
    messages = [line for line in done.stderr.decode(errors="replace").splitlines() if line.startswith("scantrove: ")]
    return done.returncode, done.stdout.decode(errors="replace"), said


def content_of(folder):
    files = {}
    for file in sorted(folder.rglob("*")):
        if file.is_file() and file.name != ".scantrove-export.json":  # has checksums of dated files
            content = DATE.sub(b"", file.read_bytes())
            files[str(file.relative_to(folder))] = hashlib.sha1(content).hexdigest()
    return files


class Results:
    """Outputs of the commands for a session."""

    def __init__(self, program, session, out, formats):
        self.commands = {}
        for what in ("show", "regions"):
            code, text, messages = run([program, "session", what, str(session), "--json"])
            try:
                result = json.loads(text)
                if isinstance(result, dict):
                    result = {key: value for key, value in result.items() if key not in NOT_RESULT}
            except ValueError:
                result = text
            self.commands[what] = (code, result, messages)
        for name in formats:
            folder = out / name
            code, _, messages = run([program, "export", str(session), "--format", name, "--out", str(folder)])
            self.commands["export " + name] = (code, content_of(folder) if folder.exists() else {}, messages)
            shutil.rmtree(folder, ignore_errors=True)


def verdict(sound, damaged):
    """The worst of the commands: crashed, hung, silent, reported, same."""
    order = ["same", "reported", "silent", "hung", "crashed"]
    worst, where = "same", ""
    for name, (code, result, messages) in damaged.commands.items():
        if code is None:
            one = "hung"
        elif code < 0 or code > 2:
            one = "crashed"
        elif code == 0 and result == sound.commands[name][1]:
            one = "same"
        else:
            one = "reported" if messages or code != 0 else "silent"
        if order.index(one) > order.index(worst):
            worst, where = one, name
    return worst, where


# --- Changes. Each returns a description, or None when there is nothing to change.


def files_of(session, kinds):
    return [file for file in sorted(session.rglob("*")) if file.is_file() and any(str(file).endswith(k) for k in kinds)]


DATABASE = ["session.sqlite"]
MAP = [".bricks"]
IMAGES = [".color.png", ".color.jpg", ".depth.png"]
ANY = DATABASE + MAP + IMAGES


def flip(chance, session, kinds):
    file = chance.choice(files_of(session, kinds))
    data = bytearray(file.read_bytes())
    bits = chance.choice([1, 1, 1, 8])
    places = [chance.randrange(len(data)) for _ in range(bits)]
    for place in places:
        data[place] ^= 1 << chance.randrange(8)
    file.write_bytes(data)
    return f"{bits} bits of {file.name} at {places[:3]}"


def truncate(chance, session):
    file = chance.choice(files_of(session, ANY))
    size = chance.randrange(file.stat().st_size)
    with open(file, "r+b") as stream:
        stream.truncate(size)
    return f"{file.name} cut to {size} bytes"


def blank(chance, session):
    file = chance.choice(files_of(session, ANY))
    data = bytearray(file.read_bytes())
    start = chance.randrange(len(data))
    length = min(chance.choice([16, 512, 4096]), len(data) - start)
    data[start:start + length] = bytes(length)
    file.write_bytes(data)
    return f"{length} bytes of {file.name} at {start} are 0"


def remove(chance, session):
    file = chance.choice(files_of(session, MAP + IMAGES))
    file.unlink()
    return f"{file.name} removed"


def swap_files(chance, session):
    kind = chance.choice([".color.png", ".color.jpg", ".depth.png"])
    files = files_of(session, [kind])
    if len(files) < 2:
        return None
    a, b = chance.sample(files, 2)
    first, second = a.read_bytes(), b.read_bytes()
    a.write_bytes(second)
    b.write_bytes(first)
    return f"{a.name} and {b.name} swapped"


ROW_TABLES = ["facts", "frames", "key_frames", "fragments", "regions", "borders", "operations", "pages", "recordings", "objectness", "mask_corrections", "frame_reviews"]


def some_row(chance, base):
    """A table with rows, and a WHERE clause for one of them."""
    tables = [t for t in ROW_TABLES if base.execute(f"SELECT count(*) FROM {t}").fetchone()[0] > 0]
    table = chance.choice(tables)
    keys = [row[1] for row in base.execute(f"PRAGMA table_info({table})") if row[5] > 0]
    rows = base.execute(f"SELECT {', '.join(keys)} FROM {table}").fetchall()
    row = chance.choice(sorted(rows))
    return table, " AND ".join(f"{key} = ?" for key in keys), row, keys


def changed(chance, value):
    if isinstance(value, int):
        return value + chance.choice([-1, 1, 1 << chance.randrange(20)])
    if isinstance(value, float):
        return value * chance.choice([1.01, 0.9]) + chance.choice([0, 0.05])
    if isinstance(value, bytes) and value:
        data = bytearray(value)
        data[chance.randrange(len(data))] ^= 1 << chance.randrange(8)
        return bytes(data)
    if isinstance(value, str) and value:
        place = chance.randrange(len(value))
        letter = value[place]
        other = str((int(letter) + 1) % 10) if letter.isdigit() else chr(ord(letter) ^ 1)
        return value[:place] + other + value[place + 1:]
    return value


def change_row(chance, session):
    with sqlite3.connect(session / "session.sqlite") as base:
        table, where, row, _ = some_row(chance, base)
        columns = [info[1] for info in base.execute(f"PRAGMA table_info({table})") if info[1] != "row_check"]
        column = chance.choice(columns)
        value = base.execute(f"SELECT {column} FROM {table} WHERE {where}", row).fetchone()[0]
        other = changed(chance, value)
        try:
            base.execute(f"UPDATE {table} SET {column} = ? WHERE {where}", (other, *row))
        except sqlite3.IntegrityError:
            return None
    return f"{table}.{column}: {str(value)[:30]!r} -> {str(other)[:30]!r}"


def delete_row(chance, session):
    with sqlite3.connect(session / "session.sqlite") as base:
        table, where, row, _ = some_row(chance, base)
        base.execute(f"DELETE FROM {table} WHERE {where}", row)
    return f"row {row} of {table} deleted"


def double_row(chance, session):
    with sqlite3.connect(session / "session.sqlite") as base:
        table, where, row, keys = some_row(chance, base)
        if not isinstance(row[0], int):
            return None
        columns = [info[1] for info in base.execute(f"PRAGMA table_info({table})")]
        values = list(base.execute(f"SELECT {', '.join(columns)} FROM {table} WHERE {where}", row).fetchone())
        values[columns.index(keys[0])] += 1000
        places = ", ".join("?" for _ in columns)
        base.execute(f"INSERT INTO {table} ({', '.join(columns)}) VALUES ({places})", values)
    return f"row {row} of {table} is there twice"


def swap_rows(chance, session):
    """Swaps the contents of two rows of a table; for pages, their records."""
    with sqlite3.connect(session / "session.sqlite") as base:
        table = chance.choice(["pages", "frames", "key_frames", "regions", "fragments"])
        info = base.execute(f"PRAGMA table_info({table})").fetchall()
        keys = [row[1] for row in info if row[5] > 0]
        others = [row[1] for row in info if row[5] == 0]
        rows = sorted(base.execute(f"SELECT {', '.join(keys)} FROM {table}").fetchall())
        if len(rows) < 2:
            return None
        a, b = chance.sample(rows, 2)
        where = " AND ".join(f"{key} = ?" for key in keys)
        first, second = (base.execute(f"SELECT {', '.join(others)} FROM {table} WHERE {where}", row).fetchone()
                         for row in (a, b))
        sets = ", ".join(f"{column} = ?" for column in others)
        base.execute(f"UPDATE {table} SET {sets} WHERE {where}", (*second, *a))
        base.execute(f"UPDATE {table} SET {sets} WHERE {where}", (*first, *b))
    return f"rows {a} and {b} of {table} swapped"


CHANGES = {
    "flipped bits, database": lambda chance, session: flip(chance, session, DATABASE),
    "flipped bits, map": lambda chance, session: flip(chance, session, MAP),
    "flipped bits, images": lambda chance, session: flip(chance, session, IMAGES),
    "truncated": truncate,
    "blanked": blank,
    "file removed": remove,
    "files swapped": swap_files,
    "row changed": change_row,
    "row deleted": delete_row,
    "row doubled": double_row,
    "rows swapped": swap_rows,
}
WEIGHTS = [4, 2, 2, 1, 1, 1, 1, 5, 2, 1, 2]


def make_session(program, folder):
    session = folder / "sound"
    settings = ["--set", "fusion.voxel_size_m=0.012", "--set", "fusion.working_width=160"]  # for speed
    for arguments in (["scan", "demo", "--frames", "24", "--out", str(session), *settings],):
        code, _, messages = run([program, *arguments])
        if code != 0:
            sys.exit("The session to damage cannot be made: " + " ".join(messages))
    code, text, _ = run([program, "session", "regions", str(session), "--json"])
    largest = sorted(json.loads(text), key=lambda region: -region["voxels"])
    numbers = [str(region["id"]) for region in largest]
    for arguments in (["name", str(session), "--region", numbers[2], "--name", "red mug", "--category", "cup"],
                      ["join", str(session), numbers[3], numbers[4]], ["background", str(session), numbers[0]]):
        if run([program, "session", *arguments])[0] != 0:
            sys.exit("The session to damage cannot be edited.")
    for name in ("trajectory.txt", "cloud.ply", "cloud.pcd", "labels.json", "report.json"):
        (session / name).unlink(missing_ok=True)
    return session


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program")
    parser.add_argument("--count", type=int, default=12)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--verbose", action="store_true")
    options = parser.parse_args()
    folder = pathlib.Path(tempfile.mkdtemp(prefix="scantrove-mutations-"))
    table = collections.defaultdict(collections.Counter)
    bad = 0
    try:
        session = make_session(options.program, folder)
        sound = Results(options.program, session, folder, FORMATS)
        if any(code != 0 for code, _, _ in sound.commands.values()):
            sys.exit("The sound session cannot be read: " + str({k: v[0] for k, v in sound.commands.items()}))
        for number in range(options.count):
            seed = options.seed + number
            chance = random.Random(seed)
            copy = folder / "copies" / session.name  # some results contain the name
            shutil.copytree(session, copy)
            kind = chance.choices(list(CHANGES), WEIGHTS)[0]
            done = CHANGES[kind](chance, copy)
            if done is not None:
                damaged = Results(options.program, copy, folder, [chance.choice(FORMATS)])
                outcome, where = verdict(sound, damaged)
                table[kind][outcome] += 1
                is_bad = outcome in ("silent", "crashed", "hung")
                bad += is_bad
                if is_bad or options.verbose:
                    print(f"{outcome.upper() if is_bad else outcome}: seed {seed}: {done}"
                          f"{': ' + where if where else ''}", flush=True)
            shutil.rmtree(copy)
    finally:
        shutil.rmtree(folder, ignore_errors=True)
    columns = ["same", "reported", "silent", "hung", "crashed"]
    print(f"{'change':26}" + "".join(f"{column:>9}" for column in columns))
    for kind in CHANGES:
        if kind in table:
            print(f"{kind:26}" + "".join(f"{table[kind][column]:9}" for column in columns))
    total = sum(table.values(), collections.Counter())
    print(f"{'all':26}" + "".join(f"{total[column]:9}" for column in columns))
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main())
