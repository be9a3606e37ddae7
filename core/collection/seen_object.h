#pragma once
#include <opencv2/core/types.hpp>
#include <string>

#include "core/discovery/region_set.h"

namespace scantrove {

/// An object or candidate in a frame.
struct SeenObject {
  ObjectId object;  ///< none while the candidate is not identified yet
  RegionSet regions;
  std::string name;         ///< empty while `object` is none
  bool recognized = false;  ///< known from the catalogue before this scan, or recognised again
  bool confirmed = false;   ///< by a user
  cv::Rect2f box;           ///< in fractions of the colour image's width and height
};

}  // namespace scantrove
