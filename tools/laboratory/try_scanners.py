"""Lets several scanners share one PostgreSQL catalogue while it is edited, and checks that nothing is lost. See README.md."""
import argparse
import hashlib
import json
import os
import sqlite3
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import agreement
import rates
from filling import fill
from outside_edits import OutsideEdits
from private_server import PrivateServer
from scanner import Scanner

DATABASE = "things"
BYTES = ("SELECT id, object, first_object, pose, {0}(color) AS color, {0}(mask) AS mask, {0}(depth_mm) AS depth_mm"
         " FROM views ORDER BY id",
         "SELECT view, {0}(fine) AS fine, {0}(colors) AS colors FROM descriptors ORDER BY view",
         "SELECT view, {0}(jpeg) AS jpeg FROM pictures ORDER BY view")
REPORT_IS_OLD_S = 3
RECONNECTED_S = 30  # after the start of the server at most


def arguments():
    parser = argparse.ArgumentParser(prog="try_scanners", description=__doc__)
    parser.add_argument("program", type=Path, help="the built program, for example build/release/app/scantrove")
    parser.add_argument("--minutes", type=float, default=10, help="how long the scanners run (default: 10)")
    parser.add_argument("--scanners", type=int, default=3, help="number of scanners (default: 3)")
    parser.add_argument("--edits", type=int, default=200, help="renames, merges and deletions (default: 200)")
    parser.add_argument("--objects", type=int, default=0, help="objects in the catalogue before (default: 0)")
    parser.add_argument("--pairs", type=int, default=3, help="pairs of scans that compare rates (default: 3; 0: none)")
    parser.add_argument("--frames", type=int, default=90, help="frames of a loop, and of a rate (default: 90)")
    parser.add_argument("--source", default="demo:room", help="the demo; scanners differ by the seed (default: demo:room)")
    parser.add_argument("--seed", type=int, default=1, help="of demos and edits (default: 1)")
    parser.add_argument("--refine", action="store_true", help="refine the scans when they end")
    parser.add_argument("--out", type=Path, required=True, help="new folder for logs, scans and the report")
    chosen = parser.parse_args()
    if chosen.minutes <= 0 or chosen.scanners < 2 or min(chosen.edits, chosen.frames) < 1:
        parser.error("--minutes, --edits and --frames must be above 0, --scanners above 1")
    if not os.access(chosen.program, os.X_OK):
        parser.error(f"{chosen.program} is no program")
    if chosen.out.exists() and any(chosen.out.iterdir()):
        parser.error(f"{chosen.out} is not empty")
    chosen.program, chosen.out = chosen.program.absolute(), chosen.out.absolute()
    chosen.out.mkdir(parents=True, exist_ok=True)
    return chosen


def call(program, *parts):
    done = subprocess.run([program, *map(str, parts)], capture_output=True, text=True, check=False)
    if done.returncode != 0:
        raise ValueError(f"{' '.join(map(str, parts))}: exit code {done.returncode}: {done.stderr.strip()[-400:]}")
    return done.stdout


def newest_objects(server):
    return [row["id"] for row in
            server.rows("SELECT id FROM objects WHERE hidden = 0 ORDER BY id DESC LIMIT 60", DATABASE)]


def scan_and_edit(chosen, sources, server, url):
    """Runs the scanners and the edits, kills a scanner and the server. Result: (scanners, edits, what happened)."""
    options = ["--loop", "1000", "--frames", str(chosen.frames), *([] if chosen.refine else ["--skip-refinement"])]
    work = chosen.out / "scanners"
    work.mkdir()
    scanners = [Scanner(chosen.program, source, work / f"scan{number + 1}", url, options)
                for number, source in enumerate(sources)]
    while not all(scanner.frames() > 0 for scanner in scanners):
        time.sleep(1)
        for scanner in scanners:
            if scanner.process.poll() is not None:
                raise ValueError(f"{scanner.name} ended before its first frame; see {scanner.logs[-1]}")
    story, start, seconds = [], time.monotonic(), 60 * chosen.minutes
    edits = OutsideEdits(chosen.program, url, lambda: newest_objects(server), chosen.edits, 0.95 * seconds, chosen.seed)
    edits.start()

    def note(text):
        story.append(f"{time.monotonic() - start:6.1f} s: {text}")
        print("  " + story[-1], flush=True)

    def wait(share):
        while time.monotonic() < start + share * seconds:
            time.sleep(0.5)
            for scanner in scanners:
                if scanner.process.poll() is not None:
                    raise ValueError(f"{scanner.name} ended by itself; see {scanner.logs[-1]}")
    try:
        wait(0.35)
        victim = scanners[1]
        note(f"{victim.name} is killed after {victim.frames()} frames, and continued")
        victim.kill()
        victim.resume(sources[1])
        wait(0.6)
        note("the server is killed")
        server.kill()
        wait(0.6 + min(0.05, 15 / seconds))
        server.start()
        note("the server runs again")
        wait(1)
        edits.is_stopped.set()
        edits.join()
        time.sleep(3)
        note("the scanners are asked to end after " +
             ", ".join(f"{scanner.frames()} frames" for scanner in scanners))
        for scanner in scanners:
            scanner.process.send_signal(2)
        codes = [scanner.wait() for scanner in scanners]
        note(f"exit codes {codes}")
    finally:
        edits.is_stopped.set()
        edits.join()
        for scanner in scanners:
            if scanner.process.poll() is None:
                scanner.kill()
    return scanners, edits, codes, story



