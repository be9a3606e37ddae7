#pragma once
#include <cstddef>
#include <string>
#include <string_view>

#include "core/base/result.h"

namespace scantrove {

/// Decodes LZFSE data (Apple's compression): stored, LZVN and LZFSE blocks up to the mark of the end.
/// `max_bytes`: most that it may decode to; nothing larger is allocated. Error: names `name`; damaged,
/// truncated or larger.
[[nodiscard]] Result<std::string> decodeLzfse(std::string_view bytes, std::size_t max_bytes,
                                              const std::string& name);

}  // namespace scantrove
