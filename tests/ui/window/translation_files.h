#pragma once
#include <gtest/gtest.h>

#include <QDirIterator>
#include <QFile>
#include <QRegularExpression>
#include <QString>
#include <QStringList>
#include <QXmlStreamReader>
#include <set>
#include <vector>

#include "tests/support/source_tree.h"

namespace scantrove::test {

/// A message of a file of Qt Linguist.
struct TranslatedMessage {
  QString context, source;
  QStringList forms;  ///< one; with plural, one for each number
  bool has_plural = false;
  bool is_finished = true;
};

inline QString inSourceTree(const char* path) {
  return QString::fromStdString((sourceTree() / path).string());
}

/// The messages of resources/translations/scantrove_`code`.ts.
inline std::vector<TranslatedMessage> readTranslation(const QString& code) {
  QFile file(inSourceTree("resources/translations/scantrove_") + code + QStringLiteral(".ts"));
  EXPECT_TRUE(file.open(QIODevice::ReadOnly)) << file.fileName().toStdString();
  QXmlStreamReader xml(&file);
  std::vector<TranslatedMessage> messages;
  TranslatedMessage message;
  while (!xml.atEnd()) {
    const QXmlStreamReader::TokenType token = xml.readNext();
    if (token == QXmlStreamReader::EndElement && xml.name() == QLatin1String("message"))
      messages.push_back(message);
    if (token != QXmlStreamReader::StartElement) continue;
    if (xml.name() == QLatin1String("name")) {
      message.context = xml.readElementText();
    } else if (xml.name() == QLatin1String("message")) {
      message = {message.context, {}, {}, xml.attributes().hasAttribute(QLatin1String("numerus")), true};
    } else if (xml.name() == QLatin1String("source")) {
      message.source = xml.readElementText();
    } else if (xml.name() == QLatin1String("translation")) {
      message.is_finished = !xml.attributes().hasAttribute(QLatin1String("type"));
      if (!message.has_plural) message.forms << xml.readElementText();
    } else if (xml.name() == QLatin1String("numerusform")) {
      message.forms << xml.readElementText();
    }
  }
  EXPECT_FALSE(xml.hasError()) << xml.errorString().toStdString();
  return messages;
}

/// All sources below `folder` of the source tree, in one text.
inline QString readSources(const char* folder) {
  QString text;
  QDirIterator files(inSourceTree(folder), {QStringLiteral("*.cpp"), QStringLiteral("*.h")}, QDir::Files,
                     QDirIterator::Subdirectories);
  while (files.hasNext()) {
    QFile file(files.next());
    EXPECT_TRUE(file.open(QIODevice::ReadOnly)) << file.fileName().toStdString();
    text += QString::fromUtf8(file.readAll()) + QLatin1Char('\n');
  }
  return text;
}

/// The literals that stand one after another in `code`, as one text.
inline QString joinedLiterals(const QString& code) {
  static const QRegularExpression literal(QStringLiteral(R"re("((?:[^"\\]|\\.)*)")re"));
  QString text;
  for (auto found = literal.globalMatch(code); found.hasNext();) text += found.next().captured(1);
  return text.replace(QStringLiteral("\\n"), QStringLiteral("\n"))
      .replace(QStringLiteral("\\\""), QStringLiteral("\""));
}

/// The texts of ui that are to be translated.
inline std::set<QString> textsOfSources() {
  static const QRegularExpression call(QStringLiteral(
      R"re((?:\btr\(|\btranslate\("\w+",|\bQT_TRANSLATE_NOOP\("\w+",)\s*((?:"(?:[^"\\]|\\.)*"\s*)+))re"));
  std::set<QString> texts;
  const QString sources = readSources("ui");
  for (auto found = call.globalMatch(sources); found.hasNext();)
    texts.insert(joinedLiterals(found.next().captured(1)));
  return texts;
}

}  // namespace scantrove::test
