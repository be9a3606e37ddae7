#pragma once
#include <opencv2/core/mat.hpp>
#include <opencv2/core/types.hpp>
#include <span>
#include <vector>

namespace scantrove {

/// Tools that paint a mask: CV_8UC1, 255 = painted, 0 = not. Pixel centres lie at integer coordinates. Each
/// returns the box of the pixels that it may have changed, empty if none; only that box costs time. Points
/// that are not finite are left out. Any thread.
enum class PaintMode { add, erase };

/// A brush stroke: the pixels whose centres lie within `radius_px` of the line through `points` (one point: a
/// dot), without blended edges.
cv::Rect paintStroke(cv::Mat& mask, std::span<const cv::Point2f> points, float radius_px, PaintMode mode);

/// The pixels whose centres lie inside the closed outlines by the even-odd rule: an outline within another
/// one is a hole.
cv::Rect paintPolygon(cv::Mat& mask, std::span<const std::vector<cv::Point2f>> outlines, PaintMode mode);

/// Paints the hole around `point`: unpainted pixels connected to it by their sides, if painted ones enclose
/// all of them. Empty: `point` is painted or lies in no hole.
cv::Rect fillHole(cv::Mat& mask, const cv::Point& point);

}  // namespace scantrove
