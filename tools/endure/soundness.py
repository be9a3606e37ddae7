"""Checks of what a scan left on disk."""
import json
import sqlite3
import subprocess
from pathlib import Path


def run(program, *arguments):
    """What a command of the program says. Raises ValueError if it fails."""
    done = subprocess.run([program, *map(str, arguments)], capture_output=True, text=True, check=False)
    if done.returncode != 0:
        raise ValueError(f"{' '.join(map(str, arguments))}: exit code {done.returncode}: {done.stderr.strip()[-400:]}")
    return done.stdout


def integrity(file):
    """Raises ValueError if a database is damaged."""
    try:
        database = sqlite3.connect(f"{file.absolute().as_uri()}?mode=ro", uri=True)
        try:
            found = [row[0] for row in database.execute("PRAGMA integrity_check(5)")]
            foreign = database.execute("PRAGMA foreign_key_check").fetchall()
        finally:
            database.close()
    except sqlite3.Error as error:
        raise ValueError(f"{file}: {error}") from error
    if found != ["ok"] or foreign:
        raise ValueError(f"{file}: {'; '.join(found)}, {len(foreign)} rows without their parents")


def check_results(program, scan, catalogue):
    """A list of checks of the scan's folder and its catalogue."""
    def objects():
        return f"{len(json.loads(run(program, 'objects', 'list', '--json', '--database', catalogue)))} objects"

    def databases():
        files = sorted({*Path(scan).glob("*.sqlite"), Path(catalogue)})
        for file in files:
            integrity(file)
        return f"{len(files)} databases are sound"

    def session():
        lines = run(program, "session", "show", scan).splitlines()
        return f"session show: {len(lines)} lines"

    checks = []
    for name, work in (("session", session), ("catalogue", objects), ("integrity", databases)):
        try:
            checks.append({"name": name, "result": "good", "text": work()})
        except (ValueError, OSError) as error:
            checks.append({"name": name, "result": "bad", "text": str(error)})
    return checks
