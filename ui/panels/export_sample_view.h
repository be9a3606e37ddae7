#pragma once
#include <QWidget>

#include "core/dataset/export_sample.h"

class QLabel;
class QToolButton;

namespace scantrove {

/// One image of a data set that is about to be made, with its masks, and the way to the others: buttons, or
/// Page up and Page down anywhere in the dialog. The window's thread.
class ExportSampleView : public QWidget {
  Q_OBJECT

 public:
  explicit ExportSampleView(QWidget* parent = nullptr);

  /// Hides itself where the format has no images.
  void showSample(const ExportSample& sample);
  /// Which image is shown, or was asked for; none: not known yet.
  [[nodiscard]] std::optional<int> place() const { return place_; }
  [[nodiscard]] QString said() const;
  [[nodiscard]] bool hasPicture() const;

 signals:
  void rowRequested(int place);

 private:
  void step(int by);
  void updateButtons();

  QLabel* picture_;
  QLabel* said_;
  QToolButton* back_;
  QToolButton* on_;
  std::optional<int> place_;
  int count_ = 0;
};

}  // namespace scantrove
