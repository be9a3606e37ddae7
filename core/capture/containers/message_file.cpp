#include "core/capture/containers/message_file.h"

#include <algorithm>

namespace scantrove {

namespace {

constexpr std::size_t kFewMessages = 200;       // of topics that are read for their first messages
constexpr std::size_t kMostMessages = 4 << 20;  // 100 MB of entries: ten hours of four cameras
constexpr std::size_t kMostTopics = 10'000;

std::string withoutMsg(std::string_view type) {
  std::string name(type);
  if (const std::size_t at = name.find("/msg/"); at != std::string::npos) name.erase(at, 4);
  return name;
}

}  // namespace

bool isImageType(std::string_view type) {
  return type == "sensor_msgs/Image" || type == "sensor_msgs/CompressedImage";
}

const MessageTopic* MessageFile::findTopic(std::string_view name) const {
  const auto found = std::ranges::find(topics_, name, &MessageTopic::name);
  return found == topics_.end() ? nullptr : &*found;
}

Result<std::size_t> MessageFile::topicAt(std::string_view name, std::string_view type,
                                         MessageEncoding encoding) {
  if (name.size() > kLongestName || type.size() > kLongestName)
    return fail(path_.string() + " is damaged: the name of a topic has more than 4096 bytes.",
                "Copy or record it again.");
  const auto known = positions_.find(std::string(name));
  if (known != positions_.end()) return known->second;
  if (topics_.size() >= kMostTopics)
    return fail(path_.string() + " holds more than 10,000 topics.", "Leave out other topics.");
  positions_.emplace(name, topics_.size());
  topics_.push_back({std::string(name), withoutMsg(type), encoding, {}});
  return topics_.size() - 1;
}

Result<void> MessageFile::addMessage(std::size_t topic, const MessageEntry& entry) {
  std::vector<MessageEntry>& messages = topics_[topic].messages;
  if (!isImageType(topics_[topic].type) && messages.size() >= kFewMessages) return {};
  if (++count_ > kMostMessages) {
    return fail(path_.string() + " holds more than 4 million messages.",
                "Split the recording, or leave out other topics.");
  }
  messages.push_back(entry);
  messages.back().time_ns = std::max<std::int64_t>(0, entry.time_ns);  // differences never overflow
  return {};
}

void MessageFile::finishIndex() {
  positions_.clear();
  std::erase_if(topics_, [](const MessageTopic& topic) { return topic.messages.empty(); });
  std::ranges::sort(topics_, {}, &MessageTopic::name);
  for (MessageTopic& topic : topics_) {
    std::ranges::stable_sort(topic.messages, {}, &MessageEntry::time_ns);
    topic.messages.shrink_to_fit();
  }
}

}  // namespace scantrove
