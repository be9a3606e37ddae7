#pragma once
#include <gtest/gtest.h>

#include <QTemporaryDir>
#include <opencv2/core.hpp>

#include "core/catalogue/object_database.h"

namespace scantrove::test {

/// A view whose object is a disc of `bgr` on grey.
inline ObjectView discView(const cv::Scalar& bgr) {
  ObjectView view;
  view.color = cv::Mat(60, 80, CV_8UC3, cv::Scalar(128, 128, 128));
  view.mask = cv::Mat::zeros(60, 80, CV_8UC1);
  view.depth_mm = cv::Mat::ones(60, 80, CV_16UC1) * 900;
  for (int y = 0; y < 60; ++y) {
    for (int x = 0; x < 80; ++x) {
      if ((x - 40) * (x - 40) + (y - 30) * (y - 30) > 25 * 25) continue;
      view.color.at<cv::Vec3b>(y, x) =
          cv::Vec3b(static_cast<std::uint8_t>(bgr[0]), static_cast<std::uint8_t>(bgr[1]),
                    static_cast<std::uint8_t>(bgr[2]));
      view.mask.at<std::uint8_t>(y, x) = 255;
    }
  }
  return view;
}

/// A fresh catalogue file with three objects, Obj_1 .. Obj_3.
class CatalogueTest : public testing::Test {
 protected:
  void SetUp() override {
    file_ = folder_.filePath(QStringLiteral("catalogue.sqlite"));
    auto database = ObjectDatabase::open(file_.toStdString());
    ASSERT_TRUE(database) << database.error().message();
    const auto session = (*database)->sessions().begin("test");
    ASSERT_TRUE(session);
    for (const cv::Scalar& color : {cv::Scalar(0, 0, 255), cv::Scalar(0, 255, 0), cv::Scalar(255, 0, 0)}) {
      ObjectView view = discView(color);
      view.session = *session;
      view.size_m = {0.12F, 0.09F, 0.08F};
      const auto added = (*database)->addObject(view);
      ASSERT_TRUE(added) << added.error().message();
      objects_.push_back(added->id);
    }
  }

  /// The record that another program would read from the file.
  [[nodiscard]] ObjectRecord stored(ObjectId object) const {
    auto database = ObjectDatabase::open(file_.toStdString());
    if (!database) return {};
    const auto record = (*database)->object(object);
    return record ? *record : ObjectRecord{};
  }

  [[nodiscard]] std::size_t storedCount() const {
    auto database = ObjectDatabase::open(file_.toStdString());
    if (!database) return 0;
    const auto records = (*database)->objects();
    return records ? records->size() : 0;
  }

  QTemporaryDir folder_;
  QString file_;
  std::vector<ObjectId> objects_;
};

}  // namespace scantrove::test
