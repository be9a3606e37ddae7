#pragma once
#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/catalogue/alike_objects.h"
#include "core/catalogue/object_record.h"
#include "core/catalogue/view_cloud.h"

namespace scantrove {

/// All that a catalogue knows of one object.
struct ObjectDetails {
  ObjectId object;
  std::string catalogue;          ///< ObjectDatabase::identity()
  std::set<ObjectId> ids;         ///< its own, and those of all objects that were merged into it
  std::vector<ObjectView> views;  ///< newest first
  ViewCloud cloud;
  std::vector<AlikeObject> alike;  ///< findAlikeObjects()
};

/// Reads it with a connection of its own, which creates and changes nothing. Takes tenths of a second. Any
/// thread. Error: as ObjectDatabase::openToRead(); the object was deleted or merged.
[[nodiscard]] Result<ObjectDetails> readDetails(const std::string& database, ObjectId object);

}  // namespace scantrove
