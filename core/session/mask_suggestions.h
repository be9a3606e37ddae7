#pragma once
#include <cstddef>
#include <vector>

#include "core/base/result.h"
#include "core/editing/edit_proposals.h"
#include "core/exchange/mask_folder.h"
#include "core/session/open_session.h"

namespace scantrove {

/// Operations on a session that masks of another program suggest.
struct MaskSuggestions {
  std::vector<EditProposal> proposals;
  std::size_t key_frames = 0;  ///< with masks
  std::size_t masks = 0;       ///< in these
};

/// Compares the session's regions with the masks of its key frames. Masks are numbered as an export numbers
/// the frames, and have the size of the colour image and its view; or, if that has another size, those of the
/// depth image. Changes nothing. The session's thread. Error: no image has the number of a key frame; one is
/// damaged or has another size; they hold no mask; the device failed.
[[nodiscard]] Result<MaskSuggestions> suggestEdits(OpenSession& session, const MaskFolder& masks,
                                                   const ProposalParams& params);

}  // namespace scantrove
