#pragma once
#include <QMenu>

namespace scantrove {

/// Chooses the language of the window, which a new start shows.
class LanguageMenu : public QMenu {
  Q_OBJECT

 public:
  explicit LanguageMenu(QWidget* parent);

 signals:
  void noticed(const QString& notice);  ///< when the choice takes effect
};

}  // namespace scantrove
