#pragma once
#include <filesystem>
#include <memory>
#include <string>

#include "core/capture/frame_source.h"

namespace scantrove {

/// Opens a live camera by its OpenNI2 URI. Registers depth to colour (unless `options` name a colour camera)
/// and synchronises both where the camera can; mirroring off. next() waits a second at most (timeout); an
/// unplugged camera is `failed`. Error: it cannot be opened; says what to check.
[[nodiscard]] Result<std::unique_ptr<FrameSource>> openOpenNiCamera(const std::string& uri,
                                                                    const SourceOptions& options);

/// Opens an .oni file as a recording. Returns every depth frame without pacing, with the colour frame nearest
/// in time. Index = position, timestamp = the recording's. Error: cannot be opened, or holds no depth.
[[nodiscard]] Result<std::unique_ptr<FrameSource>> openOniRecording(const std::filesystem::path& file,
                                                                    const SourceOptions& options);

}  // namespace scantrove
