#include "core/session/final_label_record.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <array>

#include "core/base/byte_stream.h"
#include "core/base/checksum.h"
#include "core/session/packed_text.h"

namespace scantrove {
namespace {

constexpr std::uint32_t kFinalLabelsVersion = 1;

}  // namespace

std::string finalLabelsToText(const FinalLabelRecord& record) {
  ByteWriter to;
  to.put(kFinalLabelsVersion);
  to.putList(std::span<const FinalLabelImage>(record));
  return packedText(to.take());
}

FinalLabelRecord finalLabelsFrom(const SessionMetadata& metadata) {
  const auto found = metadata.find(kFinalLabelsKey);
  if (found == metadata.end()) return {};
  const auto words = wordsFromText(found->second);
  if (!words) return {};
  ByteReader from(*words);
  if (from.get<std::uint32_t>() != kFinalLabelsVersion) return {};
  FinalLabelRecord record = from.getList<FinalLabelImage>();
  if (!from.isAtEnd()) return {};
  std::ranges::stable_sort(record, {}, &FinalLabelImage::frame_index);
  return record;
}

std::uint32_t checksumOfDepth(const cv::Mat& depth) {
  const std::array<int, 2> size{depth.cols, depth.rows};
  std::uint32_t crc = crc32Of({reinterpret_cast<const char*>(size.data()), sizeof(size)});
  const std::size_t row_bytes = static_cast<std::size_t>(depth.cols) * depth.elemSize();
  for (int y = 0; y < depth.rows; ++y) crc = crc32Of({depth.ptr<char>(y), row_bytes}, crc);
  return crc;
}

std::string labelFileName(int frame_index) { return fmt::format("{:06}.png", frame_index); }

}  // namespace scantrove
