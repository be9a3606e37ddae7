#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/session/open_session.h"

namespace scantrove {

/// Arguments of all `scantrove session` commands.
struct SessionArguments {
  std::string folder;
  std::string device;
  bool json = false;
  std::vector<std::uint32_t> regions;
  bool proposed = false;
  std::string name;
  std::optional<std::string> category;
  bool undo = false;
  bool without_catalogue = false;
  int steps = 1;
  int frame = 0;
  std::string pixel;
  std::vector<std::string> here, there;
  std::string masks;
  int min_frames = 3;
  bool apply = false;
  std::string mask_file;
  std::vector<std::string> polygons;  ///< "x,y,x,y,x,y"
  bool paint_adds = false, paint_removes = false, paint_sets = false;
  bool this_image_only = false;
  bool new_region = false;
  std::string out;
  std::vector<int> review_frames;
  std::string review_state;
  bool list = false;
};

/// The region and point at a pixel, given as "N:x,y" or as "x,y" of `frame`. Error: another format, or as
/// OpenSession::at().
[[nodiscard]] Result<OpenSession::SurfacePoint> surfacePointAt(OpenSession& session, const std::string& text,
                                                               int frame);

}  // namespace scantrove
