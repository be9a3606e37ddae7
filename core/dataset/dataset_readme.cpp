#include "core/dataset/dataset_readme.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <string_view>

#include "core/dataset/scan_list.h"

namespace scantrove {
namespace {

constexpr std::string_view kLicenseFile = "LICENSE.txt";

/// Files, frames, units and axes of a format, as Markdown.
std::string_view aboutFiles(DatasetFormat format) {
  switch (format) {
    case DatasetFormat::coco:
      return "COCO instances. `annotations/instances.json` has masks as compressed run lengths, boxes as x, "
             "y,\n"
             "width and height in pixels from the upper left corner, and the images in `images/`. Each\n"
             "annotation is one region; `attributes` has its number, its object in the catalogue and its "
             "name.\n"
             "CVAT imports the JSON file as *COCO 1.0* into a task that has these images.\n";
    case DatasetFormat::bop:
      return "BOP, scenewise. Lengths are millimetres. Camera frames have x right, y down, z forward; pixel\n"
             "centres are at integers. `000001/` has colour, depth as the colour camera sees it\n"
             "(`depth_scale` makes it mm), masks of the whole object (`mask`) and of its visible part\n"
             "(`mask_visib`). `scene_gt.json` has poses from model to camera. `models/` has z up and the "
             "centre\n"
             "of each object's box in the origin. `obj_id` is the number of the region in `labels.json`.\n";
    case DatasetFormat::yolo:
      return "Ultralytics segments. Each line of `labels/` is one instance: its class, then x and y of its\n"
             "outline as fractions of the image's size. Thin bridges join the pieces and holes of an "
             "instance.\n"
             "In a data set of one scan the last frames are for validation.\n";
    case DatasetFormat::masks:
      return "`masks/` has 16-bit images of numbers, 0 where nothing is exported; `labels.json` says what "
             "each\n"
             "number is; `color/` has the images that the masks belong to.\n";
    case DatasetFormat::voc:
      return "Pascal VOC. `JPEGImages/` has the images; those recorded in another format became JPEGs of\n"
             "quality 95. `Annotations/` has one box for each object in pixels from 1 to the image's size,\n"
             "both ends included; `truncated` is 1 where it touches the image's border, `pose` is not "
             "given,\n"
             "`difficult` is 0. `SegmentationClass/` and `SegmentationObject/` are palette images: 0 is\n"
             "background, 1 and up are the classes in the order of `labelmap.txt`, and the objects in the "
             "order\n"
             "of the annotation. VOC's border of value 255 is left out: every pixel is decided. "
             "`ImageSets/`\n"
             "has the last frames for validation, if the data set is of one scan.\n";
    case DatasetFormat::labelstudio:
      return "Label Studio. Make a project with `label-config.xml` as its labelling interface. Start Label\n"
             "Studio with `LABEL_STUDIO_LOCAL_FILES_SERVING_ENABLED=true` and\n"
             "`LABEL_STUDIO_LOCAL_FILES_DOCUMENT_ROOT` set to this folder, add `images` in it as local "
             "storage\n"
             "of the project (without syncing), and import `tasks.json`. Masks are brush masks, which keep\n"
             "holes and pieces; each is one instance.\n";
    case DatasetFormat::boxes:
      return "Upright 3D boxes. Lengths are metres. `pointclouds/scene.ply` is the surface with z up and "
             "the\n"
             "number of the region as `label`. `labels/` has its boxes for labelCloud (format "
             "`centroid_abs`):\n"
             "the centre, `length`, `width` and `height` along the box's x, y and z, and its rotation about "
             "z\n"
             "in degrees, counter-clockwise from above. Length is the longer level side; front and back of "
             "an\n"
             "object are not known. `boxes.json` has the same with the numbers of instances, and\n"
             "`T_world_scene`, which takes points to the world of the recording.\n\n"
             "`sunrgbd/NNNNNN/` is one frame as in SUN RGB-D, with the boxes of the objects that it shows.\n"
             "Depth is as the colour camera sees it, in mm with its bits turned by three as there. Boxes are "
             "in\n"
             "the camera's frame after it was levelled (`extrinsics`, a rotation): x right, y down, z "
             "forward.\n"
             "`X` and `Z` are the corners of the base, `Ymin` the lower and `Ymax` the upper end.\n";
    case DatasetFormat::foundationpose:
      return "FoundationPose: one folder for each object and camera, with the frames that show the object.\n"
             "Lengths are metres. `rgb/`, `depth/` (16 bits, mm, as the colour camera sees it) and `masks/`\n"
             "(255 = the visible object) have equal names. `cam_K.txt` is the camera's matrix; camera "
             "frames\n"
             "have x right, y down, z forward. `mesh/model.obj` has z up and the centre of the object's box "
             "in\n"
             "the origin. `ob_in_cam/` has for each frame the 4 x 4 matrix from that frame to the camera's.\n"
             "Where the camera's intrinsics changed by more than a pixel, the frames are in `*_camera2/` and "
             "so\n"
             "on.\n";
    case DatasetFormat::ply:
      return "`cloud.ply` is the labelled cloud in the world of the recording, in metres. `label` is the "
             "number\n"
             "of the region, 0 = none; `estimated` is 1 where no depth reading shows the surface.\n";
    case DatasetFormat::pcd:
      return "`cloud.pcd` is the labelled cloud (PointXYZRGBL) in the world of the recording, in metres. "
             "`label`\n"
             "is the number of the region, 0 = none; `estimated` is 1 where no depth reading shows the "
             "surface.\n";
    case DatasetFormat::mesh:
      return "Surfaces as PLY, OBJ and GLB in metres: the scene, and each object in `objects/`. PLY and OBJ "
             "are\n"
             "in the world of the recording, GLB has y up. Centred objects have a JSON file with the offset\n"
             "back into the scene. Textures, if there are any, are beside OBJ (MTL, PNG) and within GLB; PLY "
             "has\n"
             "colours of vertices.\n";
    case DatasetFormat::tum:
      return "`trajectory.txt` has a line `time x y z qx qy qz qw` for each tracked frame: seconds, metres, "
             "and\n"
             "the rotation from the depth camera (x right, y down, z forward) to the world.\n";
    case DatasetFormat::scannet:
      return "A scene of ScanNet in metres with z up: mesh, segments (one for each region) and "
             "aggregation.\n";
  }
  return {};
}

/// Markdown that shows `text` as typed: characters with a meaning are escaped.
std::string markdown(std::string_view text) {
  std::string escaped;
  for (const char c : onOneLine(text)) {
    if (std::string_view("\\`*_[]<>#|&~").find(c) != std::string_view::npos) escaped += '\\';
    escaped += c;
  }
  return escaped;
}

std::string countsOf(const ExportSummary& summary, bool has_images) {
  if (summary.classes.empty()) return {};
  std::string text = has_images
                         ? "\n## Classes\n\n| class | images | instances | pixels |\n|---|---:|---:|---:|\n"
                         : "\n## Classes\n\n| class | objects |\n|---|---:|\n";
  for (const ClassCount& count : summary.classes) {
    text += has_images ? fmt::format("| {} | {} | {} | {} |\n", markdown(count.name), count.images,
                                     count.instances, count.pixels)
                       : fmt::format("| {} | {} |\n", markdown(count.name), count.instances);
  }
  if (has_images) text += "\nInstances are masks, one for each image that shows a region or object.\n";
  return text;
}

std::string originOf(const Eigen::Vector3d& origin) {
  if (origin.isZero(0)) return {};
  return fmt::format("The scan lies around {:.0f}, {:.0f}, {:.0f} m in the world of its recording.\n",
                     origin.x(), origin.y(), origin.z());
}

std::string imagesOf(const ExportJob& job, const ExportSummary& summary) {
  if (!hasImages(job.options().format)) return {};
  std::string text = fmt::format(
      "\n## Images\n\n{} {} of the {}; NNNNNN in a name is the number of the frame in its recording. "
      "Colour\n"
      "images are upright 8-bit RGB of the recorded size. Masks show the final labels of the scan from each\n"
      "frame's camera, cut off where something is in front, with outlines along edges of depth and colour.\n",
      summary.images, job.options().all_frames ? "stored frames" : "key frames",
      job.scans().isProject() ? "scans" : "scan");
  if (!summary.skipped.empty())
    text += fmt::format("{} more frames were unusable or unfit and left out.\n", summary.skipped.size());
  return text;
}

/// The scans of a project, and what differs from a data set of one scan.
std::string scansOf(const ExportJob& job) {
  if (!job.scans().isProject()) return {};
  const DatasetFormat format = job.options().format;
  const bool has_prefixes = joinsScans(format) && format != DatasetFormat::bop;
  std::string text = fmt::format("\n## Scans\n\n| scan | {} | split | images |\n|---|---|---|---:|\n",
                                 has_prefixes ? "names begin with" : "folder");
  for (const DatasetPart& part : job.scans().parts()) {
    text +=
        fmt::format("| {} | {} | {} | {} |\n", markdown(part.name), markdown(placeInDataset(part, format)),
                    part.split ? splitName(*part.split) : "", part.images);
  }
  text += "\n`scans.json` has the same. Ids of images, annotations and objects are unique over all scans.\n";
  if (job.scans().isSplit()) {
    text += "Scans are split, never the frames of one scan: neighbours in time are similar.\n";
    if (format == DatasetFormat::coco) text += "Each split has its own `annotations/instances_*.json`.\n";
  }
  return text;
}

/// What becomes of objects without a label.
std::string unlabeledIn(const ExportOptions& options) {
  if (options.choices.unlabeled != UnlabeledObjects::ignore || !hasIgnoreRegions(options.format)) return {};
  const std::string start = "\nObjects without a label are marked, so that a learner ignores them: ";
  if (options.format == DatasetFormat::masks) return start + "their pixels are 65535 in `masks/`.\n";
  if (options.format == DatasetFormat::voc) {
    return start +
           "their pixels are 255 in\n`SegmentationClass/` and `SegmentationObject/`, VOC's value for void.\n";
  }
  return start +
         "one annotation for each\nimage, with `iscrowd` 1 and the category `unlabelled`. Trainers leave "
         "crowds "
         "out. pycocotools compares\neach category apart, so it ignores them with `params.useCats = 0` only; "
         "CVAT "
         "shows them as masks.\n";
}

/// Which labels were chosen.
std::string choicesOf(const ExportOptions& options) {
  const ExportChoices& choices = options.choices;
  std::string text = options.background ? " Background and rejected regions are included.\n"
                                        : " Regions without a name or an object are not included.\n";
  if (choices.labels == ExportedLabels::named) text += "Only regions with a name are included.\n";
  if (choices.labels == ExportedLabels::confirmed) text += "Only confirmed objects are included.\n";
  if (!choices.classes.empty()) {
    text += "Only these classes are included:";
    for (const std::string& name : choices.classes)
      text += (name == choices.classes.front() ? " " : ", ") + markdown(name);
    text += ".\n";
  }
  return text + unlabeledIn(options);
}

std::string splitCountsOf(const ExportSummary& summary) {
  if (summary.splits.empty()) return {};
  std::string text =
      "\n## Splits\n\n| split | class | images | instances | pixels |\n|---|---|---:|---:|---:|\n";
  for (const SplitCount& split : summary.splits) {
    text += fmt::format("| {} | all | {} | | |\n", splitName(split.split), split.images);
    for (const ClassCount& count : split.classes) {
      text += fmt::format("| {} | {} | {} | {} | {} |\n", splitName(split.split), markdown(count.name),
                          count.images, count.instances, count.pixels);
    }
  }
  return text;
}

}  // namespace

std::string licenseName(const std::string& license) {
  const std::size_t begin = std::min(license.find_first_not_of(" \t\r\n"), license.size());
  return onOneLine(license.substr(begin, license.find_first_of("\r\n", begin) - begin));
}

std::string licenseUrl(const std::string& license) {
  for (const char* scheme : {"https://", "http://"}) {
    const std::size_t begin = license.find(scheme);
    if (begin == std::string::npos) continue;
    return onOneLine(license.substr(begin, license.find_first_of(" \t\r\n<>\"'()", begin) - begin));
  }
  return {};
}

std::string programVersion() { return SCANTROVE_VERSION; }

Result<void> writeReadme(ExportJob& job) {
  const ExportSummary& summary = job.summary();
  const ExportOptions& options = job.options();
  const auto name = datasetFormatNames().at(static_cast<std::size_t>(options.format));
  std::string text =
      "# " + markdown(job.scans().title()) + "\n\nA data set of the format `" + name + "`, which Scantrove " +
      programVersion() + " made of " +
      (job.scans().isProject() ? std::to_string(summary.scans) + " RGB-D scans" : "one RGB-D scan") +
      ".\n\n## Files\n\n" + std::string(aboutFiles(options.format));
  if (!job.scans().isProject()) text += originOf(job.part().origin);
  text += scansOf(job);
  text += imagesOf(job, summary);
  text +=
      "\n## Labels\n\nThe scan was segmented in 3D; persons and a catalogue of objects named its regions. A "
      "region or\nobject keeps its number in every export of the scan.";
  text += choicesOf(options);
  for (const std::string& note : summary.notes) text += "\n" + markdown(note) + "\n";
  text += countsOf(summary, hasImages(options.format));
  if (hasImages(options.format)) text += splitCountsOf(summary);
  text += "\n## License\n\n";
  const bool has_license = !licenseName(options.license).empty();
  text += has_license
              ? markdown(licenseName(options.license)) + " (see `" + std::string(kLicenseFile) + "`)\n"
              : "No licence was given.\n";
  if (has_license) SCANTROVE_TRY(job.write(kLicenseFile, validUtf8(options.license) + "\n"));
  return job.write("README.md", text);
}

}  // namespace scantrove
