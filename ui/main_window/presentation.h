#pragma once
#include <QElapsedTimer>
#include <QObject>
#include <QTemporaryDir>
#include <QTimer>
#include <memory>

class QLabel;
class QWidget;

namespace scantrove {

class MainWindow;

/// The window as something to look at: the whole screen is the 3D view, which turns slowly when nobody
/// touches it, a caption in large letters says what happens, and a scan that has ended begins again. Escape
/// leaves.
class Presentation : public QObject {
  Q_OBJECT

 public:
  explicit Presentation(MainWindow& window);

  void begin();
  void end();
  [[nodiscard]] bool isOn() const { return is_on_; }
  [[nodiscard]] QString caption() const;

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  /// All but the 3D view; what comes with a scan, too.
  void hideOthers();
  void say(const QString& text);
  void turn();
  void placeCaption();
  void scanHasEnded();

  MainWindow& window_;
  QLabel* caption_;
  QTimer turning_, caption_goes_, again_;
  QElapsedTimer untouched_;
  QList<QWidget*> hidden_;  ///< for the time of it
  /// While it shows scans of its own: their catalogue. A person's is not filled with the demo's things.
  std::unique_ptr<QTemporaryDir> catalogue_;
  QString catalogue_before_;
  bool was_maximised_ = false;
  bool is_on_ = false;
};

}  // namespace scantrove
