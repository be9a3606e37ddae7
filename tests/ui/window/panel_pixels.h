#pragma once
#include <QColor>
#include <QImage>
#include <QRect>

#include "core/collection/seen_object.h"

namespace scantrove::test {

/// Obj_3 with a box in fractions of the image.
inline SeenObject seenAt(float x, float y, float w, float h) {
  SeenObject object;
  object.object = ObjectId{3};
  object.name = "Obj_3";
  object.box = {x, y, w, h};
  return object;
}

/// The number of pixels of exactly `color` inside `rect`.
inline int countPixels(const QImage& image, const QRect& rect, const QColor& color) {
  int count = 0;
  for (int y = rect.top(); y <= rect.bottom(); ++y) {
    for (int x = rect.left(); x <= rect.right(); ++x) {
      if (image.rect().contains(x, y) && image.pixelColor(x, y) == color) ++count;
    }
  }
  return count;
}

}  // namespace scantrove::test
