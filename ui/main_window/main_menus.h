#pragma once
#include <QObject>

#include "ui/main_window/window_parts.h"
#include "ui/theme/theme.h"

class QMenu;

namespace scantrove {

class MainWindow;

/// The menus and the tool bar, and what their actions do.
class MainMenus : public QObject {
  Q_OBJECT

 public:
  /// The window's parts are there already.
  explicit MainMenus(MainWindow& window);

 private:
  void makeMenus();
  void makeToolBar();
  void connectActions();
  void fillRecentMenu();
  void chooseTheme(ThemeChoice choice);

  MainWindow& window_;
  const WindowParts parts_;
  QMenu* recent_ = nullptr;
};

}  // namespace scantrove
