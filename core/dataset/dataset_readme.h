#pragma once
#include <string>

#include "core/dataset/export_job.h"

namespace scantrove {

/// The first line of a licence, for fields that hold a name.
[[nodiscard]] std::string licenseName(const std::string& license);

/// The first web address in a licence; empty: none.
[[nodiscard]] std::string licenseUrl(const std::string& license);

/// The version of this program.
[[nodiscard]] std::string programVersion();

/// Writes README.md (content, files, frames, units, axes, ids, origin, counts of classes) and, if the options
/// have a licence, LICENSE.txt. Call it last: it reads the summary. Error: as of ExportJob::write().
[[nodiscard]] Result<void> writeReadme(ExportJob& job);

}  // namespace scantrove
