#!/usr/bin/env python3
"""Reads exported data sets without Scantrove and compares them: check_data_sets.py FOLDER

FOLDER has one data set a folder, each named after its format (coco, masks, yolo, ...), all of one scan or all of one
project; `textured` is mesh with --texture, `coco_again` a second export. Formats that are missing are skipped.
Debian: python3-numpy, python3-opencv. assimp-utils, python3-vtk9 and blender read the meshes, too, if they are there.
"""

import json
import re
import shutil
import subprocess
import sys
import unittest
import xml.etree.ElementTree as ElementTree
import zlib
from pathlib import Path

try:
    import cv2
    import numpy as np
except ImportError as error:
    raise SystemExit("numpy or cv2 is not installed: skipped") from error

import decoders

_SCAN_FORMATS = ("boxes", "foundationpose", "mesh", "textured", "ply", "pcd", "tum", "scannet")
_BOX_AXES = np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)])


def read_json(path):
    return json.loads(path.read_text("utf-8"))


def image_of(path):
    image = cv2.imread(str(path), cv2.IMREAD_UNCHANGED)
    if image is None:
        raise ValueError(f"{path} is no image")
    return image


def overlap(a, b):
    return np.count_nonzero(a & b) / max(1, np.count_nonzero(a | b))


def grown(mask, pixels):
    kernel = cv2.getStructuringElement(cv2.MORPH_ELLIPSE, (2 * pixels + 1, 2 * pixels + 1))
    return cv2.dilate(mask.astype(np.uint8), kernel) > 0


def projected(points, K, T):
    """Columns, rows and depths of points that T takes into the camera."""
    points = points @ T[:3, :3].T + T[:3, 3]
    z = np.where(points[:, 2] > 1e-6, points[:, 2], np.nan)
    pixels = points @ np.asarray(K).T
    return pixels[:, 0] / z, pixels[:, 1] / z, z


def on_image(columns, rows, shape):
    """Which points an image shows, and their rows and columns as whole numbers (0, 0 of the others)."""
    with np.errstate(invalid="ignore"):
        is_in = (columns > -0.5) & (rows > -0.5) & (columns < shape[1] - 0.5) & (rows < shape[0] - 0.5)
    rounded = [np.where(is_in, np.rint(np.nan_to_num(values)), 0).astype(int) for values in (rows, columns)]
    return is_in, rounded[0], rounded[1]


class Reader(unittest.TestCase):
    """A test of one format; `at` is its folder."""

    root = Path()
    format = ""

    def setUp(self):
        self.at = self.root / self.format
        if not self.at.is_dir():
            self.skipTest(f"no {self.format} here")

    def check_color(self, path, size=None):
        image = image_of(path)
        self.assertEqual((image.dtype, image.shape[2:]), (np.uint8, (3,)), path)
        if size is not None:
            self.assertEqual((image.shape[1], image.shape[0]), size, path)
        return image

    def check_rigid(self, R, what):
        np.testing.assert_allclose(R @ R.T, np.eye(3), atol=1e-5, err_msg=str(what))
        self.assertGreater(np.linalg.det(R), 0, what)

    def scans(self, name):
        """Folders of the scans in a format that has one for each."""
        return sorted({file.parent for file in self.at.rglob(name)})


class Masks:
    """The images of `masks`: which pixels each region of each scan has."""

    def __init__(self, folder):
        self.files = {path.stem: path for path in (folder / "masks").glob("*.png")}
        self.regions = {}
        for number, label in read_json(folder / "labels.json").items():
            self.regions[label.get("scan"), label["region"]] = (int(number), label)
        self._images = {}

    def image(self, stem):
        if stem not in self._images:
            self._images[stem] = image_of(self.files[stem])
        return self._images[stem]

    def of(self, stem, scan, regions):
        return np.isin(self.image(stem), [self.regions[scan, region][0] for region in regions])


class RecordTest(unittest.TestCase):
    root = Path()

    def test_files_are_those_of_the_record(self):
        for folder in sorted(path for path in self.root.iterdir() if path.is_dir()):
            with self.subTest(folder.name):
                record = {one["path"]: one for one in read_json(folder / ".scantrove-export.json")["files"]}
                files = {str(path.relative_to(folder)) for path in folder.rglob("*") if not path.is_dir()}
                self.assertEqual(files - {".scantrove-export.json"}, set(record))
                for name, one in record.items():
                    content = (folder / name).read_bytes()
                    self.assertEqual((len(content), zlib.crc32(content)), (one["bytes"], one["crc32"]), name)
                    self.assertNotIn("\n", name)
                    self.assertLess(len(Path(name).name.encode()), 160)

    def test_only_regular_files(self):
        for path in self.root.rglob("*"):
            self.assertTrue(path.is_dir() or (path.is_file() and not path.is_symlink()), path)

    def test_splits_have_no_scan_in_common(self):
        for file in sorted(self.root.glob("*/scans.json")):
            with self.subTest(file.parent.name):
                scans = read_json(file)
                self.assertEqual(len({one["scan"] for one in scans}), len(scans))
                if not (file.parent / "annotations").is_dir():
                    continue
                of_split = {one["scan"]: one["split"] for one in scans}
                for instances in (file.parent / "annotations").glob("instances*.json"):
                    split = instances.stem.partition("_")[2] or None
                    for image in read_json(instances)["images"]:
                        self.assertEqual(of_split[image["scan"]], split)


