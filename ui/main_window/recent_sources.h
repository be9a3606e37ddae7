#pragma once
#include <QStringList>

namespace scantrove {

/// Recently opened sources, newest first, stored between runs. Omits missing paths.
[[nodiscard]] QStringList recentSources();
void addRecentSource(const QString& source);
void clearRecentSources();

}  // namespace scantrove
