#pragma once
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/base/ids.h"
#include "core/catalogue/object_class.h"
#include "core/catalogue/view_descriptor.h"

namespace scantrove {

/// One view of an object, cropped from the full-resolution frame.
struct ObjectView {
  std::int64_t id = 0;  ///< 0 until stored
  ObjectId object;
  std::int64_t session = 0;
  int frame_index = 0;
  cv::Rect box_px;    ///< the crop, in pixels of the frame's depth image; `mask` fills it
  cv::Size frame_px;  ///< size of that image; empty, like the box: unknown (stored by an older version)
  cv::Mat color;      ///< h x w, CV_8UC3, BGR
  cv::Mat mask;       ///< h x w, CV_8UC1, 255 = object
  cv::Mat depth_mm;   ///< h x w, CV_16UC1, 0 = none
  Eigen::Isometry3d T_world_camera = Eigen::Isometry3d::Identity();
  Eigen::Vector3f direction =
      Eigen::Vector3f::UnitZ();  ///< unit, from the object's centroid to the camera, world
  Eigen::Vector3f size_m =
      Eigen::Vector3f::Zero();  ///< sides of the oriented box in this view, longest first; zero: unknown
  /// Centroid of the visible surface, in the session's world. Not set in views that are read.
  std::optional<Eigen::Vector3f> centroid_world;
  /// Of `color` and `mask`; computed when stored if not given. Not set in views that are read.
  std::optional<ViewDescriptor> descriptor;
};

enum class NamedBy { program, user };

/// One object of the catalogue.
struct ObjectRecord {
  ObjectId id;
  std::string name;  ///< unique; Obj_N until a user renames it
  NamedBy named_by = NamedBy::program;
  bool confirmed = false;
  Eigen::Vector3f size_m = Eigen::Vector3f::Zero();  ///< median over its views, longest first
  int views = 0;
  std::int64_t first_session = 0;
  std::string first_session_name;
  std::string created;                 ///< ISO 8601, UTC
  Classification classification = {};  ///< as stored: see ClassTable::rootOf()
};

/// The state of an object in CatalogueModel.
struct ObjectState {
  ObjectId id;
  std::string name;
  NamedBy named_by = NamedBy::program;
  bool confirmed = false;
  bool hidden = false;        ///< deleted, or merged into another one
  ObjectId merged_into = {};  ///< none: not merged
  Classification classification = {};

  bool operator==(const ObjectState&) const = default;
};

/// Whether a user named or confirmed this object.
template <class Object>
[[nodiscard]] bool isSettled(const Object& object) {
  return object.confirmed || object.named_by == NamedBy::user;
}

/// The object that has the views of `object` now.
struct MergeRoot {
  ObjectId object;
  ObjectId root;  ///< itself, or its merge target; none: deleted
};

/// The effect of a merge, to undo it.
struct ObjectMerge {
  ObjectId into;
  std::vector<ObjectId> from;
  bool has_confirmed = false;                     ///< `into` was confirmed because one of `from` was
  std::optional<Reclassified> reclassified = {};  ///< `into` had no class, and took that of one of `from`
};

/// What a user calls an object.
struct GivenName {
  std::string name;
  std::string class_name = {};  ///< empty: none is given

  bool operator==(const GivenName&) const = default;
};

/// The effect of a user's naming, to undo it.
struct ObjectNaming {
  ObjectId object;   ///< has the name now; none: nothing was done
  std::string name;  ///< without surrounding blanks
  std::string earlier_name;
  NamedBy earlier_named_by = NamedBy::program;
  bool earlier_confirmed = false;
  std::optional<ObjectMerge> merge =
      {};  ///< set if an object of that name existed: the named one is merged into it
  std::optional<Reclassified> reclassified = {};  ///< the naming gave `object` another class
  ClassId made_class = {};                        ///< the class was made for it
};

/// The position of an object in a view.
struct ViewPlace {
  std::int64_t session = 0;  ///< its views share one world frame
  Eigen::Vector3f centroid_world = Eigen::Vector3f::Zero();
};

/// What recognition needs of a stored view.
struct StoredDescriptor {
  std::int64_t view = 0;
  ObjectId first_object;  ///< the object that the view was stored for; see MergeRoot
  Eigen::Vector3f size_m = Eigen::Vector3f::Zero();  ///< as ObjectView::size_m
  ViewDescriptor descriptor;
  std::optional<ViewPlace> place = {};  ///< none: stored by an older version
};

}  // namespace scantrove
