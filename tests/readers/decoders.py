"""Decoders of files in data sets, written from their specifications: COCO and Label Studio masks, PLY, OBJ, GLB, PCD.

Coordinates are numpy arrays of N x 3, faces N x 3, masks bool arrays of rows x columns.
"""

import json
import struct

import numpy as np

_PLY_TYPES = {"float": "<f4", "double": "<f8", "uchar": "u1", "uint": "<u4", "int": "<i4", "ushort": "<u2"}


def coco_mask(segmentation):
    """A compressed run-length code of COCO: runs by columns, each number in groups of 5 bits."""
    height, width = segmentation["size"]
    counts, at, code = [], 0, segmentation["counts"].encode("ascii")
    while at < len(code):
        value, shift, more = 0, 0, True
        while more:
            group = code[at] - 48
            value |= (group & 0x1F) << shift
            more = bool(group & 0x20)
            at, shift = at + 1, shift + 5
            if not more and group & 0x10:
                value -= 1 << shift
        counts.append(value + counts[-2] if len(counts) > 2 else value)
    if min(counts) < 0 or sum(counts) != height * width:
        raise ValueError(f"runs of {sum(counts)} pixels for an image of {height * width}")
    is_inside = np.arange(len(counts)) % 2 == 1
    return np.repeat(is_inside, counts).reshape(width, height).T


def brush_mask(code, height, width):
    """Label Studio's run-length code of an RGBA image: bits, highest first."""
    bits = np.unpackbits(np.asarray(code, np.uint8))
    place = 0

    def take(count):
        nonlocal place
        value = int(bits[place : place + count] @ (1 << np.arange(count)[::-1]))
        place += count
        return value

    total, word = take(32), take(5) + 1
    sizes = [take(4) + 1 for _ in range(4)]
    values = []
    written = 0
    while written < total:
        is_run = take(1)
        length = take(sizes[take(2)]) + 1
        if is_run:
            values.append(np.full(length, take(word), np.uint8))
        else:
            values.append(np.array([take(word) for _ in range(length)], np.uint8))
        written += length
    rgba = np.concatenate(values).reshape(height, width, 4)
    return rgba[:, :, 3] > 127


def ply(path):
    """Elements of a binary PLY file: {"vertex": structured array, "face": N x 3}."""
    data = path.read_bytes()
    end = data.index(b"end_header\n") + len(b"end_header\n")
    lines = data[:end].decode("ascii").splitlines()
    if lines[:2] != ["ply", "format binary_little_endian 1.0"]:
        raise ValueError(f"{path} is no binary PLY file")
    elements = []
    for line in lines:
        words = line.split()
        if words[0] == "element":
            elements.append((words[1], int(words[2]), []))
        elif words[0] == "property":
            elements[-1][2].append(words[1:])
    read = {}
    for name, count, properties in elements:
        if properties[0][0] == "list":
            if len(properties) != 1:
                raise ValueError(f"{path}: lists beside other properties")
            faces = np.frombuffer(data, [("n", "u1"), ("v", "<i4", 3)], count, end)
            if count and not (faces["n"] == 3).all():
                raise ValueError(f"{path}: faces that are no triangles")
            read[name], end = faces["v"], end + faces.nbytes
        else:
            kind = np.dtype([(words[1], _PLY_TYPES[words[0]]) for words in properties])
            read[name] = np.frombuffer(data, kind, count, end)
            end += read[name].nbytes
    if end != len(data):
        raise ValueError(f"{path} has {len(data) - end} bytes too many")
    return read


def xyz(vertices):
    return np.stack([vertices[axis] for axis in "xyz"], axis=1).astype(float)


