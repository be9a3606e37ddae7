#pragma once
#include <QDockWidget>
#include <QList>
#include <QMainWindow>
#include <QObject>
#include <QSize>
#include <map>

namespace scantrove {

/// The docks of the main window: their positions, preferred widths, and which of them need a scan. Restores
/// widths after the window was small. Stored between runs.
class DockArrangement : public QObject {
  Q_OBJECT

 public:
  explicit DockArrangement(QMainWindow& window);

  struct Dock {
    QString title;
    const char* name;  ///< object name for stored settings
    QString key;       ///< shortcut that shows and hides it
    Qt::DockWidgetArea area;
    int default_width;
    bool only_with_scan;
  };
  QDockWidget* add(const Dock& dock, QWidget* content);
  /// Call after all docks were added: restores the last layout, or the default one.
  void restore();
  void save();
  void resetLayout();
  /// Default layout for a screen of this size; on a small one docks are tabbed.
  void arrangeFor(const QSize& room);
  /// Hides the docks that need a scan while there is none.
  void setScanShown(bool shown);

  [[nodiscard]] const QList<QDockWidget*>& docks() const { return docks_; }

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  [[nodiscard]] std::map<QDockWidget*, int> presentWidths() const;
  void applyWidths();
  void applyWidthsSoon();  ///< after Qt's layout of the docks
  void recordWidths();

  QMainWindow& window_;
  QList<QDockWidget*> docks_;
  std::map<QDockWidget*, Dock> defaults_;
  std::map<QDockWidget*, int> preferred_widths_;
  std::map<QDockWidget*, int> widths_at_press_;
  QList<QDockWidget*> waiting_for_scan_;  ///< hidden until a scan is shown
  bool is_scan_shown_ = true;
};

}  // namespace scantrove