class CocoTest(Reader):
    format = "coco"

    @staticmethod
    def parts(folder):
        return [read_json(path) for path in sorted((folder / "annotations").glob("instances*.json"))]

    def test_masks_boxes_and_ids(self):
        masks = Masks(self.root / "masks") if (self.root / "masks").is_dir() else None
        ids, names, compared = set(), set(), 0
        for part in self.parts(self.at):
            categories = {one["id"]: one["name"] for one in part["categories"]}
            self.assertEqual(len(categories), len(part["categories"]))
            self.assertEqual(len(set(categories.values())), len(categories))
            images = {one["id"]: one for one in part["images"]}
            used = {number: 0 for number in images}
            for image in images.values():
                self.assertNotIn(image["file_name"], names)
                names.add(image["file_name"])
                self.check_color(self.at / "images" / image["file_name"], (image["width"], image["height"]))
            for one in part["annotations"]:
                self.assertNotIn(one["id"], ids)
                ids.add(one["id"])
                self.assertIn(one["category_id"], categories)
                image = images[one["image_id"]]
                mask = decoders.coco_mask(one["segmentation"])
                self.assertEqual(mask.shape, (image["height"], image["width"]))
                rows, columns = np.nonzero(mask)
                self.assertEqual(one["area"], len(rows))
                left, top = int(columns.min()), int(rows.min())
                self.assertEqual(one["bbox"], [left, top, int(columns.max()) - left + 1, int(rows.max()) - top + 1])
                self.assertFalse((mask & (used[image["id"]] != 0)).any(), "masks overlap")
                used[image["id"]] = used[image["id"]] | mask
                if masks is not None:
                    stem = Path(image["file_name"]).stem
                    region = one["attributes"]["region"]
                    np.testing.assert_array_equal(masks.of(stem, image.get("scan"), [region]), mask)
                    compared += np.count_nonzero(mask)
            if masks is not None:
                for image in images.values():
                    np.testing.assert_array_equal(used[image["id"]], masks.image(Path(image["file_name"]).stem) > 0)
        self.assertGreater(len(ids), 0)
        print(f"  coco: {len(names)} images, {len(ids)} masks, {compared} pixels equal those of masks")

    def test_second_export_is_equal(self):
        again = self.root / "coco_again"
        if not again.is_dir():
            self.skipTest("no second export")
        for first, second in zip(self.parts(self.at), self.parts(again), strict=True):
            for one in (first, second):
                del one["info"]
            self.assertEqual(first, second)

    def test_categories_are_those_of_other_formats(self):
        categories = sorted((one["id"], one["name"]) for one in self.parts(self.at)[0]["categories"])
        names = [name for _, name in categories]
        if (self.root / "yolo").is_dir():
            self.assertEqual(YoloTest.names(self.root / "yolo"), names)
        if (self.root / "voc").is_dir():
            expected = ["".join("_" if c in ":#" else " " if c < " " else c for c in name) for name in names]
            self.assertEqual(VocTest.names(self.root / "voc"), expected)
        if (self.root / "labelstudio").is_dir():
            self.assertEqual(LabelStudioTest.names(self.root / "labelstudio"), names)
        if (self.root / "masks").is_dir():
            for label in read_json(self.root / "masks/labels.json").values():
                if label["category_id"] is not None:
                    self.assertIn((label["category_id"], label["category"]), categories)
        for file in self.root.glob("boxes/**/_classes.json"):
            self.assertEqual([(one["id"], one["name"]) for one in read_json(file)["classes"]], categories)


class MasksTest(Reader):
    format = "masks"

    def test_images_and_masks_belong_together(self):
        masks = Masks(self.at)
        colors = {path.stem: path for path in (self.at / "color").iterdir()}
        self.assertEqual(set(colors), set(masks.files))
        numbers = {number for number, _ in masks.regions.values()} | {0, 65535}
        for stem, path in colors.items():
            mask = masks.image(stem)
            self.assertEqual(mask.dtype, np.uint16)
            self.check_color(path, mask.shape[1::-1])
            self.assertLessEqual(set(np.unique(mask).tolist()), numbers)
        lists = [set((self.at / f"{split}.txt").read_text().split()) for split in ("train", "val", "test")
                 if (self.at / f"{split}.txt").exists()]
        if lists:
            self.assertEqual(sum(len(one) for one in lists), len(set().union(*lists)))
            self.assertEqual(set().union(*lists), set(colors))


