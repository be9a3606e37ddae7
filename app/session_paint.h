#pragma once
#include "app/session_arguments.h"

namespace scantrove {

// Masks of single images in `scantrove session`.

/// Corrects the mask of a region in the image of a key frame by a mask file or polygons, and the regions
/// behind it. Prints the current numbers of the changed regions. Error: no such image, an unusable mask, or
/// as OpenSession::edit().
[[nodiscard]] Result<void> paintRegion(OpenSession& session, const SessionArguments& arguments);

/// Makes what is painted in the image of a key frame a region of its own, in all images, and names it if a
/// name is given. Prints its number, then the others that changed. Error: as paintRegion(), or the map has no
/// surface there.
[[nodiscard]] Result<void> paintNewRegion(OpenSession& session, const SessionArguments& arguments);

/// Takes what was painted for a region in the image of a key frame away. The regions behind stay. Error:
/// nothing is painted there.
[[nodiscard]] Result<void> unpaintRegion(OpenSession& session, const SessionArguments& arguments);

/// Writes the regions of a key frame's image, as data sets have them, to a new PNG of 16 bits.
[[nodiscard]] Result<void> writeMasksOfImage(OpenSession& session, const SessionArguments& arguments);

}  // namespace scantrove
