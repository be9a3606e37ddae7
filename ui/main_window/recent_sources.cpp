#include "ui/main_window/recent_sources.h"

#include <QFileInfo>
#include <QSettings>

#include "core/capture/open_input.h"

namespace scantrove {
namespace {
const QString kKey = QStringLiteral("recent_sources");
constexpr int kMax = 8;

bool sourceExists(const QString& source) {
  return source == QLatin1String("demo") || source.startsWith(QLatin1String("demo:")) ||
         isCameraName(source.toStdString()) || QFileInfo::exists(source);
}
}  // namespace

QStringList recentSources() {
  QStringList sources;
  for (const QString& source : QSettings().value(kKey).toStringList()) {
    if (sourceExists(source)) sources << source;
  }
  return sources;
}

void addRecentSource(const QString& source) {
  QStringList sources = recentSources();
  sources.removeAll(source);
  sources.prepend(source);
  QSettings().setValue(kKey, QStringList(sources.mid(0, kMax)));
}

void clearRecentSources() { QSettings().remove(kKey); }

}  // namespace scantrove
