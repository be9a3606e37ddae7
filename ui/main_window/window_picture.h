#pragma once
#include <QString>

#include "core/base/result.h"

namespace scantrove {

class MainWindow;

/// Saves a picture of the window, with the 3D view at full detail.
[[nodiscard]] Result<void> saveWindowPicture(MainWindow& window, const QString& file);

}  // namespace scantrove
