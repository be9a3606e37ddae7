"""Reads a scan of the program: demo_scan_check.py FOLDER, as tests/app/make_demo_scan writes it."""

import json
import sys
import unittest
from pathlib import Path

try:
    import numpy as np
except ImportError as error:
    raise SystemExit("numpy is not installed: skipped") from error

import scantrove


class DemoScan(unittest.TestCase):
    folder = Path()

    @classmethod
    def setUpClass(cls):
        cls.session = scantrove.Session(cls.folder / "scan")

    @classmethod
    def tearDownClass(cls):
        cls.session.close()

    def test_frames_are_those_of_the_trajectory(self):
        reliable = [frame for frame in self.session.frames if frame.is_reliable]
        lines = (self.folder / "scan/trajectory.txt").read_text().splitlines()
        poses = [line.split() for line in lines if not line.startswith("#")]
        self.assertEqual(len(self.session.frames), 40)
        self.assertEqual(len(poses), len(reliable))
        for frame, pose in zip(reliable, poses, strict=True):
            np.testing.assert_allclose(frame.T_world_camera[:3, 3], np.array(pose[1:4], float), atol=1e-4)

    def test_depth_and_cloud_have_the_same_surface(self):
        key = self.session.key_frames[0]
        depth = key.depth()
        width, height = key.frame.size
        self.assertEqual(depth.shape, (height, width))
        color = key.color()
        self.assertEqual(color.shape[2], 3)
        cloud = self.session.cloud()
        measured = cloud["xyz"][~cloud["estimated"]]
        in_camera = np.linalg.inv(key.frame.T_world_camera)
        points = measured @ in_camera[:3, :3].T + in_camera[:3, 3]
        K = key.frame.K
        points = points[points[:, 2] > 0.1]
        pixels = np.rint(points @ K.T / points[:, 2:])[:, :2].astype(int)
        is_inside = ((pixels >= 0) & (pixels < [width, height])).all(axis=1)
        z = depth[pixels[is_inside, 1], pixels[is_inside, 0]]
        errors = np.abs(z - points[is_inside, 2])[z > 0]
        self.assertGreater(len(errors), 1000)
        self.assertLess(np.median(errors), 0.02)  # most of the map is seen from the first frame

    def test_regions_are_those_that_the_program_lists(self):
        listed = json.loads((self.folder / "regions.json").read_text())
        listed = listed["regions"] if isinstance(listed, dict) else listed
        known = {region.id: region for region in self.session.regions}
        self.assertGreater(len(listed), 3)
        for region in listed:
            own = known[region["id"]]
            self.assertGreater(own.voxels, 0)
            self.assertEqual(own.name, region["name"])
            self.assertEqual(own.object, region["object"])
            if own.box is not None:  # voxels are 5 to 10 mm wide
                np.testing.assert_allclose(own.box, region["box_m"], atol=0.02)


if __name__ == "__main__":
    DemoScan.folder = Path(sys.argv.pop(1))
    unittest.main()
