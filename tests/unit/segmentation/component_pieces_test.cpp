#include "core/segmentation/component_pieces.h"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/core.hpp>

namespace scantrove {
namespace {

constexpr int kPiecesWidth = 60, kPiecesHeight = 40, kPiecesBorder = 30;
constexpr double kMinPiece_px = 50;
const cv::Rect kLeftPiece(0, 0, kPiecesBorder, kPiecesHeight),
    kRightPiece(kPiecesBorder, 0, kPiecesWidth - kPiecesBorder, kPiecesHeight);

/// A component of two boxes, the segments 1 and 2, that meet in the middle column.
class TwoBoxes {
 public:
  TwoBoxes() {
    const cv::Size size(kPiecesWidth, kPiecesHeight);
    component = {cv::Mat1b(size, 255), cv::Mat1f(size, 1.0F), cv::Mat1f(size, 0.05F), cv::Mat1i(size, 1),
                 cv::Mat3f(size, cv::Vec3f(60, 5, 10))};
    component.segment(kRightPiece).setTo(2);
  }

  /// The surface recedes towards the border from both sides.
  TwoBoxes& fold() {
    constexpr float kSlope = 0.003F;  // metres a pixel
    for (int v = 0; v < kPiecesHeight; ++v) {
      for (int u = 0; u < kPiecesWidth; ++u)
        component.z_m(v, u) = 1 - kSlope * std::abs(static_cast<float>(u) + 0.5F - kPiecesBorder);
    }
    return *this;
  }
  TwoBoxes& paintRight() {
    component.lab(kRightPiece).setTo(cv::Scalar(60, -30, 40));
    return *this;
  }
  /// Cuts the upper half off the right box: both have a dent in their outline.
  TwoBoxes& shortenRight() {
    component.mask(cv::Rect(kPiecesBorder, 0, kPiecesWidth - kPiecesBorder, kPiecesHeight / 2)).setTo(0);
    return *this;
  }
  TwoBoxes& removeDepth(const cv::Rect& where) {
    component.z_m(where).setTo(0);
    component.height_m(where).setTo(0);
    component.segment(where).setTo(0);
    return *this;
  }
  [[nodiscard]] ComponentPieces divide() const { return divideComponent(component, kMinPiece_px, {}); }

