#pragma once
#include <QWidget>
#include <set>
#include <vector>

#include "core/scan/scan_snapshot.h"
#include "ui/panels/image_conversion.h"

namespace scantrove {

class ColorPanel;
class DepthPanel;
class ImagePanel;

/// The five pictures of the current frame: one large, the others in a grid below it. A click makes another
/// one large.
class FramePanels : public QWidget {
  Q_OBJECT

 public:
  explicit FramePanels(QWidget* parent = nullptr);

  void showSnapshot(const ScanSnapshot& snapshot);
  void clear();
  /// Lights up these objects in the colour image, and their regions among the others.
  void setSelected(const std::set<ObjectId>& selected);
  void feature(ImagePanel* panel);
  [[nodiscard]] ImagePanel* featured() const { return panels_[featured_]; }
  [[nodiscard]] const std::vector<ImagePanel*>& panels() const { return panels_; }
  [[nodiscard]] ColorPanel* colorPanel() const { return color_; }

  [[nodiscard]] QSize sizeHint() const override { return {420, 660}; }
  [[nodiscard]] QSize minimumSizeHint() const override { return {230, 340}; }

 protected:
  void resizeEvent(QResizeEvent* event) override;

 private:
  void arrange();
  void showRegions();

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
  DepthRange range_;
  bool has_range_ = false;
};

}  // namespace scantrove
