#pragma once
#include <QString>
#include <QWidget>
#include <vector>

class QLabel;
class QVBoxLayout;

namespace scantrove {

/// Scans as lines that open one.
class ScanLinks : public QWidget {
  Q_OBJECT

 public:
  struct Entry {
    QString folder, title, details;
    bool is_open = false;  ///< shown in the window already
  };

  explicit ScanLinks(QWidget* parent = nullptr);

  void setEntries(const std::vector<Entry>& entries);

 signals:
  void requested(const QString& folder);

 private:
  QVBoxLayout* rows_;
  QLabel* note_;
};

}  // namespace scantrove
