#pragma once
#include <cstdint>
#include <string>

namespace scantrove {

/// Name and properties of one instance in `RgbdFrame::instances`.
struct InstanceName {
  std::uint16_t id = 0;
  std::string name;
  bool is_object = false;   ///< false for floor, walls, table and other furniture that stays
  bool non_convex = false;  ///< the shape has concave parts (a handle, a hollow, a step)
  double extent_m = 0;      ///< longest side of its box along the world's axes; 0 = unknown
};

}  // namespace scantrove
