#pragma once
#include <QString>
#include <QWidget>
#include <vector>

class QGridLayout;
class QLabel;

namespace scantrove {

/// A scan that was kept, as it is shown in a list.
struct KeptScan {
  QString folder;
  QString title;    ///< what was scanned
  QString details;  ///< when, frames, objects, size
  QString picture;  ///< an image file; empty: none
};

/// Scans that were kept, newest first, with pictures: a click opens one. Hidden while there are none.
class KeptScans : public QWidget {
  Q_OBJECT

 public:
  explicit KeptScans(QWidget* parent = nullptr);
  void setScans(const std::vector<KeptScan>& scans);

 signals:
  void chosen(const QString& folder);
  void deleteWanted(const QString& folder);

 private:
  [[nodiscard]] QWidget* makeCard(const KeptScan& scan);

  QGridLayout* cards_;
  QLabel* more_;
};

}  // namespace scantrove
