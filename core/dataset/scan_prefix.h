#pragma once
#include <string>
#include <vector>

namespace scantrove {

/// A name for each scan of a data set, for its files and folders: safe on any system and inside its folder,
/// not empty, at most 60 bytes, never hidden. It is the scan's name where that is safe; else a safe form of
/// it and its checksum, so that it does not depend on the other scans. Names that differ in the case of
/// letters alone have checksums, too. All results differ.
[[nodiscard]] std::vector<std::string> scanPrefixes(const std::vector<std::string>& names);

}  // namespace scantrove