def obj(path):
    """{"v", "vn", "vt": arrays; "f": N x 3 of places in v, "ft": in vt; "mtllib", "o": text}."""
    read = {"v": [], "vn": [], "vt": [], "f": [], "ft": []}
    for line in path.read_text("utf-8").splitlines():
        word, _, rest = line.partition(" ")
        if word in ("v", "vn", "vt"):
            read[word].append([float(number) for number in rest.split()])
        elif word == "f":
            corners = [corner.split("/") for corner in rest.split()]
            read["f"].append([int(corner[0]) - 1 for corner in corners])
            if corners[0][1]:
                read["ft"].append([int(corner[1]) - 1 for corner in corners])
        elif word in ("mtllib", "usemtl", "o"):
            read[word] = rest
        elif word not in ("#", ""):
            raise ValueError(f"{path}: unknown line {line!r}")
    for word in ("v", "vn", "vt"):
        read[word] = np.array(read[word])
    for word in ("f", "ft"):
        read[word] = np.array(read[word], int)
    return read


def mtl(path):
    return dict(line.split(" ", 1) for line in path.read_text("utf-8").splitlines() if line)


_GLB_TYPES = {5121: "u1", 5123: "<u2", 5125: "<u4", 5126: "<f4"}
_GLB_WIDTHS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4}


def glb(path):
    """{"parts": [{"name", "v", "f", "uv" or None, "extras"}], "image": PNG bytes or None}."""
    data = path.read_bytes()
    magic, version, length = struct.unpack_from("<4sII", data)
    if (magic, version, length) != (b"glTF", 2, len(data)):
        raise ValueError(f"{path} is no GLB file of version 2 and its own length")
    chunks, at = {}, 12
    while at < length:
        size, kind = struct.unpack_from("<I4s", data, at)
        chunks[kind] = data[at + 8 : at + 8 + size]
        at += 8 + size
    tree, binary = json.loads(chunks[b"JSON"]), chunks[b"BIN\0"]

    def view(number):
        one = tree["bufferViews"][number]
        return binary[one.get("byteOffset", 0) :][: one["byteLength"]]

    def accessor(number):
        one = tree["accessors"][number]
        width = _GLB_WIDTHS[one["type"]]
        values = np.frombuffer(view(one["bufferView"]), _GLB_TYPES[one["componentType"]], one["count"] * width)
        return values.reshape(-1, width)

    parts = []
    for node in tree["nodes"]:
        (primitive,) = tree["meshes"][node["mesh"]]["primitives"]
        attributes = primitive["attributes"]
        parts.append(
            {
                "name": node["name"],
                "extras": node.get("extras"),
                "v": accessor(attributes["POSITION"]).astype(float) + node.get("translation", [0, 0, 0]),
                "f": accessor(primitive["indices"]).reshape(-1, 3).astype(int),
                "uv": accessor(attributes["TEXCOORD_0"]) if "TEXCOORD_0" in attributes else None,
            }
        )
    images = tree.get("images", [])
    return {"parts": parts, "image": view(images[0]["bufferView"]) if images else None}


def pcd(path):
    """(points as a structured array, the seven numbers of VIEWPOINT) of a binary PCD file."""
    data = path.read_bytes()
    end = data.index(b"DATA binary\n") + len(b"DATA binary\n")
    header = dict(line.split(" ", 1) for line in data[:end].decode("ascii").splitlines() if line[0] != "#")
    kinds = {"F4": "<f4", "F8": "<f8", "U4": "<u4", "U1": "u1", "I4": "<i4"}
    fields = zip(
        header["FIELDS"].split(), header["TYPE"].split(), header["SIZE"].split(), header["COUNT"].split(), strict=True
    )
    kind = []
    for place, (name, letter, size, count) in enumerate(fields):
        if count != "1":
            raise ValueError(f"{path}: a field of {count} numbers")
        kind.append((name if name != "_" else f"_{place}", kinds[letter + size]))
    points = np.frombuffer(data, np.dtype(kind), int(header["POINTS"]), end)
    if points.nbytes + end != len(data):
        raise ValueError(f"{path} has not the length that its header says")
    return points, np.array(header["VIEWPOINT"].split(), float)
