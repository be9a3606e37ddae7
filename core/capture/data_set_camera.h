#pragma once
#include <string>

#include "core/capture/image_sequence.h"

namespace scantrove {

/// Sets the camera of a recording from a file in its folder (see findIntrinsics), else from its data set:
/// `own`, if the depth images have its size. `own_name`: for messages, such as "Replica's". Error: the file
/// cannot be used; images of another size, no file, and no --intrinsics.
[[nodiscard]] Result<void> chooseDataSetCamera(ImageSequence& sequence, const Intrinsics& own,
                                               const std::string& own_name, const SourceOptions& options);

}  // namespace scantrove