  SupportedComponent component;
};

void expectTwoPieces(const ComponentPieces& pieces) {
  EXPECT_EQ(pieces.count, 2);
  EXPECT_EQ(cv::countNonZero(pieces.piece(kLeftPiece) != 1), 0);
  EXPECT_EQ(cv::countNonZero(pieces.piece(kRightPiece) != 2), 0);
}
void expectOnePiece(const ComponentPieces& pieces) {
  EXPECT_EQ(pieces.count, 1);
  EXPECT_EQ(cv::countNonZero(pieces.piece != 1), 0);
}

TEST(DivideComponent, BoxesAreTwoPieces_WhenTheyMeetInAFoldAndDifferInColor) {
  expectTwoPieces(TwoBoxes().fold().paintRight().divide());
}

TEST(DivideComponent, BoxesAreOnePiece_WhenTheirSurfaceContinues) {
  expectOnePiece(TwoBoxes().divide());
  expectOnePiece(TwoBoxes().paintRight().divide());
}

TEST(DivideComponent, BoxesAreOnePiece_WhenOnlyAFoldDividesThem) {
  expectOnePiece(TwoBoxes().fold().divide());
}

TEST(DivideComponent, FoldDividesBoxes_WithoutColor) {
  TwoBoxes boxes;
  boxes.fold().component.lab.release();
  expectTwoPieces(boxes.divide());
}

TEST(DivideComponent, DepthStepDividesBoxes_WhenTheirOutlineHasADent) {
  TwoBoxes boxes;
  boxes.paintRight().shortenRight();
  boxes.component.z_m(kRightPiece).setTo(1.1);
  const ComponentPieces pieces = boxes.divide();
  EXPECT_EQ(pieces.count, 2);
  EXPECT_EQ(pieces.piece(30, 10), 1);
  EXPECT_EQ(pieces.piece(30, 50), 2);
  EXPECT_EQ(pieces.piece(10, 50), 0) << "outside the component";
}

// Books of a row: each is as high as the next, and the row is as convex as one box.
TEST(DivideComponent, BoxesInARowAreTwoPieces_WhenTheirColorsAreFarApart) {
  TwoBoxes row;
  constexpr float kGroove = 0.0005F;  // metres a pixel: noise hides the fold
  for (int v = 0; v < kPiecesHeight; ++v) {
    for (int u = 0; u < kPiecesWidth; ++u)
      row.component.z_m(v, u) = 1 - kGroove * std::abs(static_cast<float>(u) + 0.5F - kPiecesBorder);
  }
  expectTwoPieces(row.paintRight().divide());
  row.component.lab(kRightPiece).setTo(cv::Scalar(60, 12, 18));  // in other light
  expectOnePiece(row.divide());
}

/// A raised left part; the right part lies flat on the support, a part of the support's segment 3.
TwoBoxes boxAndSheet() {
  TwoBoxes boxes;
  boxes.component.height_m(kRightPiece).setTo(0.002);
  boxes.component.segment(kRightPiece).setTo(3);
  return boxes;
}

TEST(DivideComponent, SheetThatTouchesABoxIsAPieceOfItsOwn) {
  expectTwoPieces(boxAndSheet().paintRight().divide());
}

TEST(DivideComponent, FlatPartIsOfALowThing_WhenItHasItsColor) {
  TwoBoxes spoon = boxAndSheet();
  spoon.component.height_m(kLeftPiece).setTo(0.02);
  expectOnePiece(spoon.divide());
}

TEST(DivideComponent, FlatPartIsOfNoTallThing_WhateverItsColor) {
  TwoBoxes vase = boxAndSheet();
  vase.component.height_m(kLeftPiece).setTo(0.1);
  expectTwoPieces(vase.divide());
}

TEST(DivideComponent, FlatPartIsOfWhatEnclosesIt) {
  // The rim of a plate around its inside.
  TwoBoxes plate;
  plate.component.segment.setTo(1);
  const cv::Rect inside(10, 10, kPiecesWidth - 20, kPiecesHeight - 20);
  plate.component.height_m(inside).setTo(0.002);
  plate.component.segment(inside).setTo(3);
  plate.component.lab(inside).setTo(cv::Scalar(60, -30, 40));
  expectOnePiece(plate.divide());
}

TEST(DivideComponent, PixelsWithoutDepthTakeTheNearestPieceAndItsHeight) {
  TwoBoxes boxes;
  boxes.paintRight().component.height_m(kRightPiece).setTo(0.1);
  boxes.removeDepth({kPiecesBorder - 4, 0, 8, kPiecesHeight});
  const ComponentPieces pieces = boxes.divide();
  expectTwoPieces(pieces);
  for (const int u : {10, 26, 28}) EXPECT_FLOAT_EQ(pieces.height_m(20, u), 0.05F) << u;
  for (const int u : {31, 33, 50}) EXPECT_FLOAT_EQ(pieces.height_m(20, u), 0.1F) << u;
}

TEST(DivideComponent, SmallSegmentIsOfThePieceAroundIt) {
  TwoBoxes boxes;
  boxes.fold().paintRight().component.segment(cv::Rect(10, 10, 5, 5)).setTo(3);
  expectTwoPieces(boxes.divide());
}

TEST(DivideComponent, ComponentIsOnePiece_WhenNoSegmentIsRaised) {
  TwoBoxes boxes;
  boxes.fold().paintRight().component.height_m.setTo(0.001);
  expectOnePiece(boxes.divide());
}

TEST(DivideComponent, ComponentIsOnePieceOnTheSupport_WhenNothingIsMeasured) {
  const ComponentPieces pieces = TwoBoxes().removeDepth({0, 0, kPiecesWidth, kPiecesHeight}).divide();
  expectOnePiece(pieces);
  EXPECT_EQ(cv::countNonZero(pieces.height_m), 0);
}

}  // namespace
}  // namespace scantrove
