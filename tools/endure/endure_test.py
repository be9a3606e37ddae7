"""Tests of the judgment and of the whole command, with a stand-in for the program."""
import json
import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path
from xml.dom import minidom

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE))
sys.dont_write_bytecode = True

from judgment import judge  # noqa: E402
from svg_plot import plot  # noqa: E402

STAND_IN = '''#!/usr/bin/env python3
import os, signal, sqlite3, sys, time
words = sys.argv[1:]
if words[0] == "scan":
    folder = words[words.index("--out") + 1]
    loops, frames = (int(words[words.index(name) + 1]) for name in ("--loop", "--frames"))
    os.makedirs(folder)
    ended = []
    signal.signal(signal.SIGINT, lambda *_: ended.append(1))
    done = 0
    while not ended:
        done += 2
        print(f"{done}/{loops * frames} frames (0 %), 9.5 fps, tracking, 12 regions", file=sys.stderr, flush=True)
        time.sleep(0.02)
    sqlite3.connect(folder + "/catalogue.sqlite").execute("CREATE TABLE objects (id)")
elif words[0] == "objects":
    print("[]")
elif words[0] == "session":
    print("session")
'''


def made(count, **slopes):
    """Samples, one a second, ten frames each; `slopes`: what a key grows by in each."""
    start = {"memory_mb": 500.0, "threads": 9, "descriptors": 40, "temporary_files": 1}
    return [{"seconds": i, "frames": 10 * i, "regions": 5,
             **{key: value + slopes.get(key, 0) * i for key, value in start.items()}} for i in range(count)]


def bad(checks):
    return [check["name"] for check in checks if check["result"] == "bad"]


class Judgment(unittest.TestCase):
    def test_finds_nothing_in_a_steady_run(self):
        self.assertEqual([check["result"] for check in judge(made(100), 100)], ["good"] * 5)

    def test_finds_memory_that_grows(self):
        # 80 samples after the second loop: their first and last thirds are 54 samples apart. 0.1 MB each are
        # 5.4 MB of 502 MB, 1.07 %; half of that is sound.
        self.assertEqual(bad(judge(made(100, memory_mb=0.1), 100)), ["memory"])
        self.assertEqual(bad(judge(made(100, memory_mb=0.05), 100)), [])

    def test_finds_descriptors_threads_and_files_that_stay_open(self):
        self.assertEqual(bad(judge(made(100, descriptors=1, threads=1, temporary_files=1), 100)),
                         ["descriptors", "threads", "temporary files"])

    def test_finds_a_rate_that_falls(self):
        samples = made(100)
        for i, sample in enumerate(samples):
            sample["seconds"] = i if i < 60 else 60 + (i - 60) * 1.1
        self.assertEqual(bad(judge(samples, 100)), ["rate"])

    def test_does_not_judge_a_short_run(self):
        self.assertEqual({check["result"] for check in judge(made(30), 100)}, {"not judged"})


class Plot(unittest.TestCase):
    def test_is_xml_with_a_point_for_each_sample(self):
        svg = minidom.parseString(plot("a < b", made(7), (("memory_mb", "memory"), ("fps", "rate"))))
        lines = svg.getElementsByTagName("polyline")
        self.assertEqual(len(lines), 1)  # no sample has a rate
        self.assertEqual(len(lines[0].getAttribute("points").split()), 7)


class Command(unittest.TestCase):
    def test_runs_a_scan_and_writes_its_reports(self):
        with tempfile.TemporaryDirectory() as name:
            folder = Path(name)
            program = folder / "scantrove"
            program.write_text(STAND_IN, encoding="utf-8")
            os.chmod(program, 0o755)
            done = subprocess.run(
                [HERE / "endure", program, "demo", "--subject", "scan", "--minutes", "0.05", "--interval", "0.1",
                 "--frames", "10", "--out", folder / "out"], capture_output=True, text=True, check=False)
            report = json.loads((folder / "out/scan.json").read_text(encoding="utf-8"))
            results = {check["name"]: check["result"] for check in report["checks"]}
            for check in ("end", "session", "catalogue", "integrity", "descriptors", "threads"):
                self.assertEqual(results[check], "good", done.stdout + done.stderr)
            self.assertEqual(report["frames_per_loop"], 10)
            self.assertTrue((folder / "out/scan.svg").is_file())
            self.assertIn("good", (folder / "out/scan.txt").read_text(encoding="utf-8"))


if __name__ == "__main__":
    unittest.main()
