#pragma once
#include <QDockWidget>
#include <QList>
#include <QMainWindow>
#include <QObject>
#include <QSize>
#include <map>

namespace scantrove {

/// The docks of the main window: where they are, how wide a person wants each, and which of them only make
/// sense with a scan. A window that was small for a while gives the docks their width back. All of it is kept
/// between runs.
class DockArrangement : public QObject {
  Q_OBJECT

 public:
  explicit DockArrangement(QMainWindow& window);

  struct Dock {
    QString title;
    const char* name;  ///< under which it is remembered
    QString key;       ///< shows and hides it
    Qt::DockWidgetArea area;
    int usual_width;
    bool only_with_scan;
  };
  QDockWidget* add(const Dock& dock, QWidget* content);
  /// After all were added: as at the last run, or as usual.
  void restore();
  void save();
  void arrangeAsUsual();
  /// As usual in so much room: where there is little, docks share a place, as tabs.
  void arrangeFor(const QSize& room);
  /// Without a scan, the docks that need one are hidden; those that were open come back with it.
  void setScanShown(bool shown);

  [[nodiscard]] const QList<QDockWidget*>& docks() const { return docks_; }

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  [[nodiscard]] std::map<QDockWidget*, int> presentWidths() const;
  void applyWidths();
  void applyWidthsSoon();  ///< after Qt has laid the docks out
  void recordWidths();

  QMainWindow& window_;
  QList<QDockWidget*> docks_;
  std::map<QDockWidget*, Dock> usual_;
  std::map<QDockWidget*, int> preferred_widths_;
  std::map<QDockWidget*, int> widths_at_press_;
  QList<QDockWidget*> waiting_for_scan_;  ///< hidden until then
  bool is_scan_shown_ = true;
};

}  // namespace scantrove
