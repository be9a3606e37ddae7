"""Reads the scans, projects and catalogues of Scantrove. Nothing is ever written.

Units are metres and seconds. Cameras look along +z, with x to the right and y down; pixel centres lie at integer
coordinates. A pose T_world_camera (4 x 4) takes points of the camera's frame to the world of the recording.
"""

from .clouds import read_cloud
from .errors import ScantroveError
from .images import read_image
from .project import CatalogueClass, CatalogueObject, Project, View
from .session import Frame, KeyFrame, PaintedMask, Region, Session

__all__ = [
    "CatalogueClass",
    "CatalogueObject",
    "Frame",
    "KeyFrame",
    "PaintedMask",
    "Project",
    "Region",
    "ScantroveError",
    "Session",
    "View",
    "read_cloud",
    "read_image",
]
