#include "app/argument_check.h"

#include <QByteArray>
#include <QStringDecoder>
#include <algorithm>
#include <array>
#include <string>

#include "core/base/text.h"

namespace scantrove {
namespace {

bool isUtf8(const std::string& text) {
  QStringDecoder decoder(QStringDecoder::Utf8, QStringDecoder::Flag::Stateless);
  const QString decoded = decoder(QByteArrayView(text));
  return !decoder.hasError();
}

bool mayBeEmpty(const std::string& name) {
  return std::ranges::count(std::array{"--name", "--class", "NAME"}, name) > 0;
}

CLI::Validator usable(const std::string& name) {
  return {[name](const std::string& text) -> std::string {
            if (text.empty() && !mayBeEmpty(name)) return "is empty. Give a value, or omit it";
            if (!isUtf8(text) && name != "SOURCE")
              return "'" + forTerminal(text, 100) + "' is not UTF-8. Use other letters";
            return {};
          },
          ""};
}

}  // namespace

void refuseUnusableArguments(CLI::App& app) {
  for (CLI::Option* option : app.get_options()) {
    if (option->get_items_expected_max() == 0) continue;  // a flag
    option->check(usable(option->get_name()));
  }
  for (CLI::App* command : app.get_subcommands({})) refuseUnusableArguments(*command);
}

}  // namespace scantrove
