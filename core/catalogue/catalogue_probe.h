#pragma once
#include <string>

#include "core/base/result.h"

namespace scantrove {

/// What an address leads to.
struct CatalogueProbe {
  bool is_new = false;  ///< an empty database: opening it creates a catalogue
  int objects = 0;
};

/// Connects to a server and looks, without changing anything. Takes seconds if the server is far away or off.
/// Error: no address of a server; as ObjectDatabase::openToRead.
[[nodiscard]] Result<CatalogueProbe> probeCatalogue(const std::string& address);

}  // namespace scantrove
