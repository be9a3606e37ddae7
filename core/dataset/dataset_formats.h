#pragma once
#include "core/base/result.h"
#include "core/dataset/export_job.h"

namespace scantrove {

// One function and one file export_<format>.cpp for each format. Each writes its files through the job and
// fills in the summary. Errors: as of exportDataset(). NNNNNN is the number of a frame in its source.
// README.md and LICENSE.txt are written for all. In a project, formats with joinsScans() have all scans in
// these files, with prefixed names of images, and bop a scene folder for each (project_export.h).

/// COCO instances (pycocotools, CVAT, FiftyOne):
///     annotations/instances.json   run-length encoded masks, bbox, area, iscrowd 0, attributes
///     images/NNNNNN.jpg or .png    as recorded, if 8-bit RGB (key_frame_images.h)
/// One annotation for each region. Categories are classes of regions (classOf), images are numbered from 1;
/// `attributes` of an annotation are its region, object, name.
[[nodiscard]] Result<void> exportCoco(ExportJob& job);

/// BOP scenewise (bop_toolkit), millimetres, pixel centres at integers:
///     000001/rgb depth NNNNNN.*        depth as the colour camera sees it; depth_scale makes it mm
///     000001/mask mask_visib NNNNNN_MMMMMM.png   MMMMMM: place in the list of scene_gt.json
///     000001/scene_camera.json scene_gt.json scene_gt_info.json
///     models/obj_NNNNNN.ply models_info.json     z up, centre of its box in the origin; obj_id = region
///     id camera.json labels.json
/// One instance for each region; mask/ covers its surface in the map and its visible part in the image.
[[nodiscard]] Result<void> exportBop(ExportJob& job);

/// Ultralytics segments:
///     data.yaml   images/train images/val   labels/train labels/val
/// One line for each instance (export_instances.h).
/// Pieces and holes are joined by bridges (mask_outline.h). Splits: see FrameSplit.
[[nodiscard]] Result<void> exportYolo(ExportJob& job);

/// labels.json and masks/NNNNNN.png: 16 bits, region ids, 0 = not exported; beside them color/ as recorded.
/// With ids above 65535 regions are renumbered; labels.json uses the numbers in the masks.
[[nodiscard]] Result<void> exportMasks(ExportJob& job);

/// Pascal VOC (torchvision, CVAT):
///     JPEGImages/NNNNNN.jpg            other images are converted
///     Annotations/NNNNNN.xml           one box for each instance; pixels count from 1
///     SegmentationClass SegmentationObject NNNNNN.png   VOC's palette; no border of 255
///     ImageSets/Main ImageSets/Segmentation train.txt val.txt trainval.txt
///     labelmap.txt labels.json
/// Error: more than 254 classes, or objects in an image.
[[nodiscard]] Result<void> exportVoc(ExportJob& job);

/// Label Studio: tasks.json with one brush mask for each instance (brush_rle.h), label-config.xml, images/,
/// labels.json. Brush masks and not polygons, because a polygon has neither holes nor pieces.
[[nodiscard]] Result<void> exportLabelStudio(ExportJob& job);

/// Upright boxes of instances (upright_box.h), metres:
///     pointclouds/scene.ply            the surface, z up
///     labels/scene.json _classes.json  for labelCloud, centroid_abs
///     boxes.json                       with instances, and the transform to the world
///     sunrgbd/NNNNNN/                  a frame of SUN RGB-D: image/ depth/ intrinsics.txt extrinsics/
///                                      annotation3Dfinal/index.json, boxes in the levelled camera's frame
[[nodiscard]] Result<void> exportBoxes(ExportJob& job);

/// FoundationPose, one folder NNNNNN_name for each instance and camera, metres:
///     rgb depth masks NNNNNN.png       depth as the colour camera sees it, mm
///     cam_K.txt mesh/model.obj         z up, centre of its box in the origin
///     ob_in_cam/NNNNNN.txt             from the model's frame to the camera's
/// A folder has the frames that show at least 16 pixels of the instance with depth. Frames whose intrinsics
/// differ by more than a pixel (of an image 640 wide) go into a folder of their own, NNNNNN_name_camera2.
/// labels.json. Error: no instance has such frames.
[[nodiscard]] Result<void> exportFoundationPose(ExportJob& job);

/// cloud.ply (positions, normals, colours of the scene, label, estimated) and labels.json.
[[nodiscard]] Result<void> exportPlyCloud(ExportJob& job);
/// cloud.pcd (PointXYZRGBL and estimated, VIEWPOINT = the first camera) and labels.json.
[[nodiscard]] Result<void> exportPcdCloud(ExportJob& job);

/// scene.ply .obj .glb, objects/NNNNNN_name.ply .obj .glb, labels.json. World frame, metres; GLB: y up. With
/// textures also .mtl and .png beside each .obj, and the image in the .glb.
[[nodiscard]] Result<void> exportMesh(ExportJob& job);
/// The same with each object centred in the origin (centered_mesh.h).
[[nodiscard]] Result<void> exportCenteredObjects(ExportJob& job);

/// trajectory.txt.
[[nodiscard]] Result<void> exportTum(ExportJob& job);

/// A scene of ScanNet: NAME_vh_clean_2.ply (z up), NAME_vh_clean_2.0.010000.segs.json (one segment per
/// region), NAME.aggregation.json (exported regions), NAME.txt (axisAlignment: identity).
[[nodiscard]] Result<void> exportScannet(ExportJob& job);

}  // namespace scantrove
