"""A PostgreSQL server of its own in a new folder, reached by a UNIX socket there."""
import calendar
import csv
import json
import os
import pwd
import signal
import subprocess
import time
from pathlib import Path

USER = "scantrove"


def programs():
    """The newest installed version's folder. Raises ValueError if there is none."""
    found = [path.parent for path in Path("/usr/lib/postgresql").glob("*/bin/initdb")]
    if not found:
        raise ValueError("PostgreSQL is not installed (Debian: postgresql)")
    return max(found, key=lambda path: int(path.parent.name))


class PrivateServer:
    """Runs as the user `postgres` where this runs as root, which PostgreSQL refuses."""

    def __init__(self, folder):
        self.folder, self.data, self.bin = folder, folder / "data", programs()
        self.away = None  # from and until when, after kill() and start()
        self.folder.mkdir()
        self.as_other = []
        if os.geteuid() == 0:
            other = pwd.getpwnam("postgres")
            os.chown(self.folder, other.pw_uid, other.pw_gid)
            self.as_other = ["setpriv", f"--reuid={other.pw_uid}", f"--regid={other.pw_gid}", "--clear-groups", "--"]
        self._run("initdb", "-D", self.data, "-A", "trust", "-U", USER, "-E", "UTF8", "--locale=C")
        self.start()

    def _run(self, name, *arguments):
        with open(self.folder.parent / "server-commands.log", "ab") as log:
            done = subprocess.run([*self.as_other, self.bin / name, *map(str, arguments)], stdin=subprocess.DEVNULL,
                                  stdout=log, stderr=log, cwd="/", check=False)
        if done.returncode != 0:
            raise ValueError(f"{name} failed with exit code {done.returncode}; see {log.name}")

    def start(self):
        options = (f"-k {self.folder} -c listen_addresses='' -c logging_collector=on -c log_destination=csvlog"
                   " -c log_timezone=UTC -c log_rotation_size=0 -c log_filename=server.log -c log_truncate_on_rotation=off")
        for attempt in range(40):  # the shared memory of a killed server may still be in use
            try:
                self._run("pg_ctl", "-D", self.data, "-w", "-l", self.data / "start.log", "-o", options, "start")
                self.away = self.away and (self.away[0], time.time())
                return
            except ValueError:
                if attempt == 39:
                    raise
                time.sleep(0.25)

    def kill(self):
        """As a power cut ends it: all its processes at once."""
        self.away = (time.time(), None)
        server = int((self.data / "postmaster.pid").read_text().split()[0])
        children = children_of(server)
        os.kill(server, signal.SIGKILL)
        for child in children:
            try:
                os.kill(child, signal.SIGKILL)
            except ProcessLookupError:
                pass
        for name in (self.data / "postmaster.pid", self.folder / ".s.PGSQL.5432.lock", self.folder / ".s.PGSQL.5432"):
            name.unlink(missing_ok=True)

    def stop(self):
        self._run("pg_ctl", "-D", self.data, "-w", "-m", "fast", "stop")

    def create(self, database):
        """Result: the address of the new database."""
        self.sql(f"CREATE DATABASE {database}", "postgres")
        return f"postgresql:///{database}?host={self.folder}&user={USER}"

    def sql(self, text, database):
        done = subprocess.run([self.bin / "psql", "-AtXq", "-v", "ON_ERROR_STOP=1", "-h", self.folder, "-U", USER,
                               "-d", database], input=text, capture_output=True, text=True, check=False)
        if done.returncode != 0:
            raise ValueError(f"psql: {done.stderr.strip()[-400:]}")
        return done.stdout.strip()

    def rows(self, select, database):
        """The rows of a SELECT as a list of dictionaries."""
        return json.loads(self.sql(f"SELECT coalesce(json_agg(rows), '[]') FROM ({select}) rows", database))

    def log_statements(self, is_on):
        self.sql(f"ALTER SYSTEM SET log_min_duration_statement = {0 if is_on else -1}", "postgres")
        self.sql("SELECT pg_reload_conf()", "postgres")

    def statements(self):
        """(time, process, statement) of each statement, when it had ended."""
        csv.field_size_limit(1 << 30)
        for name in sorted((self.data / "log").glob("*.csv")):
            with open(name, newline="", encoding="utf-8", errors="replace") as file:
                for row in csv.reader(file):
                    if len(row) > 13 and row[13].startswith("duration: "):
                        yield seconds_of(row[0]), int(row[3]), row[13].partition("statement: ")[2]


def seconds_of(text):
    """Since 1970, of "2026-11-30 22:00:00.123 UTC"."""
    day, moment, *_ = text.split()
    hours, minutes, seconds = moment.split(":")
    return calendar.timegm(time.strptime(day, "%Y-%m-%d")) + 3600 * int(hours) + 60 * int(minutes) + float(seconds)


def children_of(parent):
    children = []
    for process in Path("/proc").glob("[0-9]*"):
        try:
            rest = (process / "stat").read_text(errors="replace").rpartition(")")[2].split()
        except OSError:
            continue
        if int(rest[1]) == parent:
            children.append(int(process.name))
    return children
