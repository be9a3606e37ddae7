#pragma once
#include <QDialog>
#include <QStringList>
#include <QTimer>

#include "core/scan/scan_command.h"
#include "core/scan/scan_event.h"

class QComboBox;
class QLabel;
class QProgressBar;
class QPushButton;
class QScrollArea;

namespace scantrove {

class ExportChoicesPanel;
class ExportFolderField;
class ExportSampleView;
class ExportScansPanel;
class ExportStatisticsView;

/// Dialog for exporting a data set of a scan or its project: options, a preview of its content and images,
/// counts, and progress. Not modal.
class ExportDialog : public QDialog {
  Q_OBJECT

 public:
  /// `name`: of the scan, used for the proposed folder.
  ExportDialog(const QString& name, QWidget* parent);

  /// The project of the scan, and the names of its scans.
  void setProject(const QString& name, const QStringList& scans);
  [[nodiscard]] ExportOptions options() const;
  /// Large enough for the content, within the screen.
  [[nodiscard]] QSize sizeHint() const override;
  [[nodiscard]] QString message() const;
  [[nodiscard]] ExportSampleView* sampleView() const { return sample_; }
  [[nodiscard]] bool isWorking() const { return work_ != Work::none; }

  /// Shows the results of the posted commands.
  void handleEvent(const ScanEvent& event);
  void begin() { start(Work::exporting); }
  /// Counts what begin() would write.
  void count() { start(Work::counting); }
  void reject() override;

 signals:
  void posted(const scantrove::ScanCommand& command);

 private:
  enum class Work { none, counting, exporting };

  void start(Work work);
  void showPreview(const ExportPreview& preview);
  void showProgress(const ExportProgress& progress);
  void showDone(const ExportSummary& summary);
  void showFailure(const Error& error);
  void formatChanged();
  void choicesChanged();
  void setWork(Work work);
  void layOut();
  [[nodiscard]] DatasetFormat format() const;

  QString name_, project_;
  QWidget* content_ = nullptr;  ///< in scroll_
  QScrollArea* scroll_ = nullptr;
  QComboBox* format_;
  QLabel* about_;
  ExportFolderField* folder_;
  ExportScansPanel* scans_;
  ExportChoicesPanel* choices_;
  ExportSampleView* sample_;
  ExportStatisticsView* statistics_;
  QLabel* message_;
  QProgressBar* bar_;
  QPushButton* count_;
  QPushButton* export_;
  QPushButton* cancel_;
  QPushButton* show_folder_;
  QTimer preview_timer_;
  Work work_ = Work::none;
  QString done_folder_;
};

}  // namespace scantrove
