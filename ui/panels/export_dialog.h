#pragma once
#include <QDialog>
#include <QTimer>

#include "core/scan/scan_command.h"
#include "core/scan/scan_event.h"

class QCheckBox;
class QComboBox;
class QLabel;
class QLineEdit;
class QProgressBar;
class QPushButton;
class QScrollArea;

namespace scantrove {

class ExportSampleView;

/// Dialog for exporting a data set: options, a preview of its content and images, and progress. Not modal.
class ExportDialog : public QDialog {
  Q_OBJECT

 public:
  /// `name`: of the scan, used for the proposed folder.
  ExportDialog(const QString& name, QWidget* parent);

  [[nodiscard]] ExportOptions options() const;
  /// Large enough for the content, within the screen.
  [[nodiscard]] QSize sizeHint() const override;
  [[nodiscard]] QString message() const;
  [[nodiscard]] ExportSampleView* sampleView() const { return sample_; }
  [[nodiscard]] bool isWorking() const { return is_working_; }

  /// Shows the results of the posted commands.
  void handleEvent(const ScanEvent& event);
  void begin();
  void reject() override;

 signals:
  void posted(const scantrove::ScanCommand& command);

 private:
  void showPreview(const ExportPreview& preview);
  void showProgress(const ExportProgress& progress);
  void showDone(const ExportSummary& summary);
  void showFailure(const Error& error);
  void choose();
  void formatChanged();
  void requestPreview();
  void setWorking(bool working);
  [[nodiscard]] QString proposedFolder() const;

  QString name_;
  QWidget* content_ = nullptr;  ///< in scroll_
  QScrollArea* scroll_ = nullptr;
  QComboBox* format_;
  QLabel* about_;
  QLineEdit* folder_;
  QCheckBox* all_frames_;
  QCheckBox* background_;
  QCheckBox* include_unfit_;
  QLineEdit* license_;
  ExportSampleView* sample_;
  QLabel* message_;
  QProgressBar* bar_;
  QPushButton* export_;
  QPushButton* cancel_;
  QPushButton* show_folder_;
  QTimer preview_timer_;
  bool is_working_ = false;
  QString done_folder_;
};

}  // namespace scantrove
