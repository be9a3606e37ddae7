#pragma once
#include <QStringList>

namespace scantrove {

/// What was opened lately, newest first, remembered between runs. Paths that are gone are left out.
[[nodiscard]] QStringList recentSources();
void rememberSource(const QString& source);
void forgetRecentSources();

}  // namespace scantrove
