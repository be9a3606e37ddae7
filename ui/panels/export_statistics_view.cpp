#include "ui/panels/export_statistics_view.h"

#include <QHeaderView>
#include <QLocale>
#include <QTableWidget>
#include <QVBoxLayout>

namespace scantrove {
namespace {

constexpr int kCountRows = 8;

QTableWidgetItem* countCell(qulonglong count) {
  auto* cell = new QTableWidgetItem(QLocale().toString(count));
  cell->setTextAlignment(Qt::AlignRight | Qt::AlignVCenter);
  return cell;
}

}  // namespace

ExportStatisticsView::ExportStatisticsView(QWidget* parent) : QWidget(parent), table_(new QTableWidget) {
  table_->setColumnCount(5);
  table_->setHorizontalHeaderLabels({tr("Split"), tr("Class"), tr("Images"), tr("Instances"), tr("Pixels")});
  table_->setEditTriggers(QAbstractItemView::NoEditTriggers);
  table_->verticalHeader()->setVisible(false);
  table_->horizontalHeader()->setSectionResizeMode(QHeaderView::ResizeToContents);
  table_->setAccessibleName(tr("Counts of classes"));
  table_->setMinimumHeight(kCountRows * fontMetrics().lineSpacing());
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 0, 0, 0);
  column->addWidget(table_);
  setVisible(false);
}

void ExportStatisticsView::showCounts(const ExportSummary& summary) {
  clear();
  for (const SplitCount& split : summary.splits)
    addRows(QString::fromStdString(splitName(split.split)), split.classes);
  addRows(tr("all"), summary.classes);
  setVisible(table_->rowCount() > 0);
}

void ExportStatisticsView::clear() {
  table_->setRowCount(0);
  setVisible(false);
}

void ExportStatisticsView::addRows(const QString& split, const std::vector<ClassCount>& counts) {
  for (const ClassCount& count : counts) {
    const int row = table_->rowCount();
    table_->insertRow(row);
    table_->setItem(row, 0, new QTableWidgetItem(split));
    table_->setItem(row, 1, new QTableWidgetItem(QString::fromStdString(count.name)));
    table_->setItem(row, 2, countCell(static_cast<qulonglong>(count.images)));
    table_->setItem(row, 3, countCell(static_cast<qulonglong>(count.instances)));
    table_->setItem(row, 4, countCell(count.pixels));
  }
}

}  // namespace scantrove
