#include "app/window_main.h"
#include "app/command_job.h"
#include "app/kernel_cache_use.h"

#include <QApplication>
#include <QSettings>
#include <QTimer>
#include <clocale>
#include <cstdlib>
#include <iostream>

#include "core/base/text.h"
#include "core/project/opened_path.h"
#include "ui/language/window_language.h"
#include "ui/main_window/main_window.h"
#include "ui/main_window/presentation.h"
#include "ui/main_window/scan_controller.h"
#include "ui/main_window/window_picture.h"
#include "ui/panels/object_list_view.h"
#include "ui/panels/object_panel.h"
#include "ui/theme/icon.h"
#include "ui/theme/theme.h"

namespace scantrove {
namespace {

constexpr int kSettle_ms = 1500;  ///< until the last snapshot is drawn

bool isSet(const char* variable) {
  const char* value = std::getenv(variable);
  return value != nullptr && *value != '\0';
}

/// VTK's OpenGL loader needs GLX, so a Wayland desktop uses X.
void choosePlatform() {
  if (!isSet("QT_QPA_PLATFORM") && isSet("WAYLAND_DISPLAY") && isSet("DISPLAY")) {
    qputenv("QT_QPA_PLATFORM", "xcb");
  }
}

void applyTheme(const std::string& requested) {
  const int remembered =
      QSettings().value(QStringLiteral("theme"), static_cast<int>(ThemeChoice::system)).toInt();
  ThemeChoice choice =
      remembered >= 0 && remembered <= 2 ? static_cast<ThemeChoice>(remembered) : ThemeChoice::system;
  if (requested == "dark") choice = ThemeChoice::dark;
  if (requested == "light") choice = ThemeChoice::light;
  Theme::instance().choose(choice);
}

/// When the scan ends, selects the newest object, waits until it is drawn, saves a picture and quits.
void takePictureAtEnd(MainWindow& window, const QString& file) {
  const auto save = [&window, file](int exit_code) {
    window.parts().objects->list()->selectNewest();
    QTimer::singleShot(kSettle_ms, &window, [&window, file, exit_code] {
      const Result<void> saved = saveWindowPicture(window, file);
      if (!saved) std::cerr << "scantrove: " << forTerminal(saved.error().message()) << '\n';
      QApplication::exit(saved ? exit_code : kJobFailed);
    });
  };
  ScanBridge& bridge = window.controller().bridge();
  bridge.on<ScanFinished>(&window, [save] { save(kDone); });
  bridge.on<ScanFailed>(&window, [save](const ScanFailed& failed) {
    std::cerr << "scantrove: " << forTerminal(failed.error.message()) << '\n';
    save(kJobFailed);
  });
  if (window.onStartPage()) {
    save(kDone);
  } else if (!window.controller().hasSource()) {  // a saved scan
    bridge.on<ReviewOpened>(&window, [save] { save(kDone); });
  }
}

}  // namespace

int runWindow(int& argc, char** argv, const WindowOptions& options) {
  choosePlatform();
  if (!isSet("DISPLAY") && !isSet("WAYLAND_DISPLAY") && !isSet("QT_QPA_PLATFORM")) {
    std::cerr << "scantrove: There is no display for the window. "
                 "To scan without a window: scantrove scan SOURCE --out DIR\n";
    return kJobFailed;
  }
  const KernelCacheUse kernels;
  QApplication application(argc, argv);
  // QApplication sets the user's locale; files need the C number format.
  std::setlocale(LC_NUMERIC, "C");
  QApplication::setOrganizationName(QStringLiteral("scantrove"));
  QApplication::setApplicationName(QStringLiteral("scantrove"));
  QApplication::setApplicationDisplayName(QStringLiteral("Scantrove"));
  QApplication::setDesktopFileName(QStringLiteral("io.github.scantrove.Scantrove"));
#ifdef SCANTROVE_VERSION
  QApplication::setApplicationVersion(QStringLiteral(SCANTROVE_VERSION));
#endif
  initializeResources();
  const WindowLanguage language(chosenLanguage());
  applyTheme(options.theme);

  MainWindow window(startScanWorker, options);
  window.show();
  if (options.present) window.presentation()->begin();
  if (!options.source.empty()) {
    const QString source = QString::fromStdString(options.source);
    if (recognizePath(options.source).kind == OpenedPath::Kind::other) {
      window.controller().open(source, options.source_options, options.poses);
    } else {
      window.open(source);
    }
  }
  if (options.screenshot) takePictureAtEnd(window, QString::fromStdString(options.screenshot->string()));
  return QApplication::exec();
}

}  // namespace scantrove
