#pragma once
#include <vector>

#include "core/scan/scan_snapshot.h"
#include "ui/panels/image_panel.h"

namespace scantrove {

/// The colour image with what was found in it (thesis, figures 5.1 and 5.6): a white rectangle around each
/// discovered object; a cyan name at its top left when the object was recognised, a white one when it is new,
/// and
/// "?" while it is still being watched.
class ColorPanel : public ImagePanel {
  Q_OBJECT

 public:
  explicit ColorPanel(QWidget* parent = nullptr);
  void setFrame(const QImage& picture, const std::vector<SeenObject>& objects);

  /// The rectangle of an object as drawn, in widget coordinates.
  [[nodiscard]] QRectF objectRect(const SeenObject& object) const;

 protected:
  void paintOverlay(QPainter& painter, const QRectF& rect) override;

 private:
  std::vector<SeenObject> objects_;
};

}  // namespace scantrove
