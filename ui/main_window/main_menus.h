#pragma once
#include <QObject>

#include "ui/main_window/window_parts.h"
#include "ui/theme/theme.h"

class QMenu;

namespace scantrove {

class MainWindow;

/// Creates menus and tool bar, and connects their actions.
class MainMenus : public QObject {
  Q_OBJECT

 public:
  /// Call after the window's parts were created.
  explicit MainMenus(MainWindow& window);

 private:
  void makeMenus();
  void makeToolBar();
  void connectActions();
  void fillRecentMenu();
  void fillRecentProjects();
  void chooseTheme(ThemeChoice choice);

  MainWindow& window_;
  const WindowParts parts_;
  QMenu* recent_ = nullptr;
  QMenu* recent_projects_ = nullptr;
};

}  // namespace scantrove