def bytes_of_file(file):
    database = sqlite3.connect(f"{file.as_uri()}?mode=ro", uri=True)
    database.row_factory = sqlite3.Row
    database.create_function("md5", 1, lambda data: None if data is None else hashlib.md5(data).hexdigest())
    try:
        if [row[0] for row in database.execute("PRAGMA integrity_check")] != ["ok"]:
            raise ValueError(f"{file} is damaged")
        if database.execute("PRAGMA foreign_key_check").fetchall():
            raise ValueError(f"{file} has rows without their parents")
        return [[dict(row) for row in database.execute(select.format("md5"))] for select in BYTES]
    finally:
        database.close()


def bytes_on_server(server, database):
    return [server.rows(select.format("md5"), database) for select in BYTES]


def check_copies(chosen, server, url):
    file = chosen.out / "copy.sqlite"
    call(chosen.program, "objects", "copy", "--from", url, "--to", file)
    call(chosen.program, "objects", "copy", "--from", file, "--to", server.create("copied"))
    original = bytes_on_server(server, DATABASE)
    if bytes_of_file(file) != original:
        raise ValueError("the copy in a file has other views")
    if bytes_on_server(server, "copied") != original:
        raise ValueError("the copy of the copy has other views")
    return f"{len(original[0])} views, {len(original[1])} descriptors and {len(original[2])} pictures are equal, byte for byte"


def check_foreign_keys(server):
    keys = server.rows("""SELECT c.conrelid::regclass::text AS child, a.attname AS field, c.confrelid::regclass::text AS parent,
        b.attname AS key FROM pg_constraint c JOIN pg_attribute a ON a.attrelid = c.conrelid AND a.attnum = c.conkey[1]
        JOIN pg_attribute b ON b.attrelid = c.confrelid AND b.attnum = c.confkey[1] WHERE c.contype = 'f'""", DATABASE)
    if not keys:
        raise ValueError("the catalogue has no foreign keys")
    for key in keys:
        lost = server.sql("SELECT count(*) FROM {child} c WHERE {field} IS NOT NULL AND NOT EXISTS"
                          " (SELECT 1 FROM {parent} p WHERE p.{key} = c.{field})".format(**key), DATABASE)
        if lost != "0":
            raise ValueError(f"{lost} rows of {key['child']} have a {key['field']} that does not exist")
    views = server.rows("SELECT (SELECT count(*) FROM objects o WHERE hidden = 0 AND NOT EXISTS (SELECT 1 FROM views v"
                        " WHERE v.object = o.id)) AS empty, (SELECT count(*) FROM views v JOIN objects o ON o.id ="
                        " v.object WHERE o.merged_into IS NOT NULL) AS merged", DATABASE)[0]
    if views["empty"] or views["merged"]:
        raise ValueError(f"{views['empty']} visible objects have no views, {views['merged']} views belong to merged objects")
    return f"{len(keys)} keys hold, every visible object has views"


def check_reports(scanners, events):
    found, count = [], 0
    for scanner in scanners:
        ends = [event for event in events if event["action"] == "session-end" and event["source"] == scanner.source_name]
        if not ends:
            found.append(f"{scanner.name}: its session did not end")
            continue
        end = ends[-1]
        moments = [agreement.replay([one for one in events if one["id"] < end["id"]]),
                   agreement.replay([one for one in events if one["moment"] < end["moment"] - REPORT_IS_OLD_S])]
        reported = scanner.report()["objects"]
        count += len(reported)
        found += agreement.disagreements(scanner.name, reported, moments[::-1])
    return none_of(found, f"{count} objects of {len(scanners)} reports are as in the catalogue")


def none_of(found, good):
    if found:
        raise ValueError(f"{len(found)}: " + "; ".join(found[:5]))
    return good


