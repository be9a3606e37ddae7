#include "ui/panels/color_panel.h"

#include <QPainter>
#include <algorithm>
#include <tuple>
#include <utility>

#include "ui/panels/label_placement.h"

namespace scantrove {
namespace {

const QColor kFound(255, 255, 255);
const QColor kRecognized(0, 255, 255);
const QColor kSelected(255, 208, 0);
constexpr double kGhostOpacity = 0.55;

void paintCandidate(QPainter& painter, const QRectF& place) {
  // Aligned to pixels; otherwise antialiasing makes the thin line grey.
  const QRectF box = QRectF(place.toAlignedRect()).translated(0.5, 0.5);
  painter.setBrush(Qt::NoBrush);
  painter.setPen(QPen(QColor(0, 0, 0, 110), 2.4));
  painter.drawRect(box);
  painter.setPen(QPen(kFound, 1.0, Qt::DashLine));
  painter.drawRect(box);
}

void paintBox(QPainter& painter, const QRectF& box, bool selected) {
  QColor glow = kSelected;
  glow.setAlpha(46);
  painter.setBrush(selected ? QBrush(glow) : QBrush(Qt::NoBrush));
  painter.setPen(QPen(QColor(0, 0, 0, 110), selected ? 5.0 : 3.6));
  painter.drawRect(box);
  painter.setBrush(Qt::NoBrush);
  painter.setPen(QPen(selected ? kSelected : kFound, selected ? 3.0 : 1.8));
  painter.drawRect(box);
}

}  // namespace

ColorPanel::ColorPanel(QWidget* parent)
    : ImagePanel(tr("Colour and objects"),
                 tr("The colour image. White rectangles: discovered objects. Cyan names: recognised objects. "
                    "White names: new objects. Yellow: selected in the object list. Dashed: candidates; O "
                    "marks one as object."),
                 parent) {}

void ColorPanel::setFrame(const QImage& picture, const std::vector<SeenObject>& objects) {
  objects_ = objects;
  sortObjects();
  setPicture(picture);
}

void ColorPanel::setRegionNames(std::vector<RegionLabelInImage> names) {
  if (names.empty() && region_names_.empty()) return;
  region_names_ = std::move(names);
  update();
}

void ColorPanel::setGhost(const QImage& ghost) {
  ghost_ = ghost;
  update();
}

void ColorPanel::setSelected(const std::set<ObjectId>& selected) {
  selected_ = selected;
  sortObjects();
  update();
}

void ColorPanel::sortObjects() {
  // Labels are placed in this order. It is the same in every frame, so that labels do not jump.
  const auto rank = [this](const SeenObject& object) {
    return std::tuple(!isSelected(object), !object.object, object.object, object.regions);
  };
  std::stable_sort(objects_.begin(), objects_.end(),
                   [&rank](const SeenObject& a, const SeenObject& b) { return rank(a) < rank(b); });
}

QRectF ColorPanel::objectRect(const SeenObject& object) const {
  const QRectF frame = pictureRect();
  const cv::Rect2f& box = object.box;
  return {frame.left() + static_cast<double>(box.x) * frame.width(),
          frame.top() + static_cast<double>(box.y) * frame.height(),
          static_cast<double>(box.width) * frame.width(), static_cast<double>(box.height) * frame.height()};
}

QString ColorPanel::nameOf(const SeenObject& object) const {
  const QString now = name_of_ ? name_of_(object.object) : QString();
  return now.isEmpty() ? QString::fromStdString(object.name) : now;
}

bool ColorPanel::isSelected(const SeenObject& object) const { return selected_.contains(object.object); }

bool ColorPanel::isRecognized(const SeenObject& object) const {
  return object.recognized || (is_recognized_ && is_recognized_(object.object));
}

void ColorPanel::paintGhost(QPainter& painter, const QRectF& rect) const {
  painter.save();
  painter.setOpacity(kGhostOpacity);
  painter.drawImage(rect, ghost_);
  painter.setOpacity(1);
  painter.setBrush(Qt::NoBrush);
  painter.setPen(QPen(kSelected, 2.0, Qt::DashLine));
  painter.drawRect(rect.adjusted(1, 1, -1, -1));
  const QString text = painter.fontMetrics().elidedText(
      tr("Camera lost. Point it at this view, or at any place that it has seen"), Qt::ElideRight,
      static_cast<int>(rect.width()) - 24);
  const QSizeF chip = chipSize(painter, text);
  paintChip(painter, {rect.center().x() - chip.width() / 2, rect.top() + 8}, text, kSelected);
  painter.restore();
}

void ColorPanel::paintOverlay(QPainter& painter, const QRectF& rect) {
  if (!ghost_.isNull()) paintGhost(painter, rect);
  QFont font = painter.font();
  font.setPointSizeF(font.pointSizeF() * (rect.width() > 300 ? 0.92 : 0.78));
  font.setBold(true);
  painter.setFont(font);
  std::vector<const SeenObject*> boxed, named;
  std::vector<QString> names;
  std::vector<LabelRequest> requests;
  for (const SeenObject& object : objects_) {
    const QString name = nameOf(object);
    if (!object.object || name.isEmpty()) continue;  // a candidate, or a deleted object
    boxed.push_back(&object);
    // Each region of an object has a box; the largest one has the label.
    const auto earlier = std::ranges::find(named, object.object, &SeenObject::object);
    if (earlier != named.end()) {
      if (object.box.area() <= (*earlier)->box.area()) continue;
      requests[static_cast<std::size_t>(earlier - named.begin())].box = objectRect(object);
      *earlier = &object;
      continue;
    }
    named.push_back(&object);
    names.push_back(QFontMetricsF(font).elidedText(name, Qt::ElideRight, rect.width() / 2));
    requests.push_back({objectRect(object), chipSize(painter, names.back())});
  }
  for (const RegionLabelInImage& region : region_names_) {
    names.push_back(QFontMetricsF(font).elidedText(region.name, Qt::ElideRight, rect.width() / 2));
    const QSizeF size = chipSize(painter, names.back());
    const QPointF at = positionOf(region.fraction);
    // The place above this box is preferred: the name is centred on its region.
    requests.push_back({{at.x() - size.width() / 2, at.y() + size.height() / 2, size.width(), 1}, size});
  }
  for (const SeenObject& object : objects_) {
    if (!object.object) paintCandidate(painter, objectRect(object));
  }
  // In reverse order, so that selected boxes are on top.
  for (auto object = boxed.rbegin(); object != boxed.rend(); ++object)
    paintBox(painter, objectRect(**object), isSelected(**object));
  // The bottom line is reserved for the title.
  const std::vector<QRectF> places =
      placeLabels(requests, rect.adjusted(0, 0, 0, -chipSize(painter, title()).height() - 8));
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (places[i].isNull()) continue;
    if (i >= named.size()) {
      paintChip(painter, places[i].topLeft(), names[i], kFound);
      continue;
    }
    const SeenObject& object = *named[i];
    const QColor color = isSelected(object) ? kSelected : (isRecognized(object) ? kRecognized : kFound);
    paintChip(painter, places[i].topLeft(), names[i], color);
  }
}

}  // namespace scantrove
