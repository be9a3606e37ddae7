#pragma once
#include <cstdint>
#include <vector>

namespace scantrove {

/// What a segment is to the supports of its frame (supported_segments.h).
struct SegmentRole {
  enum class Kind : std::uint8_t {
    free,     ///< nothing is known
    support,  ///< it is the support
    carried,  ///< it lies or stands on the support
    carrier,  ///< it lies on the support and carries others: a cloth
  };
  Kind kind = Kind::free;
  std::uint8_t support = 0;  ///< number of the support in the frame
};

/// S_t: the segments of one frame, on the host.
struct SegmentMap {
  int width = 0;
  int height = 0;
  std::vector<std::uint32_t> ids;  ///< width * height, row by row; 0 = unlabelled, else 1 .. count()
  std::vector<int> areas;          ///< pixels of each id; areas[0] = unlabelled pixels
  std::vector<float> depths_m;     ///< width * height: z in the camera of each labelled pixel, else 0
  /// Pixels whose depth was estimated, not measured (supported_segments.h); empty: no support tells.
  std::vector<std::uint8_t> is_estimated = {};

  std::vector<SegmentRole> roles = {};  ///< by id; empty: all are free

  [[nodiscard]] SegmentRole roleOf(std::uint32_t id) const {
    return id < roles.size() ? roles[id] : SegmentRole{};
  }
  [[nodiscard]] int count() const { return areas.empty() ? 0 : static_cast<int>(areas.size()) - 1; }
};

}  // namespace scantrove
