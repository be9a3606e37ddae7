#include "core/project/recording_list.h"

#include <set>
#include <string_view>
#include <utility>

#include "core/base/text.h"
#include "core/base/text_file.h"

namespace scantrove {

Result<std::vector<std::string>> readRecordingList(const std::filesystem::path& file,
                                                   const std::function<bool(const std::string&)>& is_path) {
  const Result<std::string> text = readTextFile(file);
  if (!text) return fail(text.error());
  const std::filesystem::path folder = std::filesystem::absolute(file).parent_path();
  std::vector<std::string> sources;
  for (const std::string_view line : splitLines(*text)) {
    const std::string source(trimmed(line));
    if (source.empty() || source.front() == '#') continue;
    sources.push_back(is_path(source) ? (folder / source).lexically_normal().string() : source);
  }
  if (sources.empty()) {
    return fail("The list " + file.string() + " names no recording.",
                "Write one recording a line: a folder, a file, a camera or 'demo'.");
  }
  return sources;
}

std::vector<std::string> withoutRepetitions(std::vector<std::string> sources) {
  std::set<std::string> seen;
  std::erase_if(sources, [&](const std::string& source) { return !seen.insert(source).second; });
  return sources;
}

}  // namespace scantrove
