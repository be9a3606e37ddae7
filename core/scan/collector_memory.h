#pragma once
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/base/result.h"

namespace scantrove {

class ObjectCollector;

/// What a collector knows beside map, regions and catalogue, as words that a session keeps: with them the
/// refinement of a scan continues in another run of the program as if that one had never ended. One thread,
/// the collector's.
class CollectorMemory {
 public:
  /// Of one that has finished: all its objects are stored.
  [[nodiscard]] static std::vector<std::uint32_t> of(const ObjectCollector& collector);

  /// Where the collector left off in the catalogue.
  struct Catalogue {
    std::int64_t session = 0;
    std::int64_t event = 0;
  };
  /// Makes a new collector what that one was; then its catalogue is to be loaded. None: the words are not of
  /// this version, or damaged; the collector stays new.
  [[nodiscard]] static std::optional<Catalogue> restore(std::span<const std::uint32_t> words,
                                                        ObjectCollector& collector);

  /// Error: a catalogue that lacks objects which the collector added to it.
  [[nodiscard]] static Result<void> checkObjects(const ObjectCollector& collector);
};

}  // namespace scantrove
