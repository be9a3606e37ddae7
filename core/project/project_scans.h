#pragma once
#include <functional>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/dataset/project_export.h"
#include "core/project/project.h"

namespace scantrove {

using ScanWarning = std::function<void(const std::string&)>;

/// The scans of a project for exportProject(), in order of their names; each is opened when its turn comes.
/// `names`: only these, by the names of their folders; empty: all. `device`: as for OpenSession::open().
/// Scans that cannot be read are an error if they are in `names`, else left out. `warn` gets sentences about
/// these, and about damages of scans when they are opened, which may be twice. Error: no scans; no scan of
/// that name.
[[nodiscard]] Result<std::vector<ScanToExport>> scansToExport(const Project& project,
                                                              const std::vector<std::string>& names,
                                                              const std::string& device,
                                                              const ScanWarning& warn);

}  // namespace scantrove
