#include "core/session/recording_part.h"

namespace scantrove {

std::string partInWords(const SourceOptions& options) {
  std::string words;
  const auto add = [&](const std::string& more) { words += (words.empty() ? "" : ", ") + more; };
  if (options.start > 0) add("from frame " + std::to_string(options.start));
  if (options.stride > 1) add("one of " + std::to_string(options.stride));
  if (options.frames) add(std::to_string(*options.frames) + " frames");
  if (options.loops > 1) add(std::to_string(options.loops) + " times");
  return words.empty() ? kWholeRecording : words;
}

}  // namespace scantrove
