#pragma once

namespace scantrove {

/// Narrower depth images do not fit the lanes of every device.
inline constexpr int kMinWidth_px = 16;

}  // namespace scantrove