def instance_masks(masks, stem, legend, scan_of_stem):
    """Masks of the instances in an image by number, for legends with `regions`."""
    found = {}
    for number, one in legend.items():
        if one.get("scan") == scan_of_stem:
            mask = masks.of(stem, one.get("scan"), one["regions"])
            if mask.any():
                found[number] = mask
    return found


def scan_of(folder, stem):
    """The scan of an image of a project's data set, by the prefix of its name."""
    file = folder / "scans.json"
    if not file.exists():
        return None
    return next(one["scan"] for one in read_json(file) if stem.startswith(one["prefix"]))


class YoloTest(Reader):
    format = "yolo"

    @staticmethod
    def names(folder):
        text = (folder / "data.yaml").read_text("utf-8").partition("names:\n")[2]
        # A quoted name of YAML is JSON text here.
        found = [re.fullmatch(r"  (\d+): (\".*\")", line) for line in text.rstrip("\n").split("\n")]
        if [int(one[1]) for one in found] != list(range(len(found))):
            raise ValueError("classes are not numbered from 0")
        return [json.loads(one[2]) for one in found]

    def test_polygons_are_the_masks(self):
        masks = Masks(self.root / "masks") if (self.root / "masks").is_dir() else None
        names = self.names(self.at)
        overlaps = []
        stems = set()
        for file in sorted((self.at / "labels").rglob("*.txt")):
            (image_file,) = (self.at / "images" / file.parent.name).glob(f"{file.stem}.*")
            shape = self.check_color(image_file).shape[:2]
            self.assertNotIn(file.stem, stems)
            stems.add(file.stem)
            drawn = []
            for line in file.read_text().splitlines():
                number, *numbers = line.split()
                self.assertLess(int(number), len(names))
                places = np.array(numbers, float).reshape(-1, 2)
                self.assertTrue(((places >= 0) & (places <= 1)).all())
                mask = np.zeros(shape, np.uint8)
                cv2.fillPoly(mask, [(places * shape[::-1]).astype(np.int32)], 1)  # as ultralytics draws them
                drawn.append(mask > 0)
            if masks is None:
                continue
            expected = {}
            scan = scan_of(self.at, file.stem)
            for (of_scan, region), (_, label) in masks.regions.items():
                if of_scan == scan:
                    key = label["object"] if label["object"] is not None else f"region {region}"
                    expected[key] = expected.get(key, 0) | masks.of(file.stem, scan, [region])
            expected = [mask for mask in expected.values() if mask.any()]
            self.assertEqual(len(drawn), len(expected))
            for mask in expected:
                best = max(range(len(drawn)), key=lambda i: overlap(drawn[i], mask))
                overlaps.append((overlap(drawn.pop(best), mask), np.count_nonzero(mask)))
        if overlaps:
            whole = [one for one, pixels in overlaps if pixels >= 200]
            print(f"  yolo: {len(overlaps)} polygons; least IoU with a mask of 200 pixels and more {min(whole):.3f}")
            self.assertGreater(min(whole), 0.94)
            self.assertGreater(np.median(whole), 0.98)


