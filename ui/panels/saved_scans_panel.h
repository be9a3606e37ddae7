#pragma once
#include <QString>
#include <QWidget>
#include <vector>

class QGridLayout;
class QLabel;

namespace scantrove {

/// A saved scan in the list.
struct SavedScanEntry {
  QString folder;
  QString title;    ///< name of the source
  QString details;  ///< when, frames, objects, size
  QString picture;  ///< an image file; empty: none
};

/// Cards of the saved scans, newest first; a click opens one. Hidden while there are none.
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
