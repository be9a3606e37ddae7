#pragma once
#include <functional>
#include <set>
#include <vector>

#include "core/scan/scan_snapshot.h"
#include "ui/panels/image_panel.h"

namespace scantrove {

/// The colour image with objects (thesis, figures 5.1 and 5.6): a white rectangle around each discovered
/// object, with a cyan name if it was recognised and a white name if it is new. A thin dashed rectangle
/// without a name is a candidate. Objects selected in the object list are yellow.
class ColorPanel : public ImagePanel {
  Q_OBJECT

 public:
  explicit ColorPanel(QWidget* parent = nullptr);
  /// Returns the current name of an object, or an empty string. Names may change after a frame was taken.
  using NameOf = std::function<QString(ObjectId)>;
  void setNameOf(NameOf name_of) { name_of_ = std::move(name_of); }
  /// Returns whether the scan recognised the object. Needed after a scan, when frames do not say so.
  using IsRecognized = std::function<bool(ObjectId)>;
  void setIsRecognized(IsRecognized is_recognized) { is_recognized_ = std::move(is_recognized); }

  void setFrame(const QImage& picture, const std::vector<SeenObject>& objects);
  /// The name of a region that is no known object in the frame, at a place of it in fractions of the picture.
  struct RegionLabelInImage {
    QPointF fraction;
    QString name;
  };
  void setRegionNames(std::vector<RegionLabelInImage> names);
  [[nodiscard]] const std::vector<RegionLabelInImage>& regionNames() const { return region_names_; }
  /// While the camera is lost: a view that relocalisation would recognise, drawn transparently over the
  /// picture; null: none.
  void setGhost(const QImage& ghost);
  [[nodiscard]] const QImage& ghost() const { return ghost_; }
  void setSelected(const std::set<ObjectId>& selected);

  /// The drawn rectangle of an object, in widget coordinates.
  [[nodiscard]] QRectF objectRect(const SeenObject& object) const;

 protected:
  void paintOverlay(QPainter& painter, const QRectF& rect) override;

 private:
  [[nodiscard]] QString nameOf(const SeenObject& object) const;
  [[nodiscard]] bool isSelected(const SeenObject& object) const;
  [[nodiscard]] bool isRecognized(const SeenObject& object) const;
  void sortObjects();
  void paintGhost(QPainter& painter, const QRectF& rect) const;

  std::vector<RegionLabelInImage> region_names_;
  std::vector<SeenObject> objects_;  ///< the selected ones first
  std::set<ObjectId> selected_;
  QImage ghost_;
  NameOf name_of_;
  IsRecognized is_recognized_;
};

}  // namespace scantrove