class VocTest(Reader):
    format = "voc"

    @staticmethod
    def names(folder):
        lines = (folder / "labelmap.txt").read_text("utf-8").splitlines()
        return [line.rsplit(":", 3)[0] for line in lines if line[0] != "#"][1:]

    def test_boxes_and_both_images(self):
        legend = read_json(self.at / "labels.json")
        masks = Masks(self.root / "masks") if (self.root / "masks").is_dir() else None
        objects = 0
        colors = [line.rsplit(":", 3)[1] for line in (self.at / "labelmap.txt").read_text("utf-8").splitlines()[1:]]
        for file in sorted((self.at / "Annotations").glob("*.xml")):
            root = ElementTree.parse(file).getroot()
            size = tuple(int(root.findtext(f"size/{side}")) for side in ("width", "height"))
            self.check_color(self.at / "JPEGImages" / root.findtext("filename"), size)
            of_class = self.colors_to_numbers(self.at / "SegmentationClass" / f"{file.stem}.png", colors)
            places = self.palette_numbers(self.at / "SegmentationObject" / f"{file.stem}.png")
            self.assertEqual(places.max(), len(root.findall("object")))
            expected = instance_masks(masks, file.stem, legend, scan_of(self.at, file.stem)) if masks else {}
            for place, one in enumerate(root.findall("object"), 1):
                rows, columns = np.nonzero(places == place)
                box = [int(one.findtext(f"bndbox/{side}")) for side in ("xmin", "ymin", "xmax", "ymax")]
                self.assertEqual(box, [columns.min() + 1, rows.min() + 1, columns.max() + 1, rows.max() + 1])
                attributes = {a.findtext("name"): a.findtext("value") for a in one.iter("attribute")}
                known = legend[attributes["instance"]]
                self.assertEqual(attributes["name"], known["name"])
                self.assertEqual(one.findtext("name"), known["class"])
                numbers = set(of_class[rows, columns].tolist())
                self.assertEqual(len(numbers), 1)
                if masks is not None:
                    np.testing.assert_array_equal(places == place, expected.pop(attributes["instance"]))
                objects += 1
            self.assertEqual(expected, {})
        print(f"  voc: {objects} objects in {len(list((self.at / 'Annotations').iterdir()))} images")
        sets = {name: set((self.at / f"ImageSets/Main/{name}.txt").read_text().split()) for name in ("train", "val")}
        self.assertFalse(sets["train"] & sets["val"] and sets["train"] != sets["val"])

    @staticmethod
    def colors_to_numbers(path, colors):
        image = image_of(path)[:, :, ::-1].astype(int)  # cv2 resolves palettes
        numbers = np.full(image.shape[:2], -1)
        for number, color in enumerate(colors):
            numbers[(image == [int(part) for part in color.split(",")]).all(axis=2)] = number
        return numbers

    @staticmethod
    def palette_numbers(path):
        """Palette indices: the PNG read as the specification says, without cv2, which resolves palettes."""
        data, at, idat, header = path.read_bytes(), 8, b"", None
        while at < len(data):
            size, kind = int.from_bytes(data[at : at + 4], "big"), data[at + 4 : at + 8]
            chunk = data[at + 8 : at + 8 + size]
            header = chunk if kind == b"IHDR" else header
            idat += chunk if kind == b"IDAT" else b""
            at += size + 12
        width, height = (int.from_bytes(header[i : i + 4], "big") for i in (0, 4))
        if (header[8], header[9], header[12]) != (8, 3, 0):
            raise ValueError(f"{path} is no palette image of 8 bits")
        lines = np.frombuffer(zlib.decompress(idat), np.uint8).reshape(height, width + 1)
        image = np.zeros((height, width), np.uint8)
        above = np.zeros(width, np.uint8)
        for row, line in enumerate(lines):
            kind, values = line[0], line[1:]
            if kind == 0:
                above = values
            elif kind == 1:
                above = np.cumsum(values, dtype=np.uint8)
            elif kind == 2:
                above = values + above
            else:
                raise ValueError(f"{path}: filter {kind} is not read here")
            image[row] = above
        return image


class LabelStudioTest(Reader):
    format = "labelstudio"

    @staticmethod
    def names(folder):
        return [one.get("value") for one in ElementTree.parse(folder / "label-config.xml").iter("Label")]

    def test_brushes_are_the_masks(self):
        names, legend = self.names(self.at), read_json(self.at / "labels.json")
        masks = Masks(self.root / "masks") if (self.root / "masks").is_dir() else None
        brushes = 0
        for task in read_json(self.at / "tasks.json"):
            file = self.at / task["data"]["image"].partition("?d=")[2]
            shape = self.check_color(file).shape[:2]
            scan = scan_of_task = None
            if (self.at / "scans.json").exists():
                scan = scan_of_task = task["data"]["scan"]
            expected = instance_masks(masks, file.stem, legend, scan_of_task) if masks else {}
            for one in task["annotations"][0]["result"]:
                self.assertEqual((one["original_height"], one["original_width"]), shape)
                self.assertIn(one["value"]["brushlabels"][0], names)
                mask = decoders.brush_mask(one["value"]["rle"], *shape)
                number = one["id"].split("-")[1]
                self.assertEqual(legend[number].get("scan"), scan)
                if masks is not None:
                    np.testing.assert_array_equal(mask, expected.pop(number))
                brushes += 1
            self.assertEqual(expected, {})
        print(f"  labelstudio: {brushes} brush masks")


