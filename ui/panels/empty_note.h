#pragma once
#include <QString>
#include <QWidget>

namespace scantrove {

/// Shown in an empty panel: an icon, what is missing, and how to get it.
class EmptyNote : public QWidget {
  Q_OBJECT

 public:
  EmptyNote(const QString& icon_name, const QString& title, const QString& text, QWidget* parent = nullptr);

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  QString icon_name_;
  QString title_;
  QString text_;
};

}  // namespace scantrove
