#pragma once
#include <cstdint>
#include <string>

namespace scantrove {

/// Who is who in `RgbdFrame::instances`.
struct InstanceName {
  std::uint16_t id = 0;
  std::string name;
  bool is_object = false;   ///< false for floor, walls, table and other furniture that stays
  bool non_convex = false;  ///< its shape has concave parts (a handle, a hollow, a step)
  double extent_m = 0;      ///< the longest side of its box along the world's axes; 0 = not known
};

}  // namespace scantrove