class BopTest(Reader):
    format = "bop"

    def surface_of(self, label):
        """The same object in the meshes; None if they are not there."""
        folder = self.root / "mesh"
        if "scan" in label and folder.is_dir():
            folder /= next(one["folder"] for one in read_json(folder / "scans.json") if one["scan"] == label["scan"])
        files = list((folder / "objects").glob(f"{label['region']:06}*.ply"))
        return decoders.xyz(decoders.ply(files[0])["vertex"]) if files else None

    def test_poses_masks_and_models(self):
        infos = read_json(self.at / "models/models_info.json")
        labels = read_json(self.at / "labels.json")
        models = {}
        for number, info in infos.items():
            points = decoders.xyz(decoders.ply(self.at / f"models/obj_{int(number):06}.ply")["vertex"])
            low, high = points.min(axis=0), points.max(axis=0)
            np.testing.assert_allclose(low, [info["min_x"], info["min_y"], info["min_z"]], atol=0.01)
            np.testing.assert_allclose(high - low, [info["size_x"], info["size_y"], info["size_z"]], atol=0.01)
            np.testing.assert_allclose(low + high, 0, atol=0.05)  # centred
            self.assertLessEqual(info["diameter"], np.linalg.norm(high - low) + 0.1)
            self.assertGreaterEqual(info["diameter"], (high - low).max() - 0.1)
            models[number] = points
            surface = self.surface_of(labels[number])
            if surface is not None:  # in metres and along other axes
                self.assertEqual(len(surface), len(points))
                np.testing.assert_allclose(np.linalg.norm(points - points.mean(axis=0), axis=1),
                                           1000 * np.linalg.norm(surface - surface.mean(axis=0), axis=1), atol=0.5)
        instances, least = 0, 1.0
        for scene in sorted(file.parent for file in self.at.rglob("scene_gt.json")):
            cameras, truth, details = (read_json(scene / f"scene_{name}.json") for name in ("camera", "gt", "gt_info"))
            images = {int(path.stem.rpartition("_")[2]): path for path in (scene / "rgb").iterdir()}
            self.assertEqual(set(images), {int(key) for key in cameras})
            self.assertEqual(set(truth), set(cameras))
            for key, camera in cameras.items():
                image = self.check_color(images[int(key)])
                depth = image_of(scene / "depth" / f"{images[int(key)].stem}.png")
                self.assertEqual((depth.dtype, depth.shape), (np.uint16, image.shape[:2]))
                z_mm = depth * camera["depth_scale"]
                K = np.array(camera["cam_K"]).reshape(3, 3)
                self.check_rigid(np.array(camera["cam_R_w2c"]).reshape(3, 3), key)
                for place, (one, info) in enumerate(zip(truth[key], details[key], strict=True)):
                    T = np.eye(4)
                    T[:3, :3] = np.array(one["cam_R_m2c"]).reshape(3, 3)
                    T[:3, 3] = one["cam_t_m2c"]
                    self.check_rigid(T[:3, :3], key)
                    name = f"{images[int(key)].stem}_{place:06}.png"
                    visible, whole = (image_of(scene / kind / name) > 0 for kind in ("mask_visib", "mask"))
                    self.assertFalse((visible & ~whole).any())
                    self.assertEqual(np.count_nonzero(visible), info["px_count_visib"])
                    self.assertAlmostEqual(info["visib_fract"], info["px_count_visib"] / info["px_count_all"], 5)
                    self.assertEqual(np.count_nonzero(whole & (depth > 0)), info["px_count_valid"])
                    columns, rows, z = projected(models[str(one["obj_id"])], K, T)
                    is_in, rows, columns = on_image(columns, rows, visible.shape)
                    if np.count_nonzero(is_in) < 50:
                        continue
                    inside = grown(whole, 3)[rows[is_in], columns[is_in]].mean()
                    least = min(least, inside)
                    self.assertGreaterEqual(inside, 0.95, f"{scene.name} {name}")
                    # The surface that the depth image shows: vertices within 20 mm of it.
                    seen = is_in & (np.abs(z_mm[rows, columns] - z) < 20)
                    seen &= visible[rows, columns]
                    instances += 1
                    if info["px_count_visib"] > 500:
                        self.assertGreater(np.count_nonzero(seen), 20, f"{scene.name} {name}: lengths in millimetres")
        self.assertGreater(instances, 0)
        print(f"  bop: {len(models)} models, {instances} instances; least part of a model on its mask {least:.3f}")


class FoundationPoseTest(Reader):
    format = "foundationpose"

    def test_models_lie_on_masks(self):
        folders = [file.parent for file in sorted(self.at.rglob("cam_K.txt"))]
        self.assertGreater(len(folders), 0)
        parts = []
        for folder in folders:
            self.assertNotIn("rgb", str(folder.relative_to(self.at)))
            K = np.loadtxt(folder / "cam_K.txt")
            model = decoders.obj(folder / "mesh/model.obj")["v"][:, :3]
            np.testing.assert_allclose(model.min(axis=0) + model.max(axis=0), 0, atol=1e-4)
            self.assertTrue(0.003 < np.ptp(model, axis=0).max() < 6, "metres")
            stems = [{path.stem for path in (folder / kind).iterdir()} for kind in ("rgb", "depth", "masks", "ob_in_cam")]
            self.assertTrue(all(one == stems[0] for one in stems))
            for stem in sorted(stems[0]):
                T = np.loadtxt(folder / "ob_in_cam" / f"{stem}.txt")
                self.check_rigid(T[:3, :3], folder)
                np.testing.assert_array_equal(T[3], [0, 0, 0, 1])
                mask = image_of(folder / "masks" / f"{stem}.png")
                depth = image_of(folder / "depth" / f"{stem}.png")
                self.check_color(folder / "rgb" / f"{stem}.png", mask.shape[1::-1])
                self.assertEqual((depth.dtype, depth.shape), (np.uint16, mask.shape))
                self.assertLessEqual(set(np.unique(mask).tolist()), {0, 255})
                columns, rows, z = projected(model, K, T)
                is_in, rows, columns = on_image(columns, rows, mask.shape)
                seen = is_in & (np.abs(depth[rows, columns] / 1000 - z) < 0.015)  # others are occluded or at the back
                if np.count_nonzero(seen) < 50:
                    continue
                part = grown(mask > 0, 3)[rows[seen], columns[seen]].mean()
                parts.append((part, np.count_nonzero(mask), f"{folder.name} {stem}"))
        # Things that are 30 pixels wide are so far away that the noise of depth is larger than the bound for it.
        large, small = ([one for one in parts if (one[1] >= 1000) == is_large] for is_large in (True, False))
        print(f"  foundationpose: {len(folders)} folders; least visible part of a model on its mask "
              f"{min(large, default=(1,))[0]:.3f} in {len(large)} images, {min(small, default=(1,))[0]:.3f} in "
              f"{len(small)} where it has less than 1000 pixels")
        self.assertEqual([one for one in large if one[0] < 0.95], [])
        self.assertEqual([one for one in small if one[0] < 0.8], [])


