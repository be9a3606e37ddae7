"""Reads a scan on disk: the folder with session.sqlite."""

import json
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path

import numpy as np

from .clouds import read_cloud
from .database import has_column, has_table, open_database
from .errors import ScantroveError
from .images import read_image
from .painted import painted_operations

_APPLICATION_ID = 1399018341
_NEWEST_VERSION = 12


@dataclass(frozen=True)
class Frame:
    """A frame that the scan has seen."""

    number: int
    """0, 1, ... in the order of the scan."""
    index: int
    """The number in its recording, which names files such as labels-final/000120.png."""
    time: float
    """Seconds, as in the recording."""
    state: str
    """"tracking", "relocalised", "uncertain" or "lost"; poses are reliable with the first two."""
    T_world_camera: np.ndarray
    """(4, 4), from the depth camera to the world of the recording, metres."""
    K: np.ndarray
    """(3, 3), the depth camera, pixels."""
    size: tuple
    """(width, height) of the depth image."""

    @property
    def is_reliable(self):
        """Whether the pose is reliable."""
        return self.state in ("tracking", "relocalised")


@dataclass(frozen=True)
class PaintedMask:
    """What a person painted for a region in the image of a key frame, and has not taken back."""

    region: int
    """The region that was painted for; it may have been split or joined since."""
    added: np.ndarray
    """(height, width) bool: pixels that are the region."""
    removed: np.ndarray
    """(height, width) bool: pixels that are not."""


@dataclass(frozen=True)
class KeyFrame:
    """A frame whose images the session keeps."""

    frame: Frame
    color_file: Path | None
    """JPEG or PNG as recorded; None: no colour."""
    depth_file: Path
    metres_per_unit: float
    K_color: np.ndarray
    """(3, 3), the colour camera, pixels of the colour image."""
    T_color_depth: np.ndarray
    """(4, 4), from the depth camera to the colour camera, metres; the identity for registered colour."""
    review: str
    """"open", "checked" or "left-out", by a person."""
    painted: list = field(default_factory=list)
    """PaintedMasks in the colour image (without one: in the depth image), oldest first."""

    @property
    def index(self):
        """Frame.index."""
        return self.frame.index

    @property
    def T_world_color(self):
        """(4, 4), from the colour camera to the world."""
        return self.frame.T_world_camera @ np.linalg.inv(self.T_color_depth)

    def color(self):
        """(height, width, 3) uint8, red, green, blue; None: no colour."""
        return None if self.color_file is None else read_image(self.color_file)

    def depth(self):
        """(height, width) float32, metres along the optical axis, 0 = no reading."""
        units = read_image(self.depth_file)
        return units.astype(np.float32) * np.float32(self.metres_per_unit)


@dataclass(frozen=True)
class Region:
    """A part of the scene, with what is known of it."""

    id: int
    """As in clouds and label images; never 0."""
    name: str
    """"": none."""
    class_name: str
    """"": none."""
    object: int | None
    """Number of the object in the catalogue."""
    confirmed: bool
    """The object, by a person."""
    background: bool
    rejected: bool
    """"Not an object", by a person."""
    voxels: int
    """Of the map, those of its fragments."""
    box: np.ndarray | None
    """(2, 3): lowest and highest corner along the axes of the world, metres, of the measured points in the cloud of
    the scan's results; None: there is no such cloud, or no such point."""


