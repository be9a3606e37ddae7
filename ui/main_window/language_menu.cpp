#include "ui/main_window/language_menu.h"

#include <QActionGroup>

#include "ui/language/window_language.h"

namespace scantrove {

LanguageMenu::LanguageMenu(QWidget* parent) : QMenu(tr("&Language"), parent) {
  setObjectName(QStringLiteral("languageMenu"));
  auto* group = new QActionGroup(this);
  const auto add = [this, group](LanguageChoice choice, const QString& name, const QString& help) {
    QAction* const action = addAction(name);
    action->setToolTip(help);
    action->setCheckable(true);
    action->setChecked(chosenLanguage() == choice);
    group->addAction(action);
    connect(action, &QAction::triggered, this, [this, choice] {
      chooseLanguage(choice);
      emit noticed(tr("The window has the chosen language when Scantrove is started again."));
    });
  };
  add(LanguageChoice::system, tr("&System"), tr("Follow the desktop, else English"));
  // A language has its own name, so that everybody finds it.
  add(LanguageChoice::english, QStringLiteral("&English"), QStringLiteral("English"));
  add(LanguageChoice::german, QStringLiteral("&Deutsch"), QStringLiteral("Deutsch"));
}

}  // namespace scantrove
