#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "core/base/result.h"

namespace scantrove {

/// A folder with one catalogue and the scans whose objects it holds:
///     scantrove-project.json   name of the project, and the server of its catalogue if it has one (never a
///                              password); the folder is recognised by it
///     catalogue.sqlite         objects and classes of all its scans
///     scans/NAME/              one session for each scan
///     claims/                  recordings that are being scanned, see RecordingClaim
/// Projects of earlier versions have a project.json instead, which stays.
/// It may be moved or copied as a whole: its scans find the catalogue of the folder that they lie in.
struct Project {
  std::filesystem::path folder;  ///< absolute
  std::string name;              ///< as typed, UTF-8
  /// Absolute; folder/catalogue.sqlite, or a server's address (isServerAddress); see projectOfCatalogue().
  std::filesystem::path catalogue;

  [[nodiscard]] std::filesystem::path scansFolder() const { return folder / "scans"; }
  [[nodiscard]] std::filesystem::path claimsFolder() const { return folder / "claims"; }
};

/// Whether `folder` is a project: it has a scantrove-project.json or a project.json of an earlier version, or
/// is that of defaultProject(). Any thread.
[[nodiscard]] bool isProjectFolder(const std::filesystem::path& folder);

/// Whether `file` is the file by which a project's folder is recognised; `project.json`, a name that other
/// programs use as well, by its content. Any thread.
[[nodiscard]] bool isProjectFile(const std::filesystem::path& file);

/// The project that is used unless another is chosen: $XDG_DATA_HOME/scantrove, or below ~/.local/share. It
/// needs no scantrove-project.json and may not exist yet.
[[nodiscard]] Project defaultProject();

/// Error: missing, no project, a damaged file, or written by a newer version.
[[nodiscard]] Result<Project> openProject(const std::filesystem::path& folder);

/// Creates the folder (unless it exists and is empty) with scantrove-project.json and an empty folder of
/// scans. `name`: empty is the folder's name. `server`: the address of its catalogue; empty: it is a file of
/// the folder. Error: the folder holds other things or is a project already; not writable; an unusable name;
/// an address with a password.
[[nodiscard]] Result<Project> createProject(const std::filesystem::path& folder, const std::string& name,
                                            const std::string& server = {});

/// The project in which the scan in `folder` lies. Error: as openProject.
[[nodiscard]] Result<Project> projectOfScan(const std::filesystem::path& folder);

/// The project of that catalogue. One that lies in no project (or is not its project's) makes a project of
/// its own, which keeps its scans where defaultProject() does and is called like the file.
[[nodiscard]] Project projectOfCatalogue(const std::filesystem::path& catalogue);

/// A name for a new scan's folder: `day` ("2026-11-22 15.40.02"), then `title` without characters that file
/// systems refuse, then " (2)" if that exists in the project. At most 200 bytes.
[[nodiscard]] std::filesystem::path newScanFolder(const Project& project, const std::string& day,
                                                  const std::string& title);

/// Creates the folder that newScanFolder() names. Another program that does the same gets another folder.
/// Error: the project cannot be written.
[[nodiscard]] Result<std::filesystem::path> createScanFolder(const Project& project, const std::string& day,
                                                             const std::string& title);

}  // namespace scantrove
