#!/usr/bin/env python3
"""Names objects with difficult names, exports all formats, and reads them: export_and_check.py PROGRAM SOURCE

SOURCE is a scan (two copies of it become a project) or a project, which is copied. The program may write into the folder of
an export only, and leaves scans as they are.
"""

import argparse
import json
import os
import shutil
import subprocess
import sys
import tempfile
import zlib
from pathlib import Path

import check_data_sets  # ends here where numpy or OpenCV is missing

FORMATS = ("coco", "masks", "yolo", "voc", "labelstudio", "bop", "foundationpose", "boxes", "ply", "pcd", "mesh", "tum",
           "scannet")
DIFFICULT_NAMES = ("../../outside", "/tmp/scantrove-outside", 'say "it" \'twice\'', "two\nlines", "n" * 300, "ä" * 200, "..",
                   "back\\slash", "<b>&amp;</b>", "rgb mug", "Tasse 茶 🫖", "-rf", "$(touch outside)", "tab\there",
                   "' OR 1=1 --", "a: b, #c", "{x}", "CON")


class Program:
    def __init__(self, binary, folder):
        self.binary, self.folder = binary, folder
        self.environment = dict(os.environ, TMPDIR=str(folder / "temporary"))
        (folder / "temporary").mkdir()

    def run(self, *arguments, fails=False):
        run = subprocess.run([self.binary, *map(str, arguments)], capture_output=True, text=True, check=False,
                             cwd=self.folder, env=self.environment, errors="replace", stdin=subprocess.DEVNULL)
        if (run.returncode != 0) != fails:
            raise SystemExit(f"{arguments}: exit code {run.returncode}\n{run.stderr[-2000:]}")
        return run


def tree(folder, without):
    """Checksums of all files below a folder. SQLite's own files beside a database come and go."""
    found = {}
    for path in sorted(folder.rglob("*")):
        if without in path.parents or path == without or path.name.endswith(("-shm", "-wal")):
            continue
        found[str(path)] = None if path.is_dir() else zlib.crc32(path.read_bytes())
    return found


def make_project(program, source, project):
    if (source / "scans").is_dir():
        shutil.copytree(source, project)
        return
    program.run("project", "create", project)
    for name in ("first", 'second "half"'):
        shutil.copytree(source, project / "scans" / name)


def name_regions(program, project):
    """Gives difficult names and some classes to the objects of all scans; the number of names that are refused."""
    refused, names = 0, list(DIFFICULT_NAMES)
    for scan in sorted((project / "scans").iterdir()):
        regions = json.loads(program.run("session", "regions", scan, "--json").stdout)
        regions = regions["regions"] if isinstance(regions, dict) else regions
        objects = [one["id"] for one in regions if one["object"] is not None and not one["background"]]
        for place, region in enumerate(objects[: max(6, len(names))]):
            if not names:
                break
            arguments = ["session", "name", scan, "--region", region, f"--name={names[0]}"]
            if place % 3 == 0:
                arguments.append("--class=thing/odd: one" if place == 0 else "--class=plain")
            run = subprocess.run([program.binary, *map(str, arguments)], capture_output=True, text=True, check=False,
                                 cwd=program.folder, env=program.environment)
            if run.returncode not in (0, 1):
                raise SystemExit(f"{arguments}: exit code {run.returncode}\n{run.stderr}")
            if run.returncode == 1:
                print(f"refused: {names[0][:30]!r}: {run.stderr.strip()[:160]}")
                refused += 1
            names.pop(0)
    return refused, len(DIFFICULT_NAMES) - len(names)


def export_all(program, source, out):
    """Exports all formats to OUT/FORMAT, and twice COCO."""
    for name in (*FORMATS, "textured", "coco_again"):
        kind = {"textured": "mesh", "coco_again": "coco"}.get(name, name)
        options = ["--texture", "--texture-size", "1024"] if name == "textured" else []
        program.run("export", *source, "--format", kind, "--out", out / name, *options)


def check(binary, source, work, sets):
    """The worst exit code of the readers."""
    program = Program(binary, work)
    make_project(program, source, work / "project")
    refused, given = name_regions(program, work / "project")
    print(f"{given} difficult names, {refused} refused", flush=True)
    out = work / "out"
    out.mkdir()
    scans = sorted((work / "project/scans").iterdir())
    whole = ["--project", work / "project"]
    arguments = {
        "one": [scans[0]],
        "project": whole,
        "split": [*whole, f"--train={scans[0].name}", *(f"--val={scan.name}" for scan in scans[1:])],
    }
    before = tree(work, out)
    for name in sets:
        export_all(program, arguments[name], out / name)
    if tree(work, out) != before or Path("/tmp/scantrove-outside").exists():
        changed = dict(tree(work, out).items() ^ before.items())
        raise SystemExit(f"An export changed files outside of its folder: {sorted(changed)[:10]}")
    if sorted(path.name for path in out.iterdir()) != sorted(sets):
        raise SystemExit(f"There are other files beside the data sets: {list(out.iterdir())}")
    worst = 0
    for name in sets:
        print(f"== {name}", flush=True)
        command = [sys.executable, "-B", check_data_sets.__file__, out / name]
        worst = max(worst, subprocess.run(command, check=False).returncode)
    return worst


def main():
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("program", type=Path)
    parser.add_argument("source", type=Path)
    parser.add_argument("--keep", type=Path, help="a new folder that keeps the data sets")
    parser.add_argument("--sets", nargs="+", default=["one", "project", "split"], choices=["one", "project", "split"])
    options = parser.parse_args()
    arguments = (options.program.resolve(), options.source.resolve())
    if options.keep:
        options.keep.mkdir(parents=True)
        return check(*arguments, options.keep.resolve(), options.sets)
    with tempfile.TemporaryDirectory() as temporary:
        return check(*arguments, Path(temporary), options.sets)


if __name__ == "__main__":
    sys.exit(main())
