#pragma once
#include <QImage>
#include <QWidget>
#include <vector>

#include "core/base/ids.h"

class QLabel;
class QVBoxLayout;

namespace scantrove {

/// Objects that may be the same thing as that of the page, each with two answers.
class AlikeList : public QWidget {
  Q_OBJECT

 public:
  struct Entry {
    ObjectId object;
    QString name;
    QImage picture;
    bool is_very_alike = false;
  };

  explicit AlikeList(QWidget* parent = nullptr);

  void setEntries(const std::vector<Entry>& entries);
  /// Says that they are being looked for.
  void setSearching();

 signals:
  void same(scantrove::ObjectId object);
  void different(scantrove::ObjectId object);
  void shown(scantrove::ObjectId object);  ///< its own page is wanted

 private:
  [[nodiscard]] QWidget* makeRow(const Entry& entry);
  void clear();

  QVBoxLayout* rows_;
  QLabel* note_;
};

}  // namespace scantrove
