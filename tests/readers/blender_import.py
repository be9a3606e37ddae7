"""Imports files in Blender and prints what it found: blender -b --python blender_import.py -- FILE..."""

import json
import sys

import bpy
import numpy

numpy.bool = bool  # Debian 12: Blender's importer of glTF is older than its numpy

for file in sys.argv[sys.argv.index("--") + 1 :]:
    bpy.ops.wm.read_factory_settings(use_empty=True)
    if file.endswith(".glb"):
        bpy.ops.import_scene.gltf(filepath=file)
    else:
        bpy.ops.import_scene.obj(filepath=file)
    meshes = [one.data for one in bpy.data.objects if one.type == "MESH"]
    images = [one for one in bpy.data.images if one.size[0] > 0]
    means = [sum(one.pixels[0 : 4 * 4096]) / (4 * 4096) for one in images]
    print("imported", json.dumps({"faces": sum(len(one.polygons) for one in meshes), "image_mean": max(means, default=0)}))
