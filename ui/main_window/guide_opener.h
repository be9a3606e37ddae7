#pragma once
#include <QObject>
#include <QString>

class QAction;

namespace scantrove {

class MainWindow;

/// The first page of the guide for a program in `program_folder`: that of the installation, else the one that
/// packaging/guide built beside the build folder of the program. Empty: there is none.
[[nodiscard]] QString guidePage(const QString& program_folder);

/// Shows the guide in the user's browser, as a file of this computer.
class GuideOpener : public QObject {
  Q_OBJECT

 public:
  explicit GuideOpener(MainWindow& window);

  [[nodiscard]] QAction* action() const { return action_; }

  /// A message says where the guide is if it is not there, or if no program shows it.
  void open(const QString& program_folder);

 private:
  MainWindow& window_;
  QAction* action_;
};

}  // namespace scantrove