class Session:
    """A scan on disk, read-only.

    path: the folder with session.sqlite. Raises ScantroveError if there is none, or a newer Scantrove wrote it. A
    program may have the session open at the same time.
    """

    def __init__(self, path):
        self.folder = Path(path).absolute()
        self._database = open_database(
            self.folder / "session.sqlite", _APPLICATION_ID, _NEWEST_VERSION, "session"
        )
        self._facts = dict(self._database.execute("SELECT name, value FROM facts").fetchall())

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()

    def close(self):
        """Closes the file; what was read stays."""
        self._database.close()

    @property
    def source(self):
        """What was scanned: a path, a camera or a demo."""
        return self._facts.get("source", "")

    @cached_property
    def origin(self):
        """(3,) metres: the session's own positions are relative to it; those of this class include it."""
        numbers = self._facts.get("origin_m", "0 0 0").split()
        return np.array([float(number) for number in numbers])

    @cached_property
    def frames(self):
        """All Frames, in order of time."""
        K, size = self._camera
        has_own = has_column(self._database, "frames", "fx")
        rows = self._database.execute("SELECT * FROM frames ORDER BY number").fetchall()
        return [self._frame(row, K, size, has_own) for row in rows]

    @cached_property
    def key_frames(self):
        """All KeyFrames, in order of time."""
        by_number = {frame.number: frame for frame in self.frames}
        reviews, painted = self._reviews(), self._painted()
        rows = self._database.execute("SELECT * FROM key_frames ORDER BY number").fetchall()
        return [
            self._key_frame(row, by_number[row["number"]], reviews, painted)
            for row in rows
            if row["number"] in by_number
        ]

    @cached_property
    def regions(self):
        """All Regions, by id."""
        voxels = dict(
            self._database.execute(
                "SELECT region, sum(voxels) FROM fragments WHERE region <> 0 GROUP BY region"
            ).fetchall()
        )
        notes = {row["region"]: row for row in self._database.execute("SELECT * FROM regions")}
        objects = json.loads(self._facts.get("objects") or "{}")
        boxes = self._boxes()
        return [
            _region(id, notes.get(id), objects.get(str(id), {}), voxels[id], boxes.get(id))
            for id in sorted(voxels)
        ]

    def cloud(self):
        """The labelled cloud of the scan's results, as read_cloud; None: the scan has none yet."""
        for name in ("cloud.ply", "cloud.pcd"):
            if (self.folder / name).is_file():
                return read_cloud(self.folder / name)
        return None

    def final_labels(self, index):
        """(height, width) uint16, the regions at the end of the scan in the image of the frame with that index; 0 =
        none. None: the scan wrote no label images (option --label-maps)."""
        file = self.folder / "labels-final" / f"{index:06}.png"
        return read_image(file) if file.is_file() else None

    @property
    def _camera(self):
        """K and size of the depth camera of the whole scan."""
        try:
            camera = json.loads(self._facts["camera"])
            return _matrix(camera["K"]), tuple(camera["size"])
        except (KeyError, ValueError) as error:
            raise ScantroveError(
                f"The session {self.folder} does not say what camera it was scanned with. It broke off before its "
                "first frame was kept, or is damaged."
            ) from error

    def _frame(self, row, K, size, has_own):
        if has_own and row["fx"] is not None:
            K = _matrix([row["fx"], row["fy"], row["cx"], row["cy"]])
            size = (row["width"], row["height"])
        pose = np.eye(4)
        if row["tx"] is not None:
            pose[:3, :3] = _rotation(*(row[name] for name in ("qx", "qy", "qz", "qw")))
            pose[:3, 3] = self.origin + np.array([row["tx"], row["ty"], row["tz"]])
        return Frame(row["number"], row["source_index"], row["time_s"], row["state"], pose, K, size)

    def _key_frame(self, row, frame, reviews, painted):
        color = json.loads(row["color"])
        T_color_depth = np.eye(4)
        if "K" in color:
            K = _resized(_matrix(color["K"]), color["K_size"], color["size"])
            T_color_depth[:3] = np.array(color["T_color_depth"]).reshape(3, 4)
        elif row["color_file"]:
            K = _resized(frame.K, frame.size, color["size"])
        else:
            K = frame.K
        return KeyFrame(
            frame=frame,
            color_file=self.folder / row["color_file"] if row["color_file"] else None,
            depth_file=self.folder / row["depth_file"],
            metres_per_unit=row["metres_per_unit"],
            K_color=K,
            T_color_depth=T_color_depth,
            review=reviews.get(frame.number, "open"),
            painted=painted.get(frame.number, []),
        )

    def _reviews(self):
        """The state of each reviewed key frame, by its frame's number."""
        if not has_table(self._database, "frame_reviews"):
            return {}
        query = (
            "SELECT key_frame, frame_reviews.state FROM frame_reviews JOIN operations ON frame_reviews.operation = number "
            "WHERE operations.state = 'done' ORDER BY number"
        )
        return dict(self._database.execute(query).fetchall())

    def _painted(self):
        """PaintedMasks by the number of the key frame's frame."""
        if not has_table(self._database, "mask_corrections"):
            return {}
        query = "SELECT width, height, added, removed FROM mask_corrections WHERE operation = ?"
        painted = {}
        for number, key_frame, region in painted_operations(self._database):
            row = self._database.execute(query, (number,)).fetchone()
            if row is None:
                continue
            masks = [_runs(row[name], row["width"], row["height"]) for name in ("added", "removed")]
            painted.setdefault(key_frame, []).append(PaintedMask(region, *masks))
        return painted

    def _boxes(self):
        cloud = self.cloud()
        if cloud is None or "label" not in cloud:
            return {}
        is_measured = ~cloud.get("estimated", np.zeros(len(cloud["label"]), bool))
        labels, xyz = cloud["label"][is_measured], cloud["xyz"][is_measured]
        order = np.argsort(labels, kind="stable")
        labels, first = np.unique(labels[order], return_index=True)
        if not len(labels):
            return {}
        xyz = xyz[order]
        low, high = np.minimum.reduceat(xyz, first), np.maximum.reduceat(xyz, first)
        return {int(label): np.stack([low[i], high[i]]) for i, label in enumerate(labels)}


def _region(id, note, known, voxels, box):
    # A name that a person gave to the object holds for all of its regions.
    own_name, own_class = (note["name"], note["category"]) if note else ("", "")
    is_known = bool(known) and not known.get("deleted")
    own_wins = own_name and not (is_known and known.get("by_person"))
    return Region(
        id=id,
        name=own_name if own_wins else (known.get("name", "") if is_known else ""),
        class_name=(known.get("class") if is_known else "") or own_class,
        object=known["object"] if is_known else None,
        confirmed=is_known and bool(known.get("confirmed")),
        background=bool(note and note["background"]),
        rejected=bool(note and note["rejected"]),
        voxels=voxels,
        box=box,
    )


def _matrix(numbers):
    fx, fy, cx, cy = numbers
    return np.array([[fx, 0, cx], [0, fy, cy], [0, 0, 1]], float)


def _resized(K, old, new):
    """K for images of the size `new` in place of `old`, (width, height)."""
    sx, sy = new[0] / old[0], new[1] / old[1]
    return _matrix(
        [K[0, 0] * sx, K[1, 1] * sy, (K[0, 2] + 0.5) * sx - 0.5, (K[1, 2] + 0.5) * sy - 0.5]
    )


def _rotation(x, y, z, w):
    """(3, 3) of a quaternion."""
    x, y, z, w = np.array([x, y, z, w]) / np.linalg.norm([x, y, z, w])
    return np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
            [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
            [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
        ]
    )


def _runs(data, width, height):
    """(height, width) bool from LEB128 lengths of runs, alternately not painted and painted."""
    mask = np.zeros(width * height, bool)
    at, number, shift, is_painted = 0, 0, 0, False
    for byte in data or b"":
        number |= (byte & 0x7F) << shift
        shift += 7
        if byte & 0x80:
            continue
        mask[at : at + number] = is_painted
        at, number, shift, is_painted = at + number, 0, 0, not is_painted
    return mask.reshape(height, width)