class BoxesTest(Reader):
    format = "boxes"

    def test_boxes_hold_their_points(self):
        count = 0
        for scan in self.scans("boxes.json"):
            listed = read_json(scan / "boxes.json")
            T = np.array(listed["T_world_scene"])
            self.check_rigid(T[:3, :3], scan)
            np.testing.assert_array_equal(T[3], [0, 0, 0, 1])
            vertices = decoders.ply(scan / "pointclouds/scene.ply")["vertex"]
            points = decoders.xyz(vertices)
            cloud_boxes = read_json(scan / "labels/scene.json")["objects"]
            by_number = {}
            for box, same in zip(listed["boxes"], cloud_boxes, strict=True):
                yaw = np.radians(box["yaw_deg"])
                R = np.array([[np.cos(yaw), -np.sin(yaw), 0], [np.sin(yaw), np.cos(yaw), 0], [0, 0, 1]])
                own = points[np.isin(vertices["label"], box["regions"])]
                half = np.array(box["size_m"]) / 2
                local = (own - box["center_m"]) @ R
                # Each side leaves half a percent of the surface out.
                is_inside = (np.abs(local) <= half + 0.002).all(axis=1)
                self.assertGreaterEqual(is_inside.mean(), 0.96, box["name"])
                self.assertGreaterEqual(box["size_m"][0], box["size_m"][1])
                self.assertEqual(same["name"], box["class"])
                np.testing.assert_allclose([same["centroid"][axis] for axis in "xyz"], box["center_m"])
                np.testing.assert_allclose([same["dimensions"][side] for side in ("length", "width", "height")],
                                           box["size_m"])
                self.assertAlmostEqual(same["rotations"]["z"], box["yaw_deg"])
                by_number[box["instance"]] = (R, half, np.array(box["center_m"]))
                count += 1
            self.check_frames(scan, points, by_number)
        self.assertGreater(count, 0)
        print(f"  boxes: {count}")

    def check_frames(self, scan, points, boxes):
        for folder in sorted((scan / "sunrgbd").iterdir()):
            K = np.loadtxt(folder / "intrinsics.txt")
            turned = image_of(folder / "depth" / f"{folder.name}.png")
            self.assertEqual(turned.dtype, np.uint16)
            z = ((turned >> 3) | (turned << 13)) / 1000
            self.check_color(folder / "image" / f"{folder.name}.jpg", z.shape[1::-1])
            R_level_camera = np.loadtxt(folder / "extrinsics" / f"{folder.name}.txt")[:, :3]
            self.check_rigid(R_level_camera, folder)
            annotation = read_json(folder / "annotation3Dfinal/index.json")
            T = np.array(annotation["T_level_scene"])
            self.check_rigid(T[:3, :3], folder)
            np.testing.assert_allclose(T[1, :3], [0, 0, -1], atol=1e-5)  # y points down
            T_camera_scene = np.eye(4)
            T_camera_scene[:3] = R_level_camera.T @ T[:3]
            columns, rows, of_points = projected(points, K, T_camera_scene)
            is_in, rows, columns = on_image(columns, rows, z.shape)
            is_in &= z[rows, columns] > 0
            nearest = np.abs(z[rows[is_in], columns[is_in]] - of_points[is_in])
            self.assertLess(np.quantile(nearest, 0.3), 0.02, f"{folder}: depth and surface do not fit")
            for one in annotation["objects"]:
                R, half, center = boxes[one["instance"]]
                corners = (_BOX_AXES * half) @ R.T + center
                corners = corners @ T[:3, :3].T + T[:3, 3]
                (polygon,) = one["polygon"]
                self.assertAlmostEqual(polygon["Ymin"], corners[:, 1].max(), 5)
                self.assertAlmostEqual(polygon["Ymax"], corners[:, 1].min(), 5)
                base = np.stack([polygon["X"], polygon["Z"]], axis=1)
                for corner in corners[:, [0, 2]]:
                    self.assertLess(np.abs(base - corner).max(axis=1).min(), 1e-5)


