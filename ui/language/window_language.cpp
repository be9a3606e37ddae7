#include "ui/language/window_language.h"

#include <QCoreApplication>
#include <QLibraryInfo>
#include <QSettings>
#include <QStringList>
#include <algorithm>
#include <array>

#include "core/base/check.h"

// Outside of the namespace, because the macro declares a global function.
static void initializeTranslations() { Q_INIT_RESOURCE(scantrove_translations); }

namespace scantrove {
namespace {

const QString kLanguageKey = QStringLiteral("language");
/// Names in the settings, in the order of LanguageChoice.
const std::array kLanguageWords{"system", "en", "de"};

QString codeOfSystem() {
  for (const QString& known : QLocale::system().uiLanguages()) {
    for (const char* code : {"de", "en"}) {
      if (known.startsWith(QLatin1String(code))) return QString::fromLatin1(code);
    }
  }
  return QStringLiteral("en");
}

QString codeOf(LanguageChoice choice) {
  return choice == LanguageChoice::system
             ? codeOfSystem()
             : QString::fromLatin1(kLanguageWords.at(static_cast<std::size_t>(choice)));
}

/// A desktop of this language keeps its country's formats.
QLocale localeOf(LanguageChoice choice) {
  const QLocale system = QLocale::system();
  const QLocale::Language language = system.language();
  switch (choice) {
    case LanguageChoice::system:
      break;
    case LanguageChoice::english:
      if (language != QLocale::English && language != QLocale::C)
        return {QLocale::English, QLocale::UnitedKingdom};
      break;
    case LanguageChoice::german:
      if (language != QLocale::German) return {QLocale::German, QLocale::Germany};
      break;
  }
  return system;
}

}  // namespace

LanguageChoice chosenLanguage() {
  const QByteArray word = QSettings().value(kLanguageKey).toString().toLatin1();
  const auto found = std::find_if(kLanguageWords.begin(), kLanguageWords.end(),
                                  [&word](const char* known) { return word == known; });
  return found == kLanguageWords.end() ? LanguageChoice::system
                                       : static_cast<LanguageChoice>(found - kLanguageWords.begin());
}

void chooseLanguage(LanguageChoice choice) {
  QSettings().setValue(kLanguageKey,
                       QString::fromLatin1(kLanguageWords.at(static_cast<std::size_t>(choice))));
}

WindowLanguage::WindowLanguage(LanguageChoice choice) : code_(codeOf(choice)) {
  initializeTranslations();
  const bool is_loaded = texts_.load(QStringLiteral(":/translations/scantrove_%1.qm").arg(code_));
  SCANTROVE_CHECK(is_loaded);
  // The texts of Qt's own dialogs belong to a package that may be missing; they are English then.
  if (texts_of_qt_.load(QStringLiteral("qtbase_") + code_,
                        QLibraryInfo::path(QLibraryInfo::TranslationsPath)))
    QCoreApplication::installTranslator(&texts_of_qt_);
  QCoreApplication::installTranslator(&texts_);
  QLocale::setDefault(localeOf(choice));
}

WindowLanguage::~WindowLanguage() {
  QCoreApplication::removeTranslator(&texts_);
  QCoreApplication::removeTranslator(&texts_of_qt_);
  QLocale::setDefault(locale_before_);
}

}  // namespace scantrove
