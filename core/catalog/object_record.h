#pragma once
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <string>

#include "core/base/ids.h"

namespace scantrove {

/// One look at an object, cut from the full-resolution frame.
struct ObjectView {
  std::int64_t id = 0;  ///< 0 until stored
  ObjectId object;
  std::int64_t session = 0;
  int frame_index = 0;
  cv::Mat color;     ///< h x w, CV_8UC3, BGR
  cv::Mat mask;      ///< h x w, CV_8UC1, 255 = object
  cv::Mat depth_mm;  ///< h x w, CV_16UC1, 0 = none
  Eigen::Isometry3d T_world_camera = Eigen::Isometry3d::Identity();
  Eigen::Vector3f direction =
      Eigen::Vector3f::UnitZ();  ///< unit, from the object's centroid to the camera, world
};

/// One object of the catalogue.
struct ObjectRecord {
  ObjectId id;
  std::string name;  ///< unique; Obj_N until a person renames
  bool confirmed = false;
  Eigen::Vector3f size_m = Eigen::Vector3f::Zero();  ///< sides of the oriented box, longest first
  int views = 0;
  std::int64_t first_session = 0;
  std::string first_session_name;
  std::string created;  ///< ISO 8601, UTC
};

}  // namespace scantrove