class MeshTest(Reader):
    format = "mesh"

    def surfaces(self):
        stems = sorted(path.with_suffix("") for path in self.at.rglob("*.ply"))
        self.assertGreater(len(stems), 1)
        return stems

    def test_ply_obj_and_glb_are_the_same_surface(self):
        faces = 0
        for stem in self.surfaces():
            with self.subTest(stem.name):
                from_ply = decoders.ply(Path(f"{stem}.ply"))
                points = decoders.xyz(from_ply["vertex"])
                from_obj, from_glb = decoders.obj(Path(f"{stem}.obj")), decoders.glb(Path(f"{stem}.glb"))
                np.testing.assert_allclose(from_obj["v"][:, :3], points, atol=1e-4)
                np.testing.assert_array_equal(from_obj["f"], from_ply["face"])
                self.assertEqual(sum(len(part["f"]) for part in from_glb["parts"]), len(from_ply["face"]))
                for part in from_glb["parts"]:
                    self.assertTrue((part["f"] < len(part["v"])).all())
                if len(from_glb["parts"]) == 1:  # a rotation between: distances of corners stay
                    corners = points[from_ply["face"]]
                    turned = from_glb["parts"][0]["v"][from_glb["parts"][0]["f"]]
                    np.testing.assert_allclose(np.linalg.norm(corners[:, 0] - corners[:, 1], axis=1),
                                               np.linalg.norm(turned[:, 0] - turned[:, 1], axis=1), atol=1e-4)
                faces += len(from_ply["face"])
        print(f"  {self.format}: {len(self.surfaces())} surfaces, {faces} faces")

    def test_objects_are_parts_of_the_scene(self):
        for scan in self.scans("scene.ply"):
            vertices = decoders.ply(scan / "scene.ply")["vertex"]
            for file in (scan / "objects").glob("*.ply"):
                part = decoders.ply(file)["vertex"]
                # Faces at a border have corners of the neighbour.
                is_own = part["label"] == int(file.name[:6])
                self.assertGreater(is_own.mean(), 0.7, file.name)
                known = {tuple(one) for one in decoders.xyz(vertices)[vertices["label"] == int(file.name[:6])].round(5)}
                self.assertLessEqual({tuple(one) for one in decoders.xyz(part)[is_own].round(5)}, known)

    def test_assimp_reads_them(self):
        if shutil.which("assimp") is None:
            self.skipTest("assimp is not installed")
        read = 0
        for stem in self.surfaces():
            faces = len(decoders.ply(Path(f"{stem}.ply"))["face"])
            for ending in ("ply", "obj", "glb"):
                run = subprocess.run(["assimp", "info", f"{stem}.{ending}"], capture_output=True, text=True, check=False,
                                     errors="replace")
                found = re.search(r"^Faces: +(\d+)", run.stdout, re.MULTILINE)
                self.assertTrue(found, f"{stem}.{ending}: {run.stdout}{run.stderr}")
                self.assertEqual(int(found[1]), faces, f"{stem}.{ending}")
                read += 1
        print(f"  {self.format}: assimp reads {read} files")

    def test_vtk_reads_them(self):
        try:
            from vtkmodules.vtkIOGeometry import vtkGLTFReader, vtkOBJReader
            from vtkmodules.vtkIOPLY import vtkPLYReader
        except ImportError:
            self.skipTest("vtk is not installed")
        for stem in self.surfaces():
            faces = len(decoders.ply(Path(f"{stem}.ply"))["face"])
            for ending, kind in (("ply", vtkPLYReader), ("obj", vtkOBJReader), ("glb", vtkGLTFReader)):
                reader = kind()
                reader.SetFileName(f"{stem}.{ending}")
                reader.Update()
                output = reader.GetOutput()
                if ending == "glb":
                    blocks, found = output.NewIterator(), 0
                    while not blocks.IsDoneWithTraversal():
                        found += blocks.GetCurrentDataObject().GetNumberOfCells()
                        blocks.GoToNextItem()
                else:
                    found = output.GetNumberOfCells()
                self.assertEqual(found, faces, f"{stem}.{ending}")

    def test_blender_imports_them(self):
        if shutil.which("blender") is None:
            self.skipTest("blender is not installed")
        files = [f"{stem}.{ending}" for stem in self.surfaces()[:4] for ending in ("obj", "glb")]
        script = Path(__file__).with_name("blender_import.py")
        run = subprocess.run(["blender", "-b", "--factory-startup", "--python-exit-code", "3", "--python", script, "--",
                              *files], capture_output=True, text=True, check=False, errors="replace", timeout=600)
        found = [json.loads(line[9:]) for line in run.stdout.splitlines() if line.startswith("imported ")]
        self.assertEqual(len(found), len(files), run.stdout[-2000:] + run.stderr[-2000:])
        for file, one in zip(files, found, strict=True):
            expected = decoders.ply(Path(file).with_suffix(".ply"))["face"]
            self.assertAlmostEqual(one["faces"] / len(expected), 1, delta=0.01, msg=file)  # drops doubles
            if self.format == "textured":
                self.assertGreater(one["image_mean"], 0.02, file)
        print(f"  {self.format}: Blender imports {len(found)} files")