def check_catalogue(chosen, server, url, scanners, edits, codes):
    """A list of checks."""
    events = server.rows("SELECT e.id, action, object, session, coalesce(after_json::json, '{}') AS after, s.source,"
                         " extract(epoch FROM e.created::timestamptz) AS moment FROM events e LEFT JOIN sessions s"
                         " ON s.id = e.session ORDER BY e.id", DATABASE)
    objects = server.rows("SELECT id, number, name, hidden, merged_into, confirmed, named_by_person FROM objects", DATABASE)
    sources = {row["id"]: row["source"] for row in server.rows("SELECT id, source FROM sessions ORDER BY id", DATABASE)}
    by_seed = {source.rsplit(" ", 1)[-1]: source for source in sources.values()}
    for number, scanner in enumerate(scanners):
        scanner.source_name = by_seed.get(str(chosen.seed + number))
    done = sum(edit["is_done"] for edit in edits.done)
    refused = len(edits.done) - done

    def ends():
        if any(code != 0 for code in codes):
            raise ValueError(f"exit codes {codes}")
        return "all scanners ended when asked"

    def views():
        added = sum(event["action"] == "add-view" for event in events)
        stored = int(server.sql("SELECT count(*) FROM views", DATABASE))
        if added != stored:
            raise ValueError(f"{stored} views are stored, {added} were added")
        return f"{stored} views"

    def read_in_time():
        renames = {event["after"]["name"]: event["id"] for event in events if event["action"] == "rename"}
        delays = agreement.delays(server.statements(), renames)
        begin, end = server.away[0] - 1, server.away[1] + RECONNECTED_S
        times = sorted(delay for moment, delay in delays if not begin <= moment <= end)
        if not times:
            raise ValueError("no scanner has read a rename")
        after = [delay for moment, delay in delays if begin <= moment <= end]
        text = (f"{len(times)} readings of renames: median {1000 * statistics.median(times):.0f} ms, 95 % within "
                f"{1000 * times[int(0.95 * (len(times) - 1))]:.0f} ms, all within {1000 * times[-1]:.0f} ms; after the "
                f"server was away {len(after)} within {max(after, default=0):.1f} s")
        if sum(one > 1 for one in times) > 0.05 * len(times):
            raise ValueError(text)
        return text

    checks = []
    for name, work in (
            ("ends", ends),
            ("edits", lambda: none_of(agreement.missing_edits(edits.done, events),
                                      f"{done} of {len(edits.done)} edits were done and are in the history, {refused} refused, "
                                      f"{edits.count - len(edits.done)} left, the server was not there {edits.unreadable} times")),
            ("history", lambda: none_of(agreement.differences(events, objects),
                                        f"{len(objects)} objects are as {len(events)} events tell")),
            ("objects", lambda: none_of([str(one) for one in agreement.lost_objects(events, objects)],
                                        "no object was lost")),
            ("views", views),
            ("reports", lambda: check_reports(scanners, events)),
            ("keys", lambda: check_foreign_keys(server)),
            ("renames", read_in_time),
            ("copies", lambda: check_copies(chosen, server, url))):
        try:
            checks.append((name, "good", work()))
        except (ValueError, OSError, KeyError) as error:
            checks.append((name, "bad", f"{type(error).__name__}: {error}" if isinstance(error, KeyError) else str(error)))
    return checks


def check_rates(pairs):
    fps, all_fps = rates.ratios(pairs, "fps")
    cpu, all_cpu = rates.ratios(pairs, "cpu_s")
    text = (f"server / file: frames per second {fps:.3f} ({', '.join(f'{one:.3f}' for one in all_fps)}), "
            f"CPU time of a frame {cpu:.3f} ({', '.join(f'{one:.3f}' for one in all_cpu)})")
    return ("rates", "good" if fps >= 0.95 else "bad", text)


def main():
    chosen = arguments()
    sources = [f"{chosen.source}:{chosen.seed + number}" for number in range(chosen.scanners)]
    # The path of a socket is limited to 107 bytes, and the server's user must reach it.
    with tempfile.TemporaryDirectory(prefix="scantrove-laboratory-") as temporary:
        os.chmod(temporary, 0o755)
        server = PrivateServer(Path(temporary) / "server")
        checks = []
        try:
            if chosen.pairs:
                print(f"{chosen.pairs} pairs of scans with a file and with the server:", flush=True)
                checks.append(check_rates(rates.compare(chosen.program, sources, chosen.out / "rates", server,
                                                        chosen.frames, chosen.pairs)))
            url = server.create(DATABASE)
            if chosen.objects:
                call(chosen.program, "objects", "list", "--database", url)  # creates the tables
                fill(server, DATABASE, chosen.objects, chosen.seed)
            print(f"{chosen.scanners} scanners for {chosen.minutes:g} minutes:", flush=True)
            server.log_statements(True)
            scanners, edits, codes, story = scan_and_edit(chosen, sources, server, url)
            server.log_statements(False)
            checks += check_catalogue(chosen, server, url, scanners, edits, codes)
        finally:
            server.stop()
    messages = [f"{scanner.name}: {line}" for scanner in scanners for line in scanner.messages()]
    lines = [f"  {result:<5} {name:<9} {text}" for name, result, text in checks]
    lines += [f"  {len(messages)} warnings of scanners" + (":" if messages else "")]
    lines += [f"    {line[:300]}" for line in messages[:20]]
    (chosen.out / "report.txt").write_text("\n".join([*story, *lines]) + "\n", encoding="utf-8")
    (chosen.out / "edits.json").write_text(json.dumps(edits.done, indent=1), encoding="utf-8")
    print("\n".join(lines))
    return 1 if any(result == "bad" for _, result, _ in checks) else 0


if __name__ == "__main__":
    sys.exit(main())
