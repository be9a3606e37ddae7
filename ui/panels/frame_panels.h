#pragma once
#include <QElapsedTimer>
#include <QPoint>
#include <QStringList>
#include <QWidget>
#include <map>
#include <optional>
#include <set>
#include <vector>

#include "core/scan/scan_snapshot.h"
#include "ui/common/region_point.h"
#include "ui/models/point_marks.h"
#include "ui/panels/frame_pointing.h"
#include "ui/panels/image_conversion.h"

namespace scantrove {

class ColorPanel;
class DepthPanel;
class ImagePanel;

/// The five pictures of the current frame: one large, the others in a grid below it. A click on a title
/// enlarges that picture. All pictures highlight the region under the pointer.
class FramePanels : public QWidget {
  Q_OBJECT

 public:
  explicit FramePanels(QWidget* parent = nullptr);

  void showSnapshot(const ScanSnapshot& snapshot);
  void clear();
  /// Highlights these objects in the colour image and their regions in the region image.
  void setSelected(const std::set<ObjectId>& selected);
  void feature(ImagePanel* panel);
  void featureNext();
  /// Names of regions, shown in the colour image at once.
  void setNames(std::map<RegionId, QString> names);
  /// Highlights regions in all pictures.
  void setHighlight(RegionId hovered, const std::vector<RegionId>& selected);
  /// Shows text beside the pointer, in the picture under it.
  void setTag(const QStringList& tag);
  /// With a colour, drags on the pictures draw strokes and emit strokeAt() for the surface under them.
  void setStrokeColor(const std::optional<QColor>& color);
  /// Marks surface points in all pictures that show them.
  void setMarks(std::vector<PointMarks> marks);
  [[nodiscard]] const FramePointing& pointing() const { return pointing_; }
  [[nodiscard]] ImagePanel* featured() const { return panels_[featured_]; }
  [[nodiscard]] const std::vector<ImagePanel*>& panels() const { return panels_; }
  [[nodiscard]] ColorPanel* colorPanel() const { return color_; }

  [[nodiscard]] QSize sizeHint() const override { return {420, 660}; }

 signals:
  void opened(int index);  ///< one of panels(), to be shown in the main area
  void pointedAt(const scantrove::RegionPoint& point);
  void pointerMoved();  ///< by the user; pointedAt() is also emitted with each frame
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
  /// A double click whose first click on a title moved the pictures: opens that title's picture.
  [[nodiscard]] bool openActivated();
  void showRegions();
  void showNames();
  void showHighlight();
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
  std::vector<SeenObject> objects_;  ///< in the frame shown
  std::set<ObjectId> selected_;
  std::map<RegionId, QString> names_;
  FramePointing pointing_;
  RegionId hovered_region_;
  std::vector<RegionId> selected_regions_;
  std::vector<PointMarks> marks_;
  ImagePanel* activated_panel_ = nullptr;  ///< by the last click on a title
  QElapsedTimer since_activated_;
  ImagePanel* pointed_panel_ = nullptr;  ///< under the pointer
  QPointF pointed_fraction_;
  DepthRange range_;
  bool has_range_ = false;
};

}  // namespace scantrove
