#include <gtest/gtest.h>

#include <QApplication>
#include <QSettings>
#include <QTemporaryDir>
#include <clocale>

#include "ui/language/window_language.h"
#include "ui/theme/icon.h"
#include "ui/theme/theme.h"

int main(int argc, char** argv) {
  // Keeps the user's settings and catalogue unchanged.
  const QTemporaryDir home;
  for (const char* variable : {"XDG_CONFIG_HOME", "XDG_DATA_HOME", "XDG_CACHE_HOME", "XDG_STATE_HOME"}) {
    qputenv(variable, home.path().toLocal8Bit());
  }
  QApplication application(argc, argv);
  std::setlocale(LC_NUMERIC, "C");
  QApplication::setOrganizationName(QStringLiteral("scantrove"));
  QApplication::setApplicationName(QStringLiteral("scantrove-tests"));
  scantrove::initializeResources();
  const scantrove::WindowLanguage language(scantrove::LanguageChoice::english);
  scantrove::Theme::instance().choose(scantrove::ThemeChoice::dark);
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
