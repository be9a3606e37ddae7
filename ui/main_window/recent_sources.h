#pragma once
#include <QStringList>

namespace scantrove {

/// What was opened lately, newest first, remembered between runs. Paths that are gone are left out.
[[nodiscard]] QStringList recentSources();
void rememberSource(const QString& source);
void forgetRecentSources();

/// Whether the folder is a scan that was kept.
[[nodiscard]] bool isSessionFolder(const QString& folder);

}  // namespace scantrove
