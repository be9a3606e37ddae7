#pragma once
#include <QToolBar>

#include "ui/painting/mask_picture.h"

class QAction;
class QComboBox;
class QSlider;

namespace scantrove {

/// What the image mode shows: which picture, the masks and names over it, and what it is compared with.
class ImageViewBar : public QToolBar {
  Q_OBJECT

 public:
  explicit ImageViewBar(QWidget* parent = nullptr);

  /// The titles of the pictures.
  void setPictures(const QStringList& titles);
  [[nodiscard]] int picture() const;
  void setPicture(int index);
  void nextPicture();
  [[nodiscard]] MaskStyle style() const { return style_; }
  [[nodiscard]] bool showsNames() const;
  /// Opacities, 0 .. 1.
  [[nodiscard]] double masksOpacity() const;
  [[nodiscard]] double comparison() const;
  [[nodiscard]] QAction* styleAction() const { return style_action_; }
  [[nodiscard]] QAction* namesAction() const { return names_; }
  [[nodiscard]] QAction* besideAction() const { return beside_; }
  [[nodiscard]] QSlider* comparisonSlider() const { return comparison_; }
  [[nodiscard]] QSlider* opacitySlider() const { return opacity_; }
  [[nodiscard]] QList<QAction*> keyActions() const { return {style_action_, names_, beside_}; }

 signals:
  void changed();  ///< anything but the layout
  void besideToggled(bool beside);

 private:
  void setStyle(MaskStyle style);
  QSlider* addSlider(const QString& name, const QString& help, int value);

  QComboBox* pictures_;
  QAction *style_action_, *names_, *beside_;
  QSlider *opacity_ = nullptr, *comparison_ = nullptr;
  MaskStyle style_ = MaskStyle::fill;
};

}  // namespace scantrove
