#include "ui/panels/export_scans_panel.h"

#include <QHBoxLayout>
#include <QLabel>
#include <QListWidget>
#include <QRadioButton>
#include <QSpinBox>
#include <QVBoxLayout>
#include <cstddef>
#include <cstdint>

namespace scantrove {
namespace {

constexpr int kScanRows = 5, kMaxShare_pct = 100, kMaxSeed = 9999;

}  // namespace

ExportScansPanel::ExportScansPanel(QWidget* parent)
    : QWidget(parent),
      this_scan_(new QRadioButton(tr("&This scan"))),
      project_(new QRadioButton(tr("Scans of the &project"))),
      list_(new QListWidget),
      split_row_(new QWidget),
      shares_{new QSpinBox, new QSpinBox},
      seed_(new QSpinBox),
      training_(new QLabel) {
  this_scan_->setChecked(true);
  list_->setAccessibleName(tr("Scans"));
  list_->setMaximumHeight(kScanRows * fontMetrics().lineSpacing() + 2 * list_->frameWidth());
  auto* split = new QHBoxLayout(split_row_);
  split->setContentsMargins(0, 0, 0, 0);
  split->addWidget(training_);
  const QStringList names{tr("validation"), tr("test")};
  for (std::size_t i = 0; i < shares_.size(); ++i) {
    const QString& name = names.at(static_cast<int>(i));
    shares_.at(i)->setRange(0, kMaxShare_pct);
    shares_.at(i)->setSuffix(tr(" % %1").arg(name));
    shares_.at(i)->setAccessibleName(name);
    shares_.at(i)->setToolTip(tr("Share of the scans. The frames of a scan are never divided."));
    split->addWidget(shares_.at(i));
    connect(shares_.at(i), &QSpinBox::valueChanged, this, [this] {
      showShares();
      emit changed();
    });
  }
  seed_->setRange(0, kMaxSeed);
  seed_->setPrefix(tr("draw "));
  seed_->setAccessibleName(tr("Draw"));
  seed_->setToolTip(tr("Another number draws other scans; the same number the same ones"));
  split->addWidget(seed_);
  split->addStretch(1);
  auto* choice = new QHBoxLayout;
  choice->addWidget(this_scan_);
  choice->addWidget(project_);
  choice->addStretch(1);
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 0, 0, 0);
  column->addLayout(choice);
  column->addWidget(list_);
  column->addWidget(split_row_);
  connect(project_, &QRadioButton::toggled, this, [this] {
    showShares();
    emit changed();
  });
  connect(list_, &QListWidget::itemChanged, this, &ExportScansPanel::changed);
  showShares();
  setVisible(false);
}

void ExportScansPanel::setScans(const QStringList& names) {
  list_->clear();
  for (const QString& name : names) {
    auto* item = new QListWidgetItem(name, list_);
    item->setFlags(Qt::ItemIsUserCheckable | Qt::ItemIsEnabled | Qt::ItemIsSelectable);
    item->setCheckState(Qt::Checked);
  }
  setVisible(names.size() > 1);
}

bool ExportScansPanel::isProject() const { return project_->isChecked(); }

std::vector<std::string> ExportScansPanel::scans() const {
  std::vector<std::string> names;
  for (int row = 0; row < list_->count(); ++row) {
    const QListWidgetItem* item = list_->item(row);
    if (item->checkState() == Qt::Checked) names.push_back(item->text().toStdString());
  }
  return names;
}

ScanSplit ExportScansPanel::split() const {
  const int val = shares_[0]->value(), test = shares_[1]->value();
  if (val + test == 0) return {};
  constexpr double kPerCent = 0.01;
  ScanSplit split;
  split.shares = SplitShares{kPerCent * (kMaxShare_pct - val - test), kPerCent * val, kPerCent * test};
  split.seed = static_cast<std::uint64_t>(seed_->value());
  return split;
}

QString ExportScansPanel::problem() const {
  if (!isProject()) return {};
  if (scans().empty()) return tr("Tick the scans to export.");
  const bool is_too_much = shares_[0]->value() + shares_[1]->value() > kMaxShare_pct;
  return is_too_much ? tr("Validation and test are more than all scans.") : QString();
}

void ExportScansPanel::showShares() {
  list_->setVisible(isProject());
  split_row_->setVisible(isProject());
  const int rest = kMaxShare_pct - shares_[0]->value() - shares_[1]->value();
  training_->setText(tr("%1 % training").arg(rest));
}

}  // namespace scantrove
