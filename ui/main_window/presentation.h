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

/// Presentation mode: shows the 3D view full screen, turning slowly without user input, with large captions
/// of events. Started from the start page, it repeats its scans with a temporary catalogue and does not save
/// them. Escape ends it.
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
  /// Hides everything except the 3D view, also docks that a scan opens.
  void hideOthers();
  void showCaption(const QString& text);
  void turn();
  void placeCaption();
  void scanHasEnded();
  /// Removes catalogues of ended presentations when no scan uses them.
  void removeEndedCatalogues();

  MainWindow& window_;
  QLabel* caption_;
  QTimer turning_, caption_timer_, repeat_timer_;
  QElapsedTimer since_input_;
  QList<QWidget*> hidden_;  ///< widgets to show again
  /// Temporary catalogue of the scans, so that the user's one gets no objects of the demo.
  std::unique_ptr<QTemporaryDir> catalogue_;
  /// Of ended presentations. A scan may still write to the last one.
  std::vector<std::unique_ptr<QTemporaryDir>> ended_catalogues_;
  bool was_maximized_ = false;
  bool is_on_ = false;
};

}  // namespace scantrove
