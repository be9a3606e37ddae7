#pragma once
#include <QStringList>

namespace scantrove {

/// Recently opened sources, newest first, stored between runs. Omits missing paths.
[[nodiscard]] QStringList recentSources();
void addRecentSource(const QString& source);
void clearRecentSources();

/// Whether the folder holds a saved scan.
[[nodiscard]] bool isSessionFolder(const QString& folder);

}  // namespace scantrove
