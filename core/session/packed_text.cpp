#include "core/session/packed_text.h"

#include <QByteArray>
#include <sstream>

#include "core/fusion/packed_words.h"

namespace scantrove {

std::string packedText(std::span<const std::uint32_t> words) {
  const PackedWords packed = packWords(words);
  const QByteArray bytes(packed.bytes.data(), static_cast<qsizetype>(packed.bytes.size()));
  return std::to_string(packed.unpacked_bytes) + ' ' + std::to_string(packed.checksum) + ' ' +
         bytes.toBase64().toStdString();
}

std::optional<std::vector<std::uint32_t>> wordsFromText(const std::string& text) {
  constexpr std::uint32_t kMaxBytes = 1U << 30U;
  std::istringstream stream(text);
  PackedWords packed;
  std::string base64;
  if (!(stream >> packed.unpacked_bytes >> packed.checksum >> base64)) return std::nullopt;
  if (packed.unpacked_bytes == 0 || packed.unpacked_bytes >= kMaxBytes) return std::nullopt;
  const auto bytes = QByteArray::fromBase64Encoding(QByteArray::fromStdString(base64),
                                                    QByteArray::AbortOnBase64DecodingErrors);
  if (!bytes) return std::nullopt;
  const QByteArray& raw = *bytes;
  packed.bytes.assign(raw.begin(), raw.end());
  return unpackWords(packed);
}

}  // namespace scantrove
