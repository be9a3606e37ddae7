#pragma once
#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/base/review_state.h"
#include "core/base/stamped_pose.h"
#include "core/capture/intrinsics.h"
#include "core/catalogue/object_class.h"

namespace scantrove {

/// One region of a finished scan, with its label from a user or the catalogue.
struct LabeledRegion {
  std::uint32_t id = 0;                ///< never 0
  std::string name;                    ///< as typed: any UTF-8, slashes, quotes, line ends; empty: none
  std::string category;                ///< as typed; empty: none
  ClassId class_id = {};               ///< of `category` in the catalogue; none: it has no such class
  std::optional<std::int64_t> object;  ///< in the catalogue
  bool background = false;             ///< wall, floor, table
  bool rejected = false;               ///< "not an object"
  bool confirmed = false;              ///< the object, by a user
  bool is_program_name = false;        ///< the name is the program's, for example Obj_4
  int voxels = 0;
  Eigen::AlignedBox3f box_world_m;
  Eigen::Vector3f centroid_world_m = Eigen::Vector3f::Zero();
};

/// A point of the surface of the map.
struct SurfacePoint {
  Eigen::Vector3f position_world_m = Eigen::Vector3f::Zero();
  Eigen::Vector3f normal_world =
      Eigen::Vector3f::Zero();        ///< unit length, out of the surface; zero = unknown
  std::array<std::uint8_t, 3> rgb{};  ///< the scene's colour, sRGB
  std::uint32_t region = 0;           ///< 0 = unlabelled
  bool is_estimated = false;          ///< no depth reading shows it; its colour is unknown
};

/// The surface of the map, or a part of it. Faces: indices of three vertices, counter-clockwise from
/// outside.
struct LabeledMesh {
  std::vector<SurfacePoint> vertices;
  std::vector<std::array<std::uint32_t, 3>> faces;
};

/// A stored frame with its poses and cameras.
struct KeyFrameInfo {
  int index = 0;  ///< number of the frame in its source; unique among key frames
  double timestamp_s = 0;
  Eigen::Isometry3d T_world_depth = Eigen::Isometry3d::Identity();
  Intrinsics K_depth;
  float meters_per_unit = 0.001F;  ///< of the depth image
  Intrinsics K_color;  ///< of the colour image, at its size; registered colour: K_depth scaled to it
  Eigen::Isometry3d T_color_depth = Eigen::Isometry3d::Identity();  ///< registered colour: identity
  std::filesystem::path color_file;  ///< JPEG or PNG as recorded; empty: no colour
  ReviewState review = ReviewState::open;

  /// T_world_color.
  [[nodiscard]] Eigen::Isometry3d colorCameraPose() const { return T_world_depth * T_color_depth.inverse(); }
};

/// The final map rendered from a camera, h x w of that camera.
struct ViewOfMap {
  cv::Mat regions;  ///< CV_32SC1, region ids, 0 = unlabelled or nothing
  cv::Mat depth_m;  ///< CV_32FC1, along the optical axis, 0 = nothing
};

/// What a person painted for one region in an image: CV_8UC1 of its size, nonzero = painted.
struct PaintedMask {
  std::uint32_t region = 0;
  cv::Mat added;                          ///< pixels that are the region
  cv::Mat removed;                        ///< pixels that are not; none of `added`
  std::vector<std::uint32_t> parts = {};  ///< regions that were split from it since
};

/// A finished scan with its labels, as the source of data sets: a session on disk, or a scene in memory.
/// From one thread at a time. The scan is not changed. Errors name the affected file.
class LabeledScan {
 public:
  virtual ~LabeledScan() = default;

  /// For messages and file names, e.g. the session folder's name.
  [[nodiscard]] virtual std::string name() const = 0;
  /// Positions and poses of the scan are relative to this point of its recording's world, in metres:
  /// integers, zero unless that is far away. Data sets use positions in that world.
  [[nodiscard]] virtual Eigen::Vector3d origin() const { return Eigen::Vector3d::Zero(); }
  /// All regions, in any order.
  [[nodiscard]] virtual Result<std::vector<LabeledRegion>> regions() = 0;
  /// All classes of the catalogue, hidden ones too; empty: it has none. After regions().
  [[nodiscard]] virtual std::vector<ObjectClass> classes() { return {}; }
  /// Frames with a pose, in order of time: key frames, or all stored frames. Those that were left out are
  /// among them, with their review state; frame_choice.h chooses those of a data set.
  [[nodiscard]] virtual Result<std::vector<KeyFrameInfo>> keyFrames(bool all_frames) = 0;
  /// The colour image of the key frame with `index`: CV_8UC3, BGR, of the size of K_color.
  [[nodiscard]] virtual Result<cv::Mat> color(int index) = 0;
  /// Its depth image: CV_16UC1 of the size of K_depth, in units of meters_per_unit, 0 = no reading.
  [[nodiscard]] virtual Result<cv::Mat> depth(int index) = 0;
  /// What a person painted in its colour image (without one: in its depth image), oldest first.
  [[nodiscard]] virtual std::vector<PaintedMask> paintedMasks(int index) {
    static_cast<void>(index);
    return {};
  }
  /// Casts one ray per pixel into the final map; current labels, nearest surface.
  [[nodiscard]] virtual Result<ViewOfMap> renderView(const Intrinsics& K,
                                                     const Eigen::Isometry3d& T_world_camera) = 0;
  /// The whole surface.
  [[nodiscard]] virtual Result<LabeledMesh> mesh() = 0;
  /// Visits the points of the labelled cloud: measured surface, then estimated surface.
  [[nodiscard]] virtual Result<void> forEachPoint(const std::function<void(const SurfacePoint&)>& give) = 0;
  /// Tracked frames in order of time, depth camera to world.
  [[nodiscard]] virtual Result<Trajectory> trajectory() = 0;
};

}  // namespace scantrove
