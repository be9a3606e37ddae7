#pragma once
#include <QPoint>
#include <QStringList>
#include <QWidget>
#include <optional>
#include <set>
#include <vector>

#include "core/scan/scan_snapshot.h"
#include "ui/common/region_point.h"
#include "ui/models/place_marks.h"
#include "ui/panels/frame_pointing.h"
#include "ui/panels/image_conversion.h"

namespace scantrove {

class ColorPanel;
class DepthPanel;
class ImagePanel;

/// The five pictures of the current frame: one large, the others in a grid below it. A click on a title makes
/// another one large; what is pointed at in one is lit up in all.
class FramePanels : public QWidget {
  Q_OBJECT

 public:
  explicit FramePanels(QWidget* parent = nullptr);

  void showSnapshot(const ScanSnapshot& snapshot);
  void clear();
  /// Lights up these objects in the colour image, and their regions among the others.
  void setSelected(const std::set<ObjectId>& selected);
  void feature(ImagePanel* panel);
  void featureNext();
  /// Lights up regions in all pictures.
  void setLit(RegionId hovered, const std::vector<RegionId>& selected);
  /// Beside the pointer, in the picture that it is in.
  void setTag(const QStringList& tag);
  /// With a colour, drags on the pictures draw strokes of it: strokeAt() says what lies under them.
  void setStrokeColor(const std::optional<QColor>& color);
  /// Marks places of the surface in all pictures that show them.
  void setMarks(std::vector<PlaceMarks> marks);
  [[nodiscard]] const FramePointing& pointing() const { return pointing_; }
  [[nodiscard]] ImagePanel* featured() const { return panels_[featured_]; }
  [[nodiscard]] const std::vector<ImagePanel*>& panels() const { return panels_; }
  [[nodiscard]] ColorPanel* colorPanel() const { return color_; }

  [[nodiscard]] QSize sizeHint() const override { return {420, 660}; }

 signals:
  void pointedAt(const scantrove::RegionPoint& point);
  void pointerMoved();  ///< by the hand: pointedAt() also comes with each frame
  void pointerLeft();
  void clicked(const scantrove::RegionPoint& point, Qt::KeyboardModifiers modifiers);
  void doubleClicked(const scantrove::RegionPoint& point, const QPoint& on_screen);
  void menuRequested(const scantrove::RegionPoint& point, const QPoint& on_screen);
  void strokeAt(const scantrove::RegionPoint& point);
  void strokeEnded(Qt::KeyboardModifiers modifiers);
  void bandDrawn(const std::vector<scantrove::RegionId>& regions, Qt::KeyboardModifiers modifiers);

 public:
  [[nodiscard]] QSize minimumSizeHint() const override { return {200, 200}; }

 protected:
  void resizeEvent(QResizeEvent* event) override;

 private:
  void arrange();
  void showRegions();
  void showLit();
  void showMarks();
  void connectPointing(ImagePanel* panel);
  [[nodiscard]] FramePointing::Picture pictureOf(const ImagePanel* panel) const;

  ColorPanel* color_;
  DepthPanel* depth_raw_;
  DepthPanel* depth_fused_;
  ImagePanel* segments_;
  ImagePanel* regions_;
  std::vector<ImagePanel*> panels_;
  std::size_t featured_ = 0;
  cv::Mat region_ids_;               ///< of the frame shown
  std::vector<SeenObject> objects_;  ///< in it
  std::set<ObjectId> selected_;
  FramePointing pointing_;
  RegionId lit_hovered_;
  std::vector<RegionId> lit_selected_;
  std::vector<PlaceMarks> marks_;
  ImagePanel* pointed_panel_ = nullptr;  ///< that the pointer is in
  QPointF pointed_fraction_;
  DepthRange range_;
  bool has_range_ = false;
};

}  // namespace scantrove
