#!/usr/bin/env python3
"""Writes small recordings for the checks of readers, without libraries: depth PNGs, colour PNGs, and a JPEG with an
Exif orientation. make_images.py KIND FOLDER"""
import os
import struct
import sys
import zlib

WIDTH, HEIGHT = 160, 120


def chunk(kind, content):
    return (struct.pack(">I", len(content)) + kind + content +
            struct.pack(">I", zlib.crc32(kind + content)))


def png(bits, color_type, rows):
    header = struct.pack(">IIBBBBB", WIDTH, HEIGHT, bits, color_type, 0, 0, 0)
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) +
            chunk(b"IDAT", zlib.compress(b"".join(b"\0" + row for row in rows))) + chunk(b"IEND", b""))


def depth(units_per_metre, step):
    """A wall with a box that moves a little."""
    rows = []
    for y in range(HEIGHT):
        row = []
        for x in range(WIDTH):
            is_box = 50 + step <= x < 100 + step and 40 <= y < 90
            row.append(int((0.8 if is_box else 1.2 + 0.001 * x + 0.0005 * y) * units_per_metre))
        rows.append(struct.pack(">%dH" % WIDTH, *row))
    return png(16, 0, rows)


def color(channels, bits, step):
    rows = []
    for y in range(HEIGHT):
        row = []
        for x in range(WIDTH):
            value = (x * 7 + y * 13 + step * 3) % 200 + 20
            row += ([value, 255 - value, value // 2, 255])[:channels]
        rows.append(bytes(row) if bits == 8 else struct.pack(">%dH" % len(row), *[257 * v for v in row]))
    return png(bits, 2 if channels == 3 else 6, rows)


def write(path, data):
    os.makedirs(os.path.dirname(path), exist_ok=True)
    with open(path, "wb" if isinstance(data, bytes) else "w") as file:
        file.write(data)


def lists(folder, stamps, units_per_metre=5000):
    for i in range(3):
        write("%s/depth/%d.png" % (folder, i), depth(units_per_metre, i))
        write("%s/rgb/%d.png" % (folder, i), color(3, 8, i))
    for kind in ("depth", "rgb"):
        write("%s/%s.txt" % (folder, kind),
              "".join("%s %s/%d.png\n" % (stamp, kind, i % 3) for i, stamp in enumerate(stamps)))


def names(folder, stems, channels=3, bits=8):
    for i, stem in enumerate(stems):
        write("%s/depth/%s.png" % (folder, stem), depth(1000, i))
        write("%s/rgb/%s.png" % (folder, stem), color(channels, bits, i))


kind, folder = sys.argv[1:]
if kind == "equal-times":
    lists(folder, ["1305031229.25"] * 20000)
elif kind == "nanoseconds":
    lists(folder, [str(1403636579763555584 + i * 33333333) for i in range(3)])
elif kind == "marked":
    lists(folder, ["1305031229.%d" % i for i in (1, 2, 3)])
    for name in ("rgb.txt", "depth.txt"):
        with open(folder + "/" + name, "rb") as file:
            text = file.read()
        write(folder + "/" + name, b"\xef\xbb\xbf" + text)
elif kind == "long-names":
    names(folder, [str(1581120424100262102 + i * 33333333) for i in range(3)])
    write(folder + "/cam_K.txt", "146.25 0 80\n0 146.25 60\n0 0 1\n")
elif kind == "any-names":
    names(folder, ["left", "middle", "right"])
elif kind == "rgba":
    names(folder, ["000", "001", "002"], 4, 8)
elif kind == "sixteen-bits":
    names(folder, ["000", "001", "002"], 3, 16)
else:
    sys.exit("unknown kind " + kind)
