#pragma once
#include <QWidget>

#include "core/dataset/export_sample.h"

class QLabel;
class QToolButton;

namespace scantrove {

/// Preview of one image of a data set with its masks. Buttons, or Page up and Page down anywhere in the
/// dialog, show the others. Use from the window's thread.
class ExportSampleView : public QWidget {
  Q_OBJECT

 public:
  explicit ExportSampleView(QWidget* parent = nullptr);

  /// Hidden if the format has no images.
  void showSample(const ExportSample& sample);
  /// Index of the shown or requested image; none: not known yet.
  [[nodiscard]] std::optional<int> index() const { return index_; }
  [[nodiscard]] QString caption() const;
  [[nodiscard]] bool hasPicture() const;

 signals:
  void rowRequested(int index);

 private:
  void step(int by);
  void updateButtons();

  QLabel* picture_;
  QLabel* caption_;
  QToolButton* back_;
  QToolButton* on_;
  std::optional<int> index_;
  int count_ = 0;
};

}  // namespace scantrove
