#pragma once
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/base/ids.h"
#include "core/catalogue/thumbnail.h"

namespace scantrove {

/// One look at an object, cut from the full-resolution frame.
struct ObjectView {
  std::int64_t id = 0;  ///< 0 until stored
  ObjectId object;
  std::int64_t session = 0;
  int frame_index = 0;
  cv::Rect box_px;    ///< where it was cut, in pixels of the frame's depth image; `mask` fills it
  cv::Size frame_px;  ///< size of that image; empty, like the box: not known (stored by an older version)
  cv::Mat color;      ///< h x w, CV_8UC3, BGR
  cv::Mat mask;       ///< h x w, CV_8UC1, 255 = object
  cv::Mat depth_mm;   ///< h x w, CV_16UC1, 0 = none
  Eigen::Isometry3d T_world_camera = Eigen::Isometry3d::Identity();
  Eigen::Vector3f direction =
      Eigen::Vector3f::UnitZ();  ///< unit, from the object's centroid to the camera, world
  Eigen::Vector3f size_m =
      Eigen::Vector3f::Zero();  ///< sides of the oriented box in this look, longest first; zero: unknown
  /// The middle of what is seen of the object, in the session's world. Views that are read come without it.
  std::optional<Eigen::Vector3f> centroid_world;
  /// Of `color` and `mask`. Whoever has it already hands it over; it is computed for the database otherwise.
  /// Views that are read come without it.
  std::optional<Thumbnail> descriptor;
};

enum class NamedBy { program, person };

/// One object of the catalogue.
struct ObjectRecord {
  ObjectId id;
  std::string name;  ///< unique; Obj_N until a person renames
  NamedBy named_by = NamedBy::program;
  bool confirmed = false;
  Eigen::Vector3f size_m = Eigen::Vector3f::Zero();  ///< median of its views', longest first
  int views = 0;
  std::int64_t first_session = 0;
  std::string first_session_name;
  std::string created;  ///< ISO 8601, UTC
};

/// What the rules of the catalogue know of an object (CatalogueModel).
struct ObjectState {
  ObjectId id;
  std::string name;
  NamedBy named_by = NamedBy::program;
  bool confirmed = false;
  bool hidden = false;        ///< deleted, or merged into another one
  ObjectId merged_into = {};  ///< none: not merged

  bool operator==(const ObjectState&) const = default;
};

/// A user named or confirmed this object.
template <class Object>
[[nodiscard]] bool isSettled(const Object& object) {
  return object.confirmed || object.named_by == NamedBy::person;
}

/// The object that has the views of `object` now.
struct MergeRoot {
  ObjectId object;
  ObjectId root;  ///< itself, or what it was merged into; none: deleted
};

/// What a merge did, to undo it.
struct ObjectMerge {
  ObjectId into;
  std::vector<ObjectId> from;
  bool has_confirmed = false;  ///< `into` was marked as confirmed because one of `from` was
};

/// What a user's naming did, to undo it.
struct ObjectNaming {
  ObjectId object;   ///< that has the name now; none: nothing was done
  std::string name;  ///< without blanks around it
  std::string earlier_name;
  NamedBy earlier_named_by = NamedBy::program;
  bool earlier_confirmed = false;
  std::optional<ObjectMerge> merge = {};  ///< an object of that name was there: the named one is part of it
};

/// Where a view saw its object.
struct ViewPlace {
  std::int64_t session = 0;  ///< whose views share one world
  Eigen::Vector3f centroid_world = Eigen::Vector3f::Zero();
};

/// What recognition needs of a stored view.
struct StoredDescriptor {
  std::int64_t view = 0;
  ObjectId first_object;  ///< the object that the view was stored for; see MergeRoot
  Eigen::Vector3f size_m = Eigen::Vector3f::Zero();  ///< as ObjectView::size_m
  Thumbnail thumbnail;
  std::optional<ViewPlace> place = {};  ///< none: stored by an older version
};

}  // namespace scantrove
