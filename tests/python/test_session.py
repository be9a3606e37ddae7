"""Reads sessions that the test writes with the schema of the program."""

import json
import sqlite3
import struct
import tempfile
import unittest
import uuid
import zlib
from pathlib import Path

try:
    import numpy as np
except ImportError as error:
    raise unittest.SkipTest("numpy is not installed") from error

import scantrove
from scantrove.images import decode_image

ROOT = Path(__file__).resolve().parents[2]


def write_schema(file, folder, extra=()):
    """A database with all steps of the schema in the folder, and its version."""
    connection = sqlite3.connect(file)
    # The program replaces this name, see core/database/sql_dialect.h.
    connection.create_function("random_uuid", 0, lambda: str(uuid.uuid4()))
    steps = sorted((ROOT / folder).glob("*.sql"))
    for step in steps:
        connection.executescript(step.read_text("utf-8"))
    for statement in extra:
        connection.executescript(statement)
    connection.execute(f"PRAGMA user_version = {len(steps)}")
    connection.commit()
    return connection


def png_of(rows, kind, bits, method):
    """A PNG whose rows all have the filter `method`; `rows`: lists of bytes."""
    step = (3 if kind == 2 else 1) * bits // 8
    packed, above = b"", [0] * len(rows[0])
    for row in rows:
        left = [0] * step + row[:-step]
        corner = [0] * step + above[:-step]
        guesses = []
        for a, b, c in zip(left, above, corner, strict=True):
            nearest = min((abs(b - c), 0, a), (abs(a - c), 1, b), (abs(a + b - 2 * c), 2, c))[2]
            guesses.append([0, a, b, (a + b) // 2, nearest][method])
        packed += bytes([method]) + bytes((x - g) % 256 for x, g in zip(row, guesses, strict=True))
        above = row
    width = len(rows[0]) // step

    def chunk(name, data):
        body = name + data
        return struct.pack(">I", len(data)) + body + struct.pack(">I", zlib.crc32(body))

    header = struct.pack(">IIBBBBB", width, len(rows), bits, kind, 0, 0, 0)
    return (
        b"\x89PNG\r\n\x1a\n"
        + chunk(b"IHDR", header)
        + chunk(b"IDAT", zlib.compress(packed))
        + chunk(b"IEND", b"")
    )


class Images(unittest.TestCase):
    def test_every_filter_gives_the_same_pixels(self):
        rows = [[(7 * x * x + 31 * y + 5 * x * y) % 256 for x in range(12)] for y in range(6)]
        for method in range(5):
            grey = decode_image(png_of(rows, 0, 8, method), "grey")
            self.assertTrue((grey == np.array(rows)).all(), method)
            color = decode_image(png_of(rows, 2, 8, method), "colour")
            self.assertTrue((color == np.array(rows).reshape(6, 4, 3)).all(), method)
            deep = decode_image(png_of(rows, 0, 16, method), "depth")
            expected = 256 * np.array(rows)[:, ::2] + np.array(rows)[:, 1::2]
            self.assertEqual(deep.dtype, np.uint16)
            self.assertTrue((deep == expected).all(), method)

    def test_a_damaged_image_is_named(self):
        whole = png_of([[1, 2, 3]], 0, 8, 0)
        with self.assertRaisesRegex(scantrove.ScantroveError, "cup.png is damaged"):
            decode_image(whole[:45], "cup.png")


class SessionTest(unittest.TestCase):
    def setUp(self):
        self.home = tempfile.TemporaryDirectory()
        self.folder = Path(self.home.name) / "kitchen? #1"
        (self.folder / "keyframes").mkdir(parents=True)

    def tearDown(self):
        self.home.cleanup()

    def write(self, extra=()):
        database = write_schema(self.folder / "session.sqlite", "core/session/schema", extra)
        objects = {
            "5": {"object": 3, "name": "mug 2", "by_person": True, "confirmed": True, "deleted": False, "class": "mug"},
            "6": {"object": 4, "name": "Obj_4", "by_person": False, "confirmed": False, "deleted": True},
        }
        facts = {
            "source": "a recording",
            "camera": json.dumps({"K": [100, 110, 3.5, 2.5], "size": [8, 6]}),
            "origin_m": "1000 -2000 0",
            "objects": json.dumps(objects),
        }
        database.executemany("INSERT INTO facts (name, value) VALUES (?, ?)", facts.items())
        half = 0.5**0.5  # a quarter turn about z takes x to y
        database.execute(
            "INSERT INTO frames (number, source_index, time_s, state, tx, ty, tz, qx, qy, qz, qw) "
            "VALUES (0, 120, 4.0, 'tracking', 1, 2, 3, 0, 0, ?, ?)",
            (half, half),
        )
        database.execute(
            "INSERT INTO frames VALUES (1, 121, 4.1, 'lost', 0, 0, 0, 0, 0, 0, 1, NULL, 50, 55, 2, 1, 4, 3)"
        )
        color = {
            "size": [16, 12],
            "K": [60, 61, 3.5, 2.5],
            "K_size": [8, 6],
            "T_color_depth": [1, 0, 0, -0.05, 0, 1, 0, 0, 0, 0, 1, 0],
        }
        database.execute(
            "INSERT INTO key_frames (number, color_file, depth_file, metres_per_unit, color) VALUES "
            "(0, 'keyframes/0.color.png', 'keyframes/0.depth.png', 0.0002, ?)",
            (json.dumps(color),),
        )
        database.execute(
            "INSERT INTO key_frames (number, color_file, depth_file, metres_per_unit, color) VALUES "
            "(1, '', 'keyframes/1.depth.png', 0.001, '{\"size\": [0, 0]}')"
        )
        rows = [[b for x in range(8) for b in (y, 10 * x)] for y in range(6)]
        (self.folder / "keyframes/0.depth.png").write_bytes(png_of(rows, 0, 16, 2))
        database.executemany(
            "INSERT INTO fragments (fragment, region, voxels) VALUES (?, ?, ?)",
            [(1, 5, 10), (2, 5, 20), (3, 6, 7), (4, 0, 99), (5, 9, 4)],
        )
        database.executemany(
            "INSERT INTO regions (region, object, name, category, background, is_object, rejected) "
            "VALUES (?, 0, ?, ?, ?, 0, 0)",
            [(5, "old name", "", 0), (9, "table", "furniture", 1)],
        )
        return database

    def operation(self, database, number, kind, state="done", effect=None, **more):
        operation = {"kind": kind, "regions": [5], **more}
        database.execute(
            "INSERT INTO operations (number, state, operation, effect, done) VALUES (?, ?, ?, ?, '')",
            (number, state, json.dumps(operation), json.dumps(effect or {})),
        )

    def test_frames_have_poses_in_the_world_of_the_recording(self):
        self.write().commit()
        with scantrove.Session(self.folder) as session:
            self.assertEqual(session.source, "a recording")
            first, second = session.frames
        self.assertEqual((first.index, first.time, first.state, first.size), (120, 4.0, "tracking", (8, 6)))
        point = first.T_world_camera @ np.array([1, 0, 0, 1])
        np.testing.assert_allclose(point, [1001, -1997, 3, 1], atol=1e-12)
        np.testing.assert_allclose(first.K, [[100, 0, 3.5], [0, 110, 2.5], [0, 0, 1]])
        np.testing.assert_allclose(second.K, [[50, 0, 2], [0, 55, 1], [0, 0, 1]])
        self.assertEqual(second.size, (4, 3))
        self.assertTrue(first.is_reliable)
        self.assertFalse(second.is_reliable)

    def test_relocalised_frames_are_reliable(self):
        database = self.write()
        # As core/tracking/pose_estimate.h writes it.
        database.execute("UPDATE frames SET state = 'relocalised' WHERE number = 0")
        database.commit()
        first, _ = scantrove.Session(self.folder).frames
        self.assertTrue(first.is_reliable)

    def test_key_frames_have_cameras_and_depth_in_metres(self):
        self.write().commit()
        key, without_color = scantrove.Session(self.folder).key_frames
        depth = key.depth()
        self.assertEqual(depth.dtype, np.float32)
        self.assertAlmostEqual(float(depth[2, 3]), (2 * 256 + 30) * 0.0002, places=6)
        # Twice as large: pixel centres are integers, so 3.5 becomes (3.5 + 0.5) * 2 - 0.5.
        np.testing.assert_allclose(key.K_color, [[120, 0, 7.5], [0, 122, 5.5], [0, 0, 1]])
        shift = np.linalg.inv(key.frame.T_world_camera) @ key.T_world_color
        np.testing.assert_allclose(shift[:3, 3], [0.05, 0, 0], atol=1e-9)
        self.assertIsNone(without_color.color())
        with self.assertRaisesRegex(scantrove.ScantroveError, "1.depth.png cannot be read"):
            without_color.depth()

    def test_regions_have_names_classes_and_boxes(self):
        self.write().commit()
        points = [(1, 2, 3, 5, 0), (2, 1, 3, 5, 0), (9, 9, 9, 0, 0), (8, 8, 8, 5, 1)]  # the last one is estimated
        header = (
            "ply\nformat binary_little_endian 1.0\ncomment metres\nelement vertex 4\nproperty double x\n"
            "property double y\nproperty double z\nproperty uint label\nproperty uchar estimated\nelement face 0\n"
            "property list uchar int vertex_indices\nend_header\n"
        )
        body = b"".join(struct.pack("<dddIB", *point) for point in points)
        (self.folder / "cloud.ply").write_bytes(header.encode() + body)
        mug, deleted, table = scantrove.Session(self.folder).regions
        self.assertEqual((mug.id, mug.name, mug.class_name, mug.object), (5, "mug 2", "mug", 3))
        self.assertEqual((mug.voxels, mug.confirmed, mug.background), (30, True, False))
        np.testing.assert_array_equal(mug.box, [[1, 1, 3], [2, 2, 3]])
        self.assertEqual((deleted.name, deleted.object, deleted.box), ("", None, None))
        self.assertEqual((table.name, table.class_name, table.background), ("table", "furniture", True))

    def test_painted_masks_are_read_unless_they_were_undone(self):
        database = self.write()
        mask = {"key_frame": 0, "image": 120, "size": [4, 2]}
        for number, state in ((1, "done"), (2, "undone")):
            self.operation(database, number, "paint", state, mask=mask)
            database.execute(
                "INSERT INTO mask_corrections VALUES (?, 4, 2, ?, x'', NULL)", (number, bytes([1, 3]))
            )
        database.commit()
        (painted,) = scantrove.Session(self.folder).key_frames[0].painted
        self.assertEqual(painted.region, 5)
        np.testing.assert_array_equal(painted.added, [[0, 1, 1, 1], [0, 0, 0, 0]])
        self.assertFalse(painted.removed.any())

    def test_painted_masks_are_gone_when_they_were_taken_back(self):
        database = self.write()
        mask = {"key_frame": 0, "image": 120, "size": [4, 2]}
        pixels = "INSERT INTO mask_corrections VALUES (?, 4, 2, ?, x'', NULL)"
        for number, region, anchor in ((1, 5, 1), (2, 6, 3)):
            self.operation(database, number, "paint", effect={"anchor": anchor}, regions=[region], mask=mask)
            database.execute(pixels, (number, bytes([1, 3])))
        self.operation(database, 3, "unpaint", effect={"anchor": 1}, mask=mask)
        database.commit()
        (painted,) = scantrove.Session(self.folder).key_frames[0].painted
        self.assertEqual(painted.region, 6)
        # A join afterwards does not take back what was painted for the joined region.
        self.operation(database, 4, "join", effect={"moves": [[3, 6, 5]]}, regions=[5, 6])
        database.execute("UPDATE fragments SET region = 5 WHERE fragment = 3")
        database.commit()
        (painted,) = scantrove.Session(self.folder).key_frames[0].painted
        self.assertEqual(painted.region, 6)

    def test_a_painted_new_region_is_the_one_that_was_made(self):
        database = self.write()
        mask = {"key_frame": 0, "image": 120, "size": [4, 2], "makes_region": True}
        self.operation(database, 1, "paint", effect={"anchor": 3, "created": [6]}, mask=mask)
        database.execute("INSERT INTO mask_corrections VALUES (1, 4, 2, ?, x'', NULL)", (bytes([1, 3]),))
        database.commit()
        (painted,) = scantrove.Session(self.folder).key_frames[0].painted
        self.assertEqual(painted.region, 6)

    def test_long_runs_have_several_bytes(self):
        from scantrove.session import _runs

        mask = _runs(bytes([0x80 | 44, 2, 3]), 100, 4)  # 44 + 2 * 128 = 300
        self.assertEqual(np.flatnonzero(mask).tolist(), [300, 301, 302])

    def test_reviews_are_read_if_the_session_has_them(self):
        table = (
            "CREATE TABLE IF NOT EXISTS frame_reviews (operation INTEGER PRIMARY KEY, key_frame INTEGER NOT NULL, "
            "state TEXT NOT NULL, row_check INTEGER);"
        )
        database = self.write([table])
        for number, state, review in ((1, "done", "left-out"), (2, "done", "checked"), (3, "undone", "open")):
            self.operation(database, number, "review", state)
            database.execute("INSERT INTO frame_reviews VALUES (?, 0, ?, NULL)", (number, review))
        database.commit()
        first, second = scantrove.Session(self.folder).key_frames
        self.assertEqual((first.review, second.review), ("checked", "open"))

    def test_a_newer_session_is_refused(self):
        database = self.write()
        database.execute("PRAGMA user_version = 99")
        database.commit()
        with self.assertRaisesRegex(scantrove.ScantroveError, "written by a newer Scantrove .*version 99"):
            scantrove.Session(self.folder)

    def test_other_files_are_refused(self):
        with self.assertRaisesRegex(scantrove.ScantroveError, "There is no session at"):
            scantrove.Session(self.folder)
        sqlite3.connect(self.folder / "session.sqlite").execute("CREATE TABLE t (x)").connection.commit()
        with self.assertRaisesRegex(scantrove.ScantroveError, "is no session of Scantrove"):
            scantrove.Session(self.folder)
        (self.folder / "session.sqlite").write_bytes(b"no database at all, but long enough" * 100)
        with self.assertRaisesRegex(scantrove.ScantroveError, "cannot be read"):
            scantrove.Session(self.folder)

    def test_nothing_is_written(self):
        database = self.write()
        database.commit()
        database.close()
        before = {file: file.read_bytes() for file in self.folder.rglob("*") if file.is_file()}
        with scantrove.Session(self.folder) as session:
            self.assertEqual(len(session.regions), 3)
            with self.assertRaises(sqlite3.OperationalError):
                session._database.execute("DELETE FROM regions")
        after = {file: file.read_bytes() for file in self.folder.rglob("*") if file.is_file()}
        self.assertEqual(before, after)


class ProjectTest(unittest.TestCase):
    def setUp(self):
        self.home = tempfile.TemporaryDirectory()
        self.folder = Path(self.home.name)
        database = write_schema(self.folder / "catalogue.sqlite", "core/catalogue/schema")
        database.executemany(
            "INSERT INTO classes (id, name, color, supercategory, hidden, merged_into, created) "
            "VALUES (?, ?, '#ff8000', '', ?, ?, '')",
            [(3, "chair", 0, None), (4, "seat", 1, 3)],
        )
        database.executemany(
            "INSERT INTO objects (id, number, name, confirmed, hidden, size_x_m, size_y_m, size_z_m, created, class) "
            "VALUES (?, ?, ?, 1, ?, 0.5, 0.4, 0.3, '', ?)",
            [(1, 1, "chair 2", 0, 4), (2, 2, "gone", 1, None)],
        )
        pose = "1 0 0 0.5 0 1 0 0 0 0 1 -2"
        images = [png_of([[10, 20, 30, 40, 50, 60]], 2, 8, 1), png_of([[0, 255]], 0, 8, 0)]
        images.append(png_of([[4, 0, 0, 7]], 0, 16, 0))
        database.execute(
            "INSERT INTO views (object, first_object, frame_index, pose, direction_x, direction_y, direction_z, created,"
            " color, mask, depth_mm) VALUES (1, 1, 30, ?, 0, 0, 1, '', ?, ?, ?)",
            (pose, *images),
        )
        database.commit()
        database.close()
        for name in ("b", "a"):
            (self.folder / "scans" / name).mkdir(parents=True)
            write_schema(self.folder / "scans" / name / "session.sqlite", "core/session/schema").close()
        (self.folder / "scans" / "no scan").mkdir()

    def tearDown(self):
        self.home.cleanup()

    def test_both_names_of_the_project_file_are_known(self):
        with self.assertRaisesRegex(scantrove.ScantroveError, "is no project"):
            scantrove.Project(self.folder)
        (self.folder / "project.json").write_text('{"scantrove_project": 1, "name": "old"}')
        self.assertEqual(scantrove.Project(self.folder).name, "old")
        (self.folder / "scantrove-project.json").write_text('{"scantrove_project": 1, "name": "Küche"}', "utf-8")
        self.assertEqual(scantrove.Project(self.folder).name, "Küche")
        (self.folder / "scantrove-project.json").write_text('{"scantrove_project": 3}')
        with self.assertRaisesRegex(scantrove.ScantroveError, "newer Scantrove"):
            scantrove.Project(self.folder)
        (self.folder / "scantrove-project.json").write_text("[]")
        with self.assertRaisesRegex(scantrove.ScantroveError, "is damaged"):
            scantrove.Project(self.folder)

    def test_a_catalogue_on_a_server_is_named_as_the_reason(self):
        project = {"scantrove_project": 2, "name": "lab", "catalogue": "postgresql://lab@host/objects"}
        (self.folder / "scantrove-project.json").write_text(json.dumps(project))
        with self.assertRaisesRegex(scantrove.ScantroveError, "is on a server"):
            scantrove.Project(self.folder)

    def test_the_catalogue_has_objects_classes_and_views(self):
        (self.folder / "scantrove-project.json").write_text('{"scantrove_project": 1, "name": ""}')
        with scantrove.Project(self.folder) as project:
            self.assertEqual([folder.name for folder in project.scans], ["a", "b"])
            self.assertEqual(len(list(project.sessions())), 2)
            self.assertEqual([one.name for one in project.classes], ["chair"])
            (chair,) = project.objects
            (view,) = chair.views()
        self.assertEqual((chair.name, chair.class_.id, chair.confirmed), ("chair 2", 3, True))
        np.testing.assert_array_equal(chair.size, [0.5, 0.4, 0.3])
        np.testing.assert_array_equal(view.color, [[[10, 20, 30], [40, 50, 60]]])
        np.testing.assert_array_equal(view.mask, [[False, True]])
        np.testing.assert_allclose(view.depth, [[1.024, 0.007]])
        np.testing.assert_array_equal(view.T_world_camera[:3, 3], [0.5, 0, -2])


if __name__ == "__main__":
    unittest.main()