class TexturedTest(MeshTest):
    format = "textured"

    def test_textures_are_there_and_not_black(self):
        darkest = 255.0
        for stem in self.surfaces():
            with self.subTest(stem.name):
                surface = decoders.obj(Path(f"{stem}.obj"))
                material = decoders.mtl(stem.parent / surface["mtllib"])
                self.assertEqual(material["newmtl"], surface["usemtl"])
                image = self.check_color(stem.parent / material["map_Kd"])
                self.assertLessEqual(max(image.shape[:2]), 4096)
                places = surface["vt"][surface["ft"]]
                self.assertEqual(len(places), len(surface["f"]))
                self.assertTrue(((places >= 0) & (places <= 1)).all())
                middles = places.mean(axis=1) * [1, -1] + [0, 1]
                pixels = np.minimum(middles * image.shape[1::-1], [image.shape[1] - 1, image.shape[0] - 1]).astype(int)
                shown = image[pixels[:, 1], pixels[:, 0]].max(axis=1)
                self.assertLess((shown == 0).mean(), 0.01, "black faces")
                darkest = min(darkest, shown.mean())
                embedded = decoders.glb(Path(f"{stem}.glb"))
                self.assertEqual(embedded["image"], (stem.parent / material["map_Kd"]).read_bytes())
                for part in embedded["parts"]:
                    self.assertTrue(((part["uv"] >= 0) & (part["uv"] <= 1)).all())
        print(f"  textured: darkest mean of a surface {darkest:.0f} of 255")


class CloudsTest(Reader):
    format = "ply"

    def test_both_clouds_are_equal(self):
        points = 0
        for scan in self.scans("cloud.ply"):
            cloud = decoders.ply(scan / "cloud.ply")["vertex"]
            labels = {int(number) for number in read_json(scan / "labels.json")} | {0}
            self.assertLessEqual(set(np.unique(cloud["label"]).tolist()), labels)
            self.assertLessEqual(set(np.unique(cloud["estimated"]).tolist()), {0, 1})
            self.assertTrue((np.diff(cloud["estimated"].astype(int)) >= 0).all(), "estimated points come last")
            points += len(cloud)
            other = self.root / "pcd" / scan.relative_to(self.at) / "cloud.pcd"
            if not other.exists():
                continue
            same, viewpoint = decoders.pcd(other)
            np.testing.assert_array_equal(decoders.xyz(same), decoders.xyz(cloud))
            np.testing.assert_array_equal(same["label"], cloud["label"])
            np.testing.assert_array_equal(same["rgba"] >> 16 & 255, cloud["red"])
            np.testing.assert_array_equal(same["rgba"] & 255, cloud["blue"])
            self.assertAlmostEqual(np.linalg.norm(viewpoint[3:]), 1, 5)
        print(f"  ply: {points} points")


class TumTest(Reader):
    format = "tum"

    def test_poses(self):
        for scan in self.scans("trajectory.txt"):
            poses = np.loadtxt(scan / "trajectory.txt", ndmin=2)
            self.assertEqual(poses.shape[1], 8)
            self.assertTrue((np.diff(poses[:, 0]) > 0).all())
            np.testing.assert_allclose(np.linalg.norm(poses[:, 4:], axis=1), 1, atol=1e-5)


class ScannetTest(Reader):
    format = "scannet"

    def test_segments_are_of_the_mesh(self):
        for scan in self.scans("*.aggregation.json"):
            (file,) = scan.glob("*.aggregation.json")
            name = file.name.removesuffix(".aggregation.json")
            groups = read_json(file)
            segments = read_json(scan / groups["segmentsFile"])["segIndices"]
            vertices = decoders.ply(scan / f"{name}_vh_clean_2.ply")["vertex"]
            self.assertEqual(len(segments), len(vertices))
            present, taken = set(segments), set()
            for place, group in enumerate(groups["segGroups"]):
                self.assertEqual((group["id"], group["objectId"]), (place, place))
                self.assertLessEqual(set(group["segments"]), present)
                self.assertFalse(set(group["segments"]) & taken)
                taken |= set(group["segments"])


if __name__ == "__main__":
    Reader.root = RecordTest.root = Path(sys.argv.pop(1))
    unittest.main()
