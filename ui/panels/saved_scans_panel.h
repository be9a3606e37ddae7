#pragma once
#include <QString>
#include <QWidget>
#include <vector>

class QGridLayout;
class QLabel;

namespace scantrove {

/// A scan that was kept, as it is shown in a list.
struct SavedScanEntry {
  QString folder;
  QString title;    ///< what was scanned
  QString details;  ///< when, frames, objects, size
  QString picture;  ///< an image file; empty: none
};

/// Scans that were kept, newest first, with pictures: a click opens one. Hidden while there are none.
class SavedScansPanel : public QWidget {
  Q_OBJECT

 public:
  explicit SavedScansPanel(QWidget* parent = nullptr);
  void setScans(const std::vector<SavedScanEntry>& scans);

 signals:
  void chosen(const QString& folder);
  void deleteRequested(const QString& folder);

 private:
  [[nodiscard]] QWidget* makeCard(const SavedScanEntry& scan);

  QGridLayout* cards_;
  QLabel* more_;
};

}  // namespace scantrove
