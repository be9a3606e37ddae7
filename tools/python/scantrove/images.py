"""Reads images: through OpenCV or Pillow if one is installed, and most PNGs without them."""

import io
import struct
import zlib
from pathlib import Path

import numpy as np

from .errors import ScantroveError

_PNG = b"\x89PNG\r\n\x1a\n"


def read_image(file):
    """The image in a PNG or JPEG file.

    Colour: (height, width, 3) uint8, red, green, blue. Grey: (height, width), uint8 or uint16, unchanged.
    """
    file = Path(file)
    try:
        data = file.read_bytes()
    except OSError as error:
        raise ScantroveError(f"The image {file} cannot be read: {error.strerror}.") from error
    return decode_image(data, file)


def decode_image(data, name):
    """As read_image, from the bytes of a file; `name` is for messages."""
    image = _decode_simple_png(data, name)
    if image is None:
        image = _decode_with_library(data, name)
    return image


def _decode_with_library(data, name):
    try:
        import cv2
    except ImportError:
        return _decode_with_pillow(data, name)
    flags = cv2.IMREAD_UNCHANGED | cv2.IMREAD_IGNORE_ORIENTATION
    image = cv2.imdecode(np.frombuffer(data, np.uint8), flags)
    if image is None:
        raise ScantroveError(f"The image {name} is damaged, or of an unknown format.")
    return image if image.ndim == 2 else np.ascontiguousarray(image[:, :, 2::-1])


def _decode_with_pillow(data, name):
    try:
        from PIL import Image
    except ImportError as error:
        raise ScantroveError(
            f"The image {name} needs OpenCV or Pillow to be read, and neither is installed. Install python3-opencv "
            "or python3-pil."
        ) from error
    try:
        with Image.open(io.BytesIO(data)) as image:
            if image.mode in ("I", "I;16", "I;16B"):
                return np.asarray(image).astype(np.uint16)
            return np.array(image if image.mode == "L" else image.convert("RGB"))
    except (OSError, ValueError, SyntaxError) as error:
        raise ScantroveError(f"The image {name} is damaged, or of an unknown format.") from error


def _decode_simple_png(data, name):
    """A PNG without interlacing, grey or RGB, of 8 or 16 bits; None: another image."""
    if not data.startswith(_PNG):
        return None
    try:
        width, height, bits, kind, _, _, interlaced = struct.unpack(">IIBBBBB", data[16:29])
        if bits not in (8, 16) or kind not in (0, 2) or interlaced or (bits == 16 and kind == 2):
            return None
        packed, at = [], 8
        while at + 8 <= len(data):
            (length,) = struct.unpack(">I", data[at : at + 4])
            if data[at + 4 : at + 8] == b"IDAT":
                packed.append(data[at + 8 : at + 8 + length])
            at += 12 + length
        channels = 3 if kind == 2 else 1
        step = channels * bits // 8
        rows = np.frombuffer(zlib.decompress(b"".join(packed)), np.uint8)
        rows = _unfiltered(rows.reshape(height, 1 + width * step), step)
    except (struct.error, zlib.error, ValueError) as error:
        raise ScantroveError(f"The image {name} is damaged.") from error
    if bits == 16:
        return rows.view(">u2").astype(np.uint16)
    return rows.reshape(height, width, 3) if kind == 2 else rows


def _unfiltered(rows, step):
    """Undoes the filters of PNG, section 9 of its specification."""
    image = np.zeros((rows.shape[0], rows.shape[1] - 1), np.uint8)
    above = np.zeros(rows.shape[1] - 1, np.uint8)
    for y, row in enumerate(rows):
        method, values = row[0], row[1:]
        if method == 0:
            image[y] = values
        elif method == 1:
            per_pixel = values.reshape(-1, step).astype(np.uint64)
            image[y] = (np.cumsum(per_pixel, axis=0) & 0xFF).astype(np.uint8).ravel()
        elif method == 2:
            image[y] = values + above
        elif method in (3, 4):
            image[y] = _predicted(bytes(values), bytes(above), step, method)
        else:
            raise ValueError("unknown filter")
        above = image[y]
    return image


def _predicted(values, above, step, method):
    """A row with the filter Average (3) or Paeth (4)."""
    row = bytearray(len(values))
    for i, value in enumerate(values):
        left, up = (row[i - step] if i >= step else 0), above[i]
        if method == 3:
            guess = (left + up) // 2
        else:
            corner = above[i - step] if i >= step else 0
            base = left + up - corner
            distances = abs(base - left), abs(base - up), abs(base - corner)
            guess = (left, up, corner)[distances.index(min(distances))]
        row[i] = (value + guess) & 0xFF
    return np.frombuffer(bytes(row), np.uint8)
