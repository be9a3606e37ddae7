#pragma once
#include <QImage>
#include <QSize>
#include <QString>
#include <QWidget>
#include <vector>

class QGridLayout;
class QLabel;
class QMenu;

namespace scantrove {

/// A saved scan in the list.
struct SavedScanEntry {
  QString folder;
  QString title;                ///< name of the source
  QString details;              ///< when, frames, objects, reviewed key frames, size
  QString picture;              ///< an image file; empty: none
  QImage thumbnail = {};        ///< of the picture, of kScanPicture; null: it is read when it is shown
  bool can_be_opened = true;    ///< it is neither damaged nor in use
  bool can_be_refined = false;  ///< its refinement is still to be done
};

inline constexpr QSize kScanPicture(96, 72);

/// Reads the middle of an image file in the size kScanPicture. Null: it cannot be read. Any thread.
[[nodiscard]] QImage readScanPicture(const QString& file);

/// What a user may do with a saved scan, besides opening and deleting it.
enum class SavedScanAction { resume, refine, export_data };

/// Cards of the saved scans, newest first; a click opens one, its button and the right mouse button show the
/// actions. Two beside each other where that leaves room for their texts. Hidden while there are none.
class SavedScansPanel : public QWidget {
  Q_OBJECT

 public:
  explicit SavedScansPanel(QWidget* parent = nullptr);
  void setScans(const std::vector<SavedScanEntry>& scans);

 signals:
  void chosen(const QString& folder);
  void deleteRequested(const QString& folder);
  void actionRequested(const QString& folder, scantrove::SavedScanAction action);

 private:
  void resizeEvent(QResizeEvent* event) override;
  /// Puts cards beside each other, by the present width.
  void arrange(const std::vector<QWidget*>& cards);
  [[nodiscard]] QWidget* makeCard(const SavedScanEntry& scan);
  [[nodiscard]] QMenu* makeMenu(const SavedScanEntry& scan, QWidget* card);

  QGridLayout* cards_;
  int columns_ = 1;
  QLabel* more_;
};

}  // namespace scantrove
