#pragma once
#include <QString>
#include <QWidget>

namespace scantrove {

/// What a panel shows while it has nothing to show: a picture, what is missing, and how it comes.
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
