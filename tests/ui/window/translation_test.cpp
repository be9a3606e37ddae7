#include <gtest/gtest.h>

#include <QSettings>
#include <algorithm>

#include "core/session/param_registry.h"
#include "tests/ui/window/translation_files.h"
#include "ui/language/core_texts.h"
#include "ui/language/window_language.h"
#include "ui/models/next_steps.h"
#include "ui/models/object_list_model.h"
#include "ui/view/measure_tool.h"

namespace scantrove::test {
namespace {

/// What `pattern` finds in `text`, each once.
std::set<QString> foundIn(const QString& text, const char* pattern) {
  std::set<QString> all;
  const QRegularExpression expression(QString::fromLatin1(pattern));
  for (auto found = expression.globalMatch(text); found.hasNext();) all.insert(found.next().captured());
  return all;
}

qsizetype marksIn(const QString& text) {
  static const QRegularExpression mark(QStringLiteral("&(?=\\w)"));
  return text.count(mark);
}

bool isKeySequence(const QString& text) {
  static const QRegularExpression keys(
      QStringLiteral(R"(^((Ctrl|Shift|Alt)\+)*([A-Z0-9?.]|F\d+|PgUp|PgDown|Space)$)"));
  return keys.match(text).hasMatch();
}

class Translation : public testing::TestWithParam<const char*> {
 protected:
  const std::vector<TranslatedMessage> messages_ = readTranslation(QString::fromLatin1(GetParam()));
};

TEST_P(Translation, IsFinished) {
  ASSERT_FALSE(messages_.empty());
  for (const TranslatedMessage& message : messages_) {
    EXPECT_TRUE(message.is_finished) << message.source.toStdString();
    EXPECT_EQ(message.forms.size(), message.has_plural ? 2 : 1) << message.source.toStdString();
    for (const QString& form : message.forms)
      EXPECT_FALSE(form.trimmed().isEmpty()) << message.source.toStdString();
  }
}

TEST_P(Translation, KeepsPlaceholdersTagsAndMarks) {
  for (const TranslatedMessage& message : messages_) {
    for (const QString& form : message.forms) {
      for (const char* pattern : {"%L?[1-9n]", "</?\\w+"})
        EXPECT_EQ(foundIn(form, pattern), foundIn(message.source, pattern)) << form.toStdString();
      EXPECT_EQ(marksIn(form), marksIn(message.source)) << form.toStdString();
      EXPECT_EQ(form.count(QLatin1Char('\n')), message.source.count(QLatin1Char('\n'))) << form.toStdString();
      EXPECT_EQ(form.endsWith(QStringLiteral("…")), message.source.endsWith(QStringLiteral("…")))
          << form.toStdString();
      EXPECT_EQ(form.startsWith(QLatin1Char(' ')), message.source.startsWith(QLatin1Char(' ')))
          << form.toStdString();
    }
  }
}

// Shortcuts are read from these texts; menus show them with the desktop's names of keys.
TEST_P(Translation, KeepsShortcuts) {
  for (const TranslatedMessage& message : messages_) {
    if (message.context == QStringLiteral("scantrove::HelpDialog") || !isKeySequence(message.source))
      continue;
    EXPECT_EQ(message.forms.front(), message.source);
  }
}

INSTANTIATE_TEST_SUITE_P(Languages, Translation, testing::Values("de", "en"));

TEST(Translations, HaveAllTextsOfTheWindow) {
  std::set<QString> german, plural, english;
  for (const TranslatedMessage& message : readTranslation(QStringLiteral("de"))) {
    german.insert(message.source);
    if (message.has_plural) plural.insert(message.source);
  }
  for (const TranslatedMessage& message : readTranslation(QStringLiteral("en")))
    english.insert(message.source);
  const std::set<QString> texts = textsOfSources();
  ASSERT_GT(texts.size(), 500U) << "the reader finds the texts";
  for (const QString& text : texts) EXPECT_TRUE(german.contains(text)) << text.toStdString();
  EXPECT_EQ(english, plural) << "English translates the plural forms only";
}

// At run time the context of tr() is the class with its namespace; lupdate may miss it in free functions.
TEST(Translations, HaveTheContextsOfRunTime) {
  const std::set<QString> without_class{QStringLiteral("Core"),        QStringLiteral("FileDialog"),
                                        QStringLiteral("NextSteps"),   QStringLiteral("QObject"),
                                        QStringLiteral("RegionNames"), QStringLiteral("TypedName")};
  for (const char* code : {"de", "en"}) {
    for (const TranslatedMessage& message : readTranslation(QString::fromLatin1(code))) {
      EXPECT_TRUE(message.context.startsWith(QStringLiteral("scantrove::")) ||
                  without_class.contains(message.context))
          << message.context.toStdString() << ": " << message.source.toStdString();
    }
  }
}

TEST(WindowLanguage, GivesPluralsAndNumbers) {
  const WindowLanguage english(LanguageChoice::english);
  EXPECT_EQ(english.code(), QStringLiteral("en"));
  EXPECT_EQ(viewsInWords(1), QStringLiteral("1 view"));
  EXPECT_EQ(viewsInWords(2), QStringLiteral("2 views"));
  {
    const WindowLanguage german(LanguageChoice::german);
    EXPECT_EQ(german.code(), QStringLiteral("de"));
    EXPECT_EQ(viewsInWords(1), QStringLiteral("1 Ansicht"));
    EXPECT_EQ(viewsInWords(2), QStringLiteral("2 Ansichten"));
    EXPECT_EQ(textOf({NextStep::Kind::check, 1}), QStringLiteral("1 Schlüsselbild prüfen"));
    EXPECT_EQ(textOf({NextStep::Kind::check, 2}), QStringLiteral("2 Schlüsselbilder prüfen"));
    EXPECT_EQ(MeasureTool::lengthText(0.1234F),
              QStringLiteral("12") + QLocale(QLocale::German, QLocale().territory()).decimalPoint() +
                  QStringLiteral("3 cm"));
  }
  EXPECT_EQ(viewsInWords(2), QStringLiteral("2 views")) << "as before";
}

TEST(WindowLanguage, IsStoredBetweenRuns) {
  QSettings().clear();
  EXPECT_EQ(chosenLanguage(), LanguageChoice::system);
  for (const LanguageChoice choice :
       {LanguageChoice::german, LanguageChoice::english, LanguageChoice::system}) {
    chooseLanguage(choice);
    EXPECT_EQ(chosenLanguage(), choice);
  }
  QSettings().setValue(QStringLiteral("language"), QStringLiteral("xx"));
  EXPECT_EQ(chosenLanguage(), LanguageChoice::system) << "a name that this version does not know";
  QSettings().clear();
}

TEST(CoreTexts, HaveTheStagesOfAFrame) {
  static const QRegularExpression stage(QStringLiteral(R"re(\btimer_?(?:\(\))?\.time\("(\w+)")re"));
  const auto listed = translatedCoreTexts();
  int stages = 0;
  for (const char* folder : {"core/pipeline", "core/scan"}) {
    const QString sources = readSources(folder);
    for (auto found = stage.globalMatch(sources); found.hasNext(); ++stages) {
      const QString name = found.next().captured(1);
      EXPECT_TRUE(std::any_of(listed.begin(), listed.end(), [&name](const char* text) {
        return name == QLatin1String(text);
      })) << name.toStdString();
    }
  }
  EXPECT_GT(stages, 10) << "the reader finds the stages";
}

TEST(CoreTexts, HaveTheParametersOfTheWindow) {
  const std::set<std::string> shown{
      "labeling.joining_bias",  "discovery.min_size_m", "discovery.max_size_m", "discovery.persistent_frames",
      "detection.max_distance", "fusion.voxel_size_m",  "fusion.max_depth_m"};
  const auto list = translatedCoreTexts();
  const std::set<std::string> listed(list.begin(), list.end());
  std::size_t found = 0;
  for (const ParamInfo& info : paramRegistry()) {
    if (!shown.contains(info.key)) continue;
    ++found;
    EXPECT_TRUE(listed.contains(info.help)) << info.help;
    EXPECT_TRUE(info.unit.empty() || listed.contains(info.unit)) << info.unit;
  }
  EXPECT_EQ(found, shown.size());
}

TEST(CoreTexts, LeaveOtherTextsAsTheyAre) {
  const WindowLanguage german(LanguageChoice::german);
  EXPECT_EQ(coreText("track"), QStringLiteral("Verfolgen"));
  EXPECT_EQ(coreText("/home/a/x.png is no PNG file."), QStringLiteral("/home/a/x.png is no PNG file."));
}

}  // namespace
}  // namespace scantrove::test
