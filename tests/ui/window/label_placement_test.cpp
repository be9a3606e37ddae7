#include "ui/panels/label_placement.h"

#include <gtest/gtest.h>

#include <cmath>

namespace scantrove {
namespace {

const QRectF kPicture(10, 20, 400, 300);
const QSizeF kLabel(60, 18);

void expectSeparateAndInside(const std::vector<QRectF>& labels, const QRectF& bounds) {
  for (std::size_t i = 0; i < labels.size(); ++i) {
    EXPECT_TRUE(bounds.contains(labels[i])) << i;
    for (std::size_t j = 0; j < i; ++j) EXPECT_FALSE(labels[i].intersects(labels[j])) << i << " on " << j;
  }
}

TEST(LabelPlacement, LabelIsAboveItsBox_AlignedLeft) {
  const std::vector<QRectF> labels = placeLabels({{QRectF(100, 100, 80, 60), kLabel}}, kPicture);
  ASSERT_EQ(labels.size(), 1U);
  EXPECT_EQ(labels[0], QRectF(QPointF(100, 80), kLabel));
}

TEST(LabelPlacement, LabelIsInsideItsBox_AtTheTopEdge) {
  const std::vector<QRectF> labels = placeLabels({{QRectF(100, 22, 80, 60), kLabel}}, kPicture);
  EXPECT_EQ(labels[0], QRectF(QPointF(100, 24), kLabel));
}

TEST(LabelPlacement, LabelStaysInThePicture_AtTheSides) {
  const std::vector<QRectF> labels =
      placeLabels({{QRectF(395, 100, 15, 60), kLabel}, {QRectF(0, 200, 30, 60), kLabel}}, kPicture);
  EXPECT_EQ(labels[0].right(), kPicture.right());
  EXPECT_EQ(labels[1].left(), kPicture.left());
}

TEST(LabelPlacement, LabelsOfCloseBoxesDoNotOverlap) {
  std::vector<LabelRequest> requests;
  for (int i = 0; i < 6; ++i) {
    const QRectF box(100.0 + 9 * i, 120.0 + 4 * i, 90, 50);
    requests.push_back({box, QSizeF(50.0 + 10 * i, 18)});
  }
  const std::vector<QRectF> labels = placeLabels(requests, kPicture);
  expectSeparateAndInside(labels, kPicture);
  // The first label has its preferred position, and the result is reproducible.
  EXPECT_EQ(labels[0].bottomLeft(), requests[0].box.topLeft() + QPointF(0, -2));
  EXPECT_EQ(placeLabels(requests, kPicture), labels);
}

TEST(LabelPlacement, LabelsOfTheSameBoxDoNotOverlap) {
  const std::vector<QRectF> labels =
      placeLabels(std::vector<LabelRequest>(5, {QRectF(150, 100, 60, 40), kLabel}), kPicture);
  expectSeparateAndInside(labels, kPicture);
}

TEST(LabelPlacement, LabelHasNoPlace_WithoutRoomNearItsBox) {
  const std::vector<QRectF> labels =
      placeLabels(std::vector<LabelRequest>(30, {QRectF(150, 100, 60, 40), kLabel}), kPicture);
  ASSERT_EQ(labels.size(), 30U);
  std::vector<QRectF> placed;
  for (const QRectF& label : labels) {
    if (!label.isNull()) placed.push_back(label);
  }
  EXPECT_GE(placed.size(), 5U);
  EXPECT_LT(placed.size(), 30U);
  expectSeparateAndInside(placed, kPicture);
  for (const QRectF& label : placed)
    EXPECT_LE(std::abs(label.center().y() - 120), 20 + 4 * 18) << "near its box";
  EXPECT_TRUE(labels.back().isNull());
}

}  // namespace
}  // namespace scantrove
