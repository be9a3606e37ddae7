#pragma once
#include <QWidget>
#include <vector>

#include "core/dataset/dataset_export.h"

class QTableWidget;

namespace scantrove {

/// A table of the images, instances and pixels of each class and split of a data set. Hidden without counts.
class ExportStatisticsView : public QWidget {
  Q_OBJECT

 public:
  explicit ExportStatisticsView(QWidget* parent = nullptr);

  void showCounts(const ExportSummary& summary);
  void clear();

 private:
  void addRows(const QString& split, const std::vector<ClassCount>& counts);

  QTableWidget* table_;
};

}  // namespace scantrove
