#include "core/capture/containers/topic_choice.h"

#include <algorithm>
#include <array>

#include "core/capture/folder_listing.h"

namespace scantrove {

namespace {

using TopicContent = RosImageKind::Content;

struct ImageTopic {
  const MessageTopic* topic = nullptr;
  RosImageKind kind;
};
using ImageTopics = std::vector<ImageTopic>;

bool hasWord(const std::string& name, std::initializer_list<const char*> words) {
  const std::string lower = lowerCase(name);
  return std::ranges::any_of(words, [&](const char* word) { return lower.find(word) != std::string::npos; });
}

/// The start of the first message that is whole, of three.
Result<ByteBlock> readTopicStart(MessageFile& file, const MessageTopic& topic) {
  constexpr std::size_t kTried = 3;
  Result<ByteBlock> start = file.read(topic.messages.front(), kRosStartBytes);
  for (std::size_t i = 1; i < std::min(kTried, topic.messages.size()) && !start; ++i)
    start = file.read(topic.messages[i], kRosStartBytes);
  return start;
}

/// The image topics of known content.
Result<ImageTopics> imageTopicsOf(MessageFile& file) {
  ImageTopics topics;
  for (const MessageTopic& topic : file.topics()) {
    if (!isImageType(topic.type)) continue;
    const Result<ByteBlock> start = readTopicStart(file, topic);
    if (!start) return fail(start.error());
    if (const auto kind = rosImageKind(*start, topic)) topics.push_back({&topic, *kind});
  }
  return topics;
}

std::string parentTopic(const std::string& name) { return name.substr(0, name.rfind('/')); }

/// Infrared has 16 bits, too.
bool isDepthName(const std::string& name) {
  return !hasWord(name, {"infra", "/ir/", "_ir/", "confidence", "disparity", "amplitude"});
}

ImageTopics select(const ImageTopics& topics, const auto& fits) {
  ImageTopics selected;
  std::ranges::copy_if(topics, std::back_inserter(selected), fits);
  return selected;
}

/// Without those that repeat another one compressed: NAME/compressed beside NAME.
ImageTopics withoutRepeated(const ImageTopics& topics) {
  return select(topics, [&](const ImageTopic& one) {
    const bool is_compressed = one.topic->type != "sensor_msgs/Image";
    return !is_compressed || std::ranges::none_of(topics, [&](const ImageTopic& other) {
      return other.topic->name == parentTopic(one.topic->name);
    });
  });
}

/// Those that fit; all, if none does.
ImageTopics preferred(ImageTopics topics, const auto& fits) {
  ImageTopics better = select(topics, fits);
  return better.empty() ? std::move(topics) : better;
}

std::size_t sharedFolders(const std::string& a, const std::string& b) {
  const auto differ = std::ranges::mismatch(a, b);
  return static_cast<std::size_t>(std::count(a.begin(), differ.in1, '/'));
}

std::string listOf(const ImageTopics& topics) {
  constexpr std::size_t kMost = 20;
  std::string list;
  for (std::size_t i = 0; i < std::min(topics.size(), kMost); ++i)
    list += (i == 0 ? "" : ", ") + topics[i].topic->name;
  return list + (topics.size() > kMost ? ", ..." : "");
}

std::string allTopics(const MessageFile& file) {
  constexpr std::size_t kMost = 20;
  std::string list;
  for (std::size_t i = 0; i < std::min(file.topics().size(), kMost); ++i)
    list += (i == 0 ? "" : ", ") + file.topics()[i].name + " (" + file.topics()[i].type + ")";
  return list + (file.topics().size() > kMost ? ", ..." : "");
}

/// The topic of a name that the user gave.
Result<ImageTopic> namedTopic(const MessageFile& file, const ImageTopics& topics, const std::string& name,
                              const char* option) {
  const auto found = std::ranges::find_if(topics, [&](const auto& one) { return one.topic->name == name; });
  if (found != topics.end()) return *found;
  return fail(
      file.path().string() + " has no images of this kind in a topic '" + name + "' (" + option + ").",
      topics.empty() ? "Its topics: " + allTopics(file) + "." : "Choose one of " + listOf(topics) + ".");
}

Result<ImageTopic> chooseDepth(const MessageFile& file, const ImageTopics& images, const std::string& name) {
  const auto of_depth = [](const ImageTopic& one) { return one.kind.content == TopicContent::depth; };
  const ImageTopics all = select(images, of_depth);
  if (!name.empty()) return namedTopic(file, all, name, "--depth-topic");
  ImageTopics topics =
      withoutRepeated(select(all, [](const ImageTopic& one) { return isDepthName(one.topic->name); }));
  topics = preferred(std::move(topics), [](const ImageTopic& one) {
    return hasWord(one.topic->name, {"aligned_depth_to_color", "depth_registered"});
  });
  if (topics.size() == 1) return topics.front();
  if (topics.empty()) {
    return fail(file.path().string() +
                    " holds no depth images (sensor_msgs/Image of 16UC1, mono16 or 32FC1, "
                    "or compressedDepth).",
                "Its topics: " + allTopics(file) + ".");
  }
  return fail(file.path().string() + " holds several depth topics: " + listOf(topics) + ".",
              "Choose one with --depth-topic NAME.");
}

/// None: the recording has no colour.
Result<std::optional<ImageTopic>> chooseColor(const MessageFile& file, const ImageTopics& images,
                                              const std::string& name, const std::string& depth) {
  const auto of_color = [](const ImageTopic& one) { return one.kind.content == TopicContent::color; };
  const ImageTopics all = select(images, of_color);
  if (!name.empty()) {
    return namedTopic(file, all, name, "--color-topic").map([](ImageTopic one) {
      return std::optional(one);
    });
  }
  ImageTopics topics = withoutRepeated(select(all, [](const ImageTopic& one) {
    return !hasWord(one.topic->name, {"infra", "depth"});
  }));
  std::size_t most = 0;
  for (const ImageTopic& one : topics) most = std::max(most, sharedFolders(one.topic->name, depth));
  topics =
      select(topics, [&](const ImageTopic& one) { return sharedFolders(one.topic->name, depth) == most; });
  topics = preferred(std::move(topics), [](const ImageTopic& one) {
    return hasWord(one.topic->name, {"color", "rgb"});
  });
  if (topics.empty()) return std::optional<ImageTopic>();
  if (topics.size() == 1) return std::optional(topics.front());
  return fail(file.path().string() + " holds several colour topics: " + listOf(topics) + ".",
              "Choose one with --color-topic NAME.");
}

}  // namespace

Result<ChosenTopics> chooseTopics(MessageFile& file, const SourceOptions& options) {
  const Result<ImageTopics> images = imageTopicsOf(file);
  if (!images) return fail(images.error());
  const Result<ImageTopic> depth = chooseDepth(file, *images, options.depth_topic);
  if (!depth) return fail(depth.error());
  const auto color = chooseColor(file, *images, options.color_topic, depth->topic->name);
  if (!color) return fail(color.error());
  ChosenTopics chosen{depth->topic, depth->kind, nullptr, {}};
  if (*color) {
    chosen.color = (*color)->topic;
    chosen.color_kind = (*color)->kind;
  }
  return chosen;
}

const MessageTopic* cameraInfoOf(const MessageFile& file, const std::string& topic) {
  for (std::string folder = parentTopic(topic); !folder.empty(); folder = parentTopic(folder)) {
    for (const char* end : {"/camera_info", "/info/camera_info"}) {
      if (const MessageTopic* const found = file.findTopic(folder + end)) return found;
    }
    if (folder.find('/') == std::string::npos) break;
  }
  return nullptr;
}

}  // namespace scantrove
