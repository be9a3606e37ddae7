"""Compares the rate of scans whose catalogue is on a server with that of scans with a file, in pairs."""
import json
import statistics

from scanner import Scanner


def measure(program, sources, folder, databases, options):
    """Scans all sources at once. Result: frames per second and CPU seconds of a frame, as means."""
    folder.mkdir(parents=True)
    scanners = [Scanner(program, source, folder / f"scan{number}", database, options)
                for number, (source, database) in enumerate(zip(sources, databases))]
    fps, cpu_s = [], []
    for scanner in scanners:
        code, seconds = scanner.wait_with_usage()
        if code != 0:
            raise ValueError(f"a scan ended with exit code {code}; see {scanner.logs[-1]}")
        report = scanner.report()
        fps.append(report["fps"])
        cpu_s.append(seconds / report["frames"]["read"])
    return {"fps": statistics.mean(fps), "cpu_s": statistics.mean(cpu_s)}


def compare(program, sources, folder, server, frames, pairs):
    """A list of pairs; which of both comes first alternates."""
    options = ["--frames", str(frames), "--skip-refinement"]
    results = []
    for number in range(pairs):
        work = folder / f"pair{number + 1}"
        work.mkdir(parents=True)
        pair = {}
        for where in ("file", "server") if number % 2 == 0 else ("server", "file"):
            if where == "server":
                databases = [server.create(f"rate_{number}")] * len(sources)
            else:
                databases = [work / f"catalogue{one}.sqlite" for one in range(len(sources))]
            pair[where] = measure(program, sources, work / where, databases, options)
        results.append(pair)
        print(f"  pair {number + 1}: {json.dumps(pair)}", flush=True)
    return results


def ratios(pairs, key):
    """Server over file: the median and all."""
    each = [pair["server"][key] / pair["file"][key] for pair in pairs]
    return statistics.median(each), each
