"""Reads clouds of points as Scantrove exports them."""

from pathlib import Path

import numpy as np

from .errors import ScantroveError

_PLY_TYPES = {
    "char": "i1", "int8": "i1", "uchar": "u1", "uint8": "u1", "short": "i2", "int16": "i2", "ushort": "u2",
    "uint16": "u2", "int": "i4", "int32": "i4", "uint": "u4", "uint32": "u4", "float": "f4", "float32": "f4",
    "double": "f8", "float64": "f8",
}  # fmt: skip


def read_cloud(file):
    """The points of a binary PLY or PCD file as a dict of arrays with one entry for each point.

    "xyz": (n, 3) float, metres, in the world of the recording; if the file has them also "rgb": (n, 3) uint8,
    "normals": (n, 3) float, "label": (n,) uint32, the region, 0 = none, "estimated": (n,) bool, True where no
    depth reading shows the surface. Faces of a mesh are skipped.
    """
    file = Path(file)
    try:
        data = file.read_bytes()
    except OSError as error:
        raise ScantroveError(f"The cloud {file} cannot be read: {error.strerror}.") from error
    try:
        points = _ply_points(data) if data.startswith(b"ply") else _pcd_points(data)
    except (ValueError, KeyError, IndexError) as error:
        raise ScantroveError(f"The cloud {file} is damaged, or neither a binary PLY nor a binary PCD.") from error
    return _by_meaning(points)


def _ply_points(data):
    end = data.index(b"end_header\n") + len(b"end_header\n")
    fields, count, is_vertex = [], 0, False
    lines = data[:end].decode("utf-8", "replace").splitlines()
    if "format binary_little_endian 1.0" not in lines:
        raise ValueError("not binary")
    for line in lines:
        words = line.split()
        if words[:1] == ["element"]:
            is_vertex = words[1] == "vertex"
            count = int(words[2]) if is_vertex else count
        elif words[:1] == ["property"] and is_vertex:
            fields.append((words[2], "<" + _PLY_TYPES[words[1]]))
    return np.frombuffer(data, np.dtype(fields), count, end)


def _pcd_points(data):
    header = {}
    at = 0
    while "DATA" not in header:
        end = data.index(b"\n", at)
        words = data[at:end].decode("utf-8", "replace").split()
        if words and not words[0].startswith("#"):
            header[words[0]] = words[1:]
        at = end + 1
    if header["DATA"] != ["binary"]:
        raise ValueError("not binary")
    kinds = {"F": "f", "U": "u", "I": "i"}
    fields = [
        (name, "<" + kinds[kind] + size)
        for name, kind, size in zip(header["FIELDS"], header["TYPE"], header["SIZE"], strict=True)
    ]
    return np.frombuffer(data, np.dtype(fields), int(header["POINTS"][0]), at)


def _by_meaning(points):
    names = points.dtype.names
    cloud = {"xyz": np.stack([points[name] for name in ("x", "y", "z")], axis=-1)}
    if "red" in names:
        cloud["rgb"] = np.stack([points[name] for name in ("red", "green", "blue")], axis=-1)
    elif "rgba" in names:
        shifts = np.array([16, 8, 0], np.uint32)
        cloud["rgb"] = (points["rgba"][:, None] >> shifts & 0xFF).astype(np.uint8)
    if "nx" in names:
        cloud["normals"] = np.stack([points[name] for name in ("nx", "ny", "nz")], axis=-1)
    if "label" in names:
        cloud["label"] = points["label"].astype(np.uint32)
    if "estimated" in names:
        cloud["estimated"] = points["estimated"].astype(bool)
    return cloud
