#pragma once
#include <cstdint>
#include <string>

#include "core/catalogue/object_record.h"

namespace scantrove {

/// What a catalogue says of the object that a region was taken for.
struct RegionObject {
  enum class State : std::uint8_t { none, known, deleted };
  State state = State::none;
  ObjectId object = {};  ///< who holds it now; none: its number is not known
  std::string name = {};
  NamedBy named_by = NamedBy::program;
  bool confirmed = false;
  bool is_merged = false;  ///< `object` is another one than the region was taken for
  bool operator==(const RegionObject&) const = default;
};

}  // namespace scantrove
