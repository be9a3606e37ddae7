"""What /proc tells of a running process."""
import os
import re


def status_number(text, key):
    found = re.search(rf"^{key}:\s+(\d+)", text, re.MULTILINE)
    return int(found[1]) if found else None


def files_below(folder):
    return sum(len(files) for _, _, files in os.walk(folder))


def take_sample(process, temporary_folder):
    """A dictionary with memory_mb, threads, descriptors and temporary_files; None: the process has ended."""
    try:
        with open(f"/proc/{process}/status", encoding="utf-8", errors="replace") as file:
            status = file.read()
        descriptors = len(os.listdir(f"/proc/{process}/fd"))
    except OSError:
        return None
    memory_kb = status_number(status, "VmRSS")
    if memory_kb is None:  # it ended and waits for its parent
        return None
    return {
        "memory_mb": round(memory_kb / 1024, 2),
        "threads": status_number(status, "Threads"),
        "descriptors": descriptors,
        "temporary_files": files_below(temporary_folder),
    }
