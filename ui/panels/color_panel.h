#pragma once
#include <functional>
#include <set>
#include <vector>

#include "core/scan/scan_snapshot.h"
#include "ui/panels/image_panel.h"

namespace scantrove {

/// The colour image with what was found in it (thesis, figures 5.1 and 5.6): a white rectangle around each
/// discovered object; a cyan name at its top left when the object was recognised, a white one when it is new.
/// A thin dashed rectangle, without a name: a candidate that has not shown itself whole yet. What is selected
/// in the object list is lit up in yellow.
class ColorPanel : public ImagePanel {
  Q_OBJECT

 public:
  explicit ColorPanel(QWidget* parent = nullptr);
  /// The name an object has now, empty if unknown: names may change after the frame was taken.
  using NameOf = std::function<QString(ObjectId)>;
  void setNameOf(NameOf name_of) { name_of_ = std::move(name_of); }
  /// Whether the scan knew it from the catalogue, also where a frame does not say so: of a scan that has
  /// ended.
  using IsRecognized = std::function<bool(ObjectId)>;
  void setIsRecognized(IsRecognized is_recognized) { is_recognized_ = std::move(is_recognized); }

  void setFrame(const QImage& picture, const std::vector<SeenObject>& objects);
  /// While the camera is lost: a view that it would be found by, drawn over the picture like a ghost; null:
  /// none.
  void setGhost(const QImage& ghost);
  [[nodiscard]] const QImage& ghost() const { return ghost_; }
  void setSelected(const std::set<ObjectId>& selected);

  /// The rectangle of an object as drawn, in widget coordinates.
  [[nodiscard]] QRectF objectRect(const SeenObject& object) const;

 protected:
  void paintOverlay(QPainter& painter, const QRectF& rect) override;

 private:
  [[nodiscard]] QString nameOf(const SeenObject& object) const;
  [[nodiscard]] bool isSelected(const SeenObject& object) const;
  [[nodiscard]] bool isRecognized(const SeenObject& object) const;
  void sortObjects();
  void paintGhost(QPainter& painter, const QRectF& rect) const;

  std::vector<SeenObject> objects_;  ///< the selected ones first
  std::set<ObjectId> selected_;
  QImage ghost_;
  NameOf name_of_;
  IsRecognized is_recognized_;
};

}  // namespace scantrove
