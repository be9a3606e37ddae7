"""Reads a project: a folder with one catalogue and its scans."""

import json
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

import numpy as np

from .database import has_column, has_table, open_database
from .errors import ScantroveError
from .images import decode_image
from .session import Session

_APPLICATION_ID = 1399025268
_NEWEST_VERSION = 9
_PROJECT_FILES = ("scantrove-project.json", "project.json")
_NEWEST_PROJECT = 2


@dataclass(frozen=True)
class CatalogueClass:
    """A class of objects."""

    id: int
    """The category id of data sets; it never changes."""
    name: str
    color: str
    """"#rrggbb"."""
    supercategory: str
    """"": none."""


@dataclass(frozen=True)
class View:
    """A picture of an object, cut from a frame; all its images have the same size."""

    frame_index: int
    """The frame in its recording."""
    T_world_camera: np.ndarray
    """(4, 4), from the camera to the world of the scan, metres."""
    color: np.ndarray
    """(height, width, 3) uint8, red, green, blue."""
    mask: np.ndarray
    """(height, width) bool: the object."""
    depth: np.ndarray
    """(height, width) float32, metres, 0 = no reading."""


class CatalogueObject:
    """An object of the catalogue."""

    def __init__(self, project, row, class_):
        self._project = project
        self.id = row["id"]
        """As Region.object."""
        self.name = row["name"]
        self.confirmed = bool(row["confirmed"])
        """By a person."""
        self.size = np.array([row["size_x_m"], row["size_y_m"], row["size_z_m"]])
        """(3,) metres, the longest side first; zeros: unknown."""
        self.class_ = class_
        """A CatalogueClass; None: not classified."""

    def __repr__(self):
        return f"<object {self.id} {self.name!r}>"

    def views(self):
        """Yields the Views of the object."""
        yield from self._project._views(self.id)


class Project:
    """A project, read-only. path: its folder. Raises ScantroveError if it is none, or a newer Scantrove wrote it."""

    def __init__(self, path):
        self.folder = Path(path).absolute()
        self.name = self._read_name()
        self._database = open_database(
            self.folder / "catalogue.sqlite", _APPLICATION_ID, _NEWEST_VERSION, "catalogue"
        )

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()

    def close(self):
        """Closes the catalogue."""
        self._database.close()

    @property
    def scans(self):
        """The folders of the scans, by name; open one with Session."""
        return sorted(file.parent for file in (self.folder / "scans").glob("*/session.sqlite"))

    def sessions(self):
        """Yields a Session for each scan; each is closed before the next one."""
        for folder in self.scans:
            with Session(folder) as session:
                yield session

    @cached_property
    def classes(self):
        """The CatalogueClasses, by id, without those that are hidden or merged into another."""
        return [one for one, hidden in self._all_classes.values() if not hidden]

    @cached_property
    def objects(self):
        """The CatalogueObjects, by id, without those that were removed or merged into another."""
        rows = self._database.execute("SELECT * FROM objects WHERE hidden = 0 ORDER BY id").fetchall()
        has_classes = has_column(self._database, "objects", "class")
        return [
            CatalogueObject(self, row, self._class_of(row["class"]) if has_classes else None)
            for row in rows
        ]

    def _read_name(self):
        for file in (self.folder / name for name in _PROJECT_FILES):
            if not file.is_file():
                continue
            try:
                project = json.loads(file.read_text("utf-8"))
                version, name = project["scantrove_project"], project.get("name", "")
                server = project.get("catalogue")
            except (OSError, ValueError, KeyError, TypeError, AttributeError) as error:
                raise ScantroveError(f"{file} is damaged: it is no project of Scantrove.") from error
            if version > _NEWEST_PROJECT:
                raise ScantroveError(
                    f"The project {self.folder} was written by a newer Scantrove. Update the module scantrove."
                )
            if server is not None:
                raise ScantroveError(
                    f"The catalogue of the project {self.folder} is on a server, which this module does not read. "
                    "Open single scans with Session, or copy the catalogue into a project of its own with "
                    "'scantrove objects copy'."
                )
            return name or self.folder.name
        raise ScantroveError(
            f"{self.folder} is no project: it has no {_PROJECT_FILES[0]}. Open a single scan with Session."
        )

    @cached_property
    def _all_classes(self):
        """(CatalogueClass, hidden) by id."""
        if not has_table(self._database, "classes"):
            return {}
        rows = self._database.execute("SELECT * FROM classes ORDER BY id").fetchall()
        return {
            row["id"]: (
                CatalogueClass(row["id"], row["name"], row["color"], row["supercategory"]),
                bool(row["hidden"]),
            )
            for row in rows
        }

    @cached_property
    def _merged_classes(self):
        if not has_table(self._database, "classes"):
            return {}
        query = "SELECT id, merged_into FROM classes WHERE merged_into IS NOT NULL"
        return dict(self._database.execute(query).fetchall())

    def _class_of(self, id):
        seen = set()
        while id in self._merged_classes and id not in seen:
            seen.add(id)
            id = self._merged_classes[id]
        return self._all_classes[id][0] if id in self._all_classes else None

    def _views(self, object_id):
        rows = self._database.execute(
            "SELECT id, frame_index, pose, color, mask, depth_mm FROM views WHERE object = ? ORDER BY id",
            (object_id,),
        )
        for row in rows.fetchall():
            name = f"of view {row['id']} in {self.folder / 'catalogue.sqlite'}"
            pose = np.eye(4)
            pose[:3] = np.array([float(number) for number in row["pose"].split()]).reshape(3, 4)
            yield View(
                frame_index=row["frame_index"],
                T_world_camera=pose,
                color=decode_image(row["color"], name),
                mask=decode_image(row["mask"], name) > 0,
                depth=decode_image(row["depth_mm"], name).astype(np.float32) / 1000,
            )
