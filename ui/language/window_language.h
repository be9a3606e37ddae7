#pragma once
#include <QLocale>
#include <QString>
#include <QTranslator>

namespace scantrove {

/// `system`: the desktop's language if the window has it, else English.
enum class LanguageChoice { system, english, german };

/// The choice for the next start; stored between runs.
[[nodiscard]] LanguageChoice chosenLanguage();
void chooseLanguage(LanguageChoice choice);

/// Shows the window's texts, numbers and dates in one language while it lives. Files and commands do not
/// change. Widgets keep the language that they were created with.
class WindowLanguage {
 public:
  /// The application exists already.
  explicit WindowLanguage(LanguageChoice choice);
  ~WindowLanguage();
  WindowLanguage(const WindowLanguage&) = delete;
  WindowLanguage& operator=(const WindowLanguage&) = delete;

  /// "de" or "en".
  [[nodiscard]] const QString& code() const { return code_; }

 private:
  QString code_;
  QTranslator texts_, texts_of_qt_;
  QLocale locale_before_;
};

}  // namespace scantrove
