#pragma once
#include <memory>

#include "core/capture/containers/container_images.h"
#include "core/capture/containers/message_file.h"
#include "core/capture/frame_source.h"

namespace scantrove {

/// Images of a recording of ROS messages, also of RealSense's SDK. Error: no depth topic, or several to
/// choose from.
[[nodiscard]] Result<std::unique_ptr<ContainerImages>> openMessageRecording(std::unique_ptr<MessageFile> file,
                                                                            const std::string& kind,
                                                                            const SourceOptions& options);

}  // namespace scantrove
