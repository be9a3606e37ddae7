#pragma once
#include "core/capture/containers/message_file.h"
#include "core/capture/containers/ros_images.h"
#include "core/capture/frame_source.h"

namespace scantrove {

/// The topics of a recording that frames are made of.
struct ChosenTopics {
  const MessageTopic* depth = nullptr;
  RosImageKind depth_kind;
  const MessageTopic* color = nullptr;  ///< null: the recording has none
  RosImageKind color_kind;
};

/// Takes the topics that `options` names, else the only depth topic and the colour topic beside it. Images
/// that a topic repeats in compressed form count once; depth that is registered to colour is preferred.
/// Error: lists the topics to choose from; none of depth, or several.
[[nodiscard]] Result<ChosenTopics> chooseTopics(MessageFile& file, const SourceOptions& options);

/// The topic of the camera of images: the nearest NAME/camera_info or NAME/info/camera_info above `topic`.
/// Null: none.
[[nodiscard]] const MessageTopic* cameraInfoOf(const MessageFile& file, const std::string& topic);

}  // namespace scantrove
