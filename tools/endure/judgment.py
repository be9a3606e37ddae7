"""Whether the samples of a long scan are sound.

A sample is a dictionary with the keys of take_sample(), seconds, frames and regions.
"""
from statistics import median

MEMORY_GROWTH = 0.01  # of the memory after the second loop
RATE_CHANGE = 0.03
FEWEST_SAMPLES = 5  # in each of the two compared parts


def settled(samples, frames_per_loop):
    """Those after the second loop, when map and caches are complete."""
    return [sample for sample in samples if sample["frames"] >= 2 * frames_per_loop]


def rate(samples):
    """Frames per second."""
    seconds = samples[-1]["seconds"] - samples[0]["seconds"]
    return (samples[-1]["frames"] - samples[0]["frames"]) / seconds if seconds > 0 else 0.0


def check(name, is_good, text):
    return {"name": name, "result": "good" if is_good else "bad", "text": text}


def judge(samples, frames_per_loop):
    """Compares the first third after the second loop with the last one."""
    after = settled(samples, frames_per_loop)
    third = len(after) // 3
    names = ("memory", "rate", "descriptors", "threads", "temporary files")
    if third < FEWEST_SAMPLES:
        text = f"the run was too short: {len(after)} samples after the second loop, {3 * FEWEST_SAMPLES} are needed"
        return [{"name": name, "result": "not judged", "text": text} for name in names]
    first, last = after[:third], after[-third:]
    memory = [median(sample["memory_mb"] for sample in part) for part in (first, last)]
    growth = memory[1] / memory[0] - 1
    rates = [rate(part) for part in (first, last)]
    change = rates[1] / rates[0] - 1 if rates[0] > 0 else -1.0
    checks = [
        check("memory", growth <= MEMORY_GROWTH,
              f"{memory[0]:.1f} MB, then {memory[1]:.1f} MB ({100 * growth:+.2f} %, at most {100 * MEMORY_GROWTH:+.0f} %)"),
        check("rate", abs(change) <= RATE_CHANGE,
              f"{rates[0]:.2f} frames/s, then {rates[1]:.2f} ({100 * change:+.2f} %, at most {100 * RATE_CHANGE:.0f} %)"),
    ]
    # Work in progress opens files for a moment; what is never closed raises the smallest number.
    for name, key in (("descriptors", "descriptors"), ("threads", "threads"), ("temporary files", "temporary_files")):
        fewest = [min(sample[key] for sample in part) for part in (first, last)]
        checks.append(check(name, fewest[1] <= fewest[0], f"at least {fewest[0]}, then at least {fewest[1]}"))
    return checks
