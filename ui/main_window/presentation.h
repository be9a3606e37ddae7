#pragma once
#include <QElapsedTimer>
#include <QObject>
#include <QTemporaryDir>
#include <QTimer>
#include <memory>
#include <vector>

class QLabel;
class QWidget;

namespace scantrove {

class MainWindow;

/// The window as something to look at: the whole screen is the 3D view, which turns slowly when nobody
/// touches it, and a caption in large letters says what happens. From the first page on it shows scans of its
/// own, again and again; what is open already stays as it is. Escape leaves.
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
  /// The scan that used them has ended: removes the catalogues of presentations that are over.
  void removeEndedCatalogues();

  MainWindow& window_;
  QLabel* caption_;
  QTimer turning_, caption_timer_, again_;
  QElapsedTimer untouched_;
  QList<QWidget*> hidden_;  ///< for the time of it
  /// While it shows scans of its own: their catalogue. A person's is not filled with the demo's things.
  std::unique_ptr<QTemporaryDir> catalogue_;
  /// Of presentations that are over. The scan still writes into the last one until it has ended.
  std::vector<std::unique_ptr<QTemporaryDir>> ended_catalogues_;
  QString catalogue_before_;
  bool was_maximised_ = false;
  bool is_on_ = false;
};

}  // namespace scantrove
