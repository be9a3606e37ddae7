"""Scans a recording in a loop for hours, samples the process, and judges the samples. See README.md."""
import argparse
import json
import os
import shutil
import subprocess
import sys
import time
from pathlib import Path

from judgment import judge
from process_sample import take_sample
from soundness import check_results
from subjects import Scan, Window
from svg_plot import plot

CURVES = (("memory_mb", "memory (MB)"), ("fps", "frames per second"), ("descriptors", "open files"),
          ("threads", "threads"), ("temporary_files", "temporary files"), ("regions", "regions"))


def arguments():
    parser = argparse.ArgumentParser(prog="endure", description=__doc__)
    parser.add_argument("program", type=Path, help="the built program, for example build/release/app/scantrove")
    parser.add_argument("source", nargs="?", default="demo", help="a recording or a demo (default: demo)")
    parser.add_argument("--hours", type=float, help="how long each subject runs")
    parser.add_argument("--minutes", type=float, help="instead of --hours")
    parser.add_argument("--subject", choices=("scan", "window", "both"), default="both")
    parser.add_argument("--frames", type=int, default=60, help="frames in a loop (default: 60)")
    parser.add_argument("--interval", type=float, default=3, help="seconds between two samples (default: 3)")
    parser.add_argument("--out", type=Path, required=True, help="new folder for reports and results")
    chosen = parser.parse_args()
    if (chosen.hours is None) == (chosen.minutes is None):
        parser.error("give --hours or --minutes")
    chosen.seconds = 3600 * chosen.hours if chosen.hours is not None else 60 * chosen.minutes
    if chosen.seconds <= 0 or chosen.frames < 1 or chosen.interval <= 0:
        parser.error("times and --frames must be above 0")
    if not os.access(chosen.program, os.X_OK):
        parser.error(f"{chosen.program} is no program")
    if chosen.out.exists() and any(chosen.out.iterdir()):
        parser.error(f"{chosen.out} is not empty")
    if chosen.subject != "scan" and shutil.which("Xvfb") is None:
        parser.error("the window needs Xvfb (Debian: xvfb); or give --subject scan")
    chosen.program = chosen.program.absolute()
    if Path(chosen.source).exists():
        chosen.source = str(Path(chosen.source).absolute())
    return chosen


def watch(subject, seconds, interval, temporary_folder):
    """Samples from the first frame on, for `seconds`. Raises ValueError if the program ends before."""
    samples, start, before = [], None, None
    patience_end = time.monotonic() + 600  # to the first frame: kernels may have to be compiled
    while start is None or time.monotonic() < start + seconds:
        time.sleep(interval)
        progress = subject.progress()
        now = time.monotonic()
        sample = take_sample(subject.process.pid, temporary_folder)
        if sample is None or subject.process.poll() is not None:
            raise ValueError(f"the {subject.name} ended by itself after {len(samples)} samples")
        if progress is None:
            if now > patience_end:
                raise ValueError(f"the {subject.name} processed no frame in ten minutes")
            continue
        if start is None:
            start, patience_end = now, None
        sample.update(seconds=round(now - start, 2), frames=progress[0], regions=progress[1], fps=None)
        if before and now > before[0]:
            sample["fps"] = round((progress[0] - before[1]) / (now - before[0]), 2)
        before = (now, progress[0])
        samples.append(sample)
    return samples


def endure(subject, chosen, work):
    """Runs one subject. Result: its report."""
    samples, checks = [], []
    try:
        samples = watch(subject, chosen.seconds, chosen.interval, work / "tmp")
    except (ValueError, OSError) as error:
        checks.append({"name": "run", "result": "bad", "text": str(error)})
    try:
        subject.end()
        checks.append({"name": "end", "result": "good", "text": "the program ended when asked"})
    except (ValueError, OSError, subprocess.TimeoutExpired) as error:
        subject.process.kill()
        checks.append({"name": "end", "result": "bad", "text": str(error)})
    loop = subject.frames_per_loop or chosen.frames
    if samples:
        checks += judge(samples, loop)
    try:
        checks += check_results(chosen.program, *subject.results())
    except (ValueError, OSError) as error:
        checks.append({"name": "results", "result": "bad", "text": str(error)})
    return {"subject": subject.name, "source": chosen.source, "frames_per_loop": loop,
            "loops": round(samples[-1]["frames"] / loop, 1) if samples else 0, "checks": checks, "samples": samples}


def write(report, folder):
    """Text, SVG and JSON."""
    name = report["subject"]
    lines = [f"{name} of {report['source']}: {report['loops']} loops of {report['frames_per_loop']} frames, "
             f"{len(report['samples'])} samples"]
    lines += [f"  {check['result']:<10}  {check['name']:<15}  {check['text']}" for check in report["checks"]]
    text = "\n".join(lines) + "\n"
    (folder / f"{name}.txt").write_text(text, encoding="utf-8")
    (folder / f"{name}.json").write_text(json.dumps(report, indent=1), encoding="utf-8")
    (folder / f"{name}.svg").write_text(plot(lines[0], report["samples"], CURVES), encoding="utf-8")
    print(text, end="", flush=True)


def main():
    chosen = arguments()
    options = ["--frames", str(chosen.frames)]
    is_good, loop = True, chosen.frames
    for name in ("scan", "window") if chosen.subject == "both" else (chosen.subject,):
        work = chosen.out.absolute() / name
        work.mkdir(parents=True)
        subject = (Scan(chosen.program, chosen.source, options, work) if name == "scan" else
                   Window(chosen.program, chosen.source, options, work, loop))
        try:
            report = endure(subject, chosen, work)
        finally:  # Ctrl+C as well
            if subject.process.poll() is None:
                subject.process.terminate()
        loop = report["frames_per_loop"]
        write(report, chosen.out.absolute())
        is_good = is_good and all(check["result"] != "bad" for check in report["checks"])
    return 0 if is_good else 1


if __name__ == "__main__":
    sys.exit(main())
