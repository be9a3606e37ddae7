#pragma once
#include <filesystem>
#include <string>

#include "core/base/result.h"
#include "core/scan/open_session.h"

namespace scantrove {

// What is said of the regions of an opened session, told to the catalogue that it was scanned with. The
// thread of the session. Errors: the catalogue is not there (none is made), cannot be written, or the device
// failed; the session stays as it is.

/// The catalogue of the session: a file that may be missing; empty: it had none.
[[nodiscard]] std::filesystem::path catalogueFileOf(const OpenSession& session);

/// The region is an object of that name, confirmed: the one that it is already, made one with another of that
/// name where there is such; else a new one, with views from the session's key frames. The object, which the
/// session keeps. Error: also no name for an object, and no key frame that shows the region.
[[nodiscard]] Result<ObjectId> nameInCatalogue(OpenSession& session, RegionId region,
                                               const std::string& name);

/// Takes the newest such naming back, but for what was said of the object since; one that was made for it is
/// deleted. False: this session did not
/// name it so.
[[nodiscard]] Result<bool> takeNameFromCatalogue(OpenSession& session, RegionId region,
                                                 const std::string& name);

/// The region is an object, named by the program where it is a new one.
[[nodiscard]] Result<ObjectId> addToCatalogue(OpenSession& session, RegionId region);
/// Takes that back, unless somebody has said what the object is since. False: there is nothing to take back.
[[nodiscard]] Result<bool> takeFromCatalogue(OpenSession& session, RegionId region);

/// All of that, as it follows from an operation that was done, undone or done again in the session.
enum class SaidHow { done, undone };
[[nodiscard]] Result<void> followInCatalogue(OpenSession& session, const RegionEditor::Outcome& outcome,
                                             SaidHow how);

}  // namespace scantrove
