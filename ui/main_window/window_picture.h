#pragma once
#include <QString>

#include "core/base/result.h"

namespace scantrove {

class MainWindow;

/// Saves a picture of the whole window, the 3D view at full detail included.
[[nodiscard]] Result<void> saveWindowPicture(MainWindow& window, const QString& file);

}  // namespace scantrove
