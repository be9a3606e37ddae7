#include <iomanip>
#include <memory>

#include "app/command.h"
#include "app/json_output.h"
#include "app/scan_options.h"
#include "core/session/param_registry.h"

namespace scantrove {
namespace {

struct ParamsCommand {
  std::string config;
  std::vector<std::string> settings;
  bool json = false;
};

std::string plain(double value) {
  std::ostringstream text;
  text << value;
  return text.str();
}

std::string rangeOf(const ParamInfo& info) {
  if (info.file) return "a file or off";
  if (info.isNumber())
    return plain(info.minimum) + " .. " + plain(info.maximum) + (info.can_be_automatic ? "|auto" : "");
  std::string words;
  for (const std::string& choice : info.choices) words += (words.empty() ? "" : "|") + choice;
  return words;
}

void printTable(const ScanParams& params) {
  std::cout << std::left;
  for (const ParamInfo& info : paramRegistry()) {
    std::cout << std::setw(34) << info.key << std::setw(12) << info.text(params) << std::setw(8) << info.unit
              << std::setw(18) << rangeOf(info) << info.help << '\n';
  }
}

void printParamsAsJson(const ScanParams& params) {
  Json list = Json::array();
  for (const ParamInfo& info : paramRegistry()) {
    const auto value = [&](const ScanParams& from) {
      return info.isNumber() && !info.isAutomatic(from) ? Json::parse(info.text(from))
                                                        : Json(info.text(from));
    };
    Json entry = {
        {"key", info.key}, {"value", value(params)}, {"default", value(ScanParams{})}, {"unit", info.unit}};
    if (info.isNumber()) {
      entry["range"] = {info.minimum, info.maximum};
      entry["can_be_auto"] = info.can_be_automatic;
    } else if (!info.choices.empty()) {
      entry["choices"] = info.choices;
    } else {
      entry["file"] = true;
    }
    entry["help"] = info.help;
    list.push_back(std::move(entry));
  }
  printJson(list);
}

}  // namespace

void addParamsCommand(CLI::App& app, CommandJob& job) {
  auto command = std::make_shared<ParamsCommand>();
  CLI::App* sub = app.add_subcommand("params", "List the parameters: value, unit, range, meaning");
  sub->add_option("--config", command->config, "apply this TOML file first")->type_name("FILE");
  sub->add_option("--set", command->settings, "apply this setting first")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
      ->allow_extra_args(false)
      ->type_name("key=value");
  sub->add_flag("--json", command->json, "as JSON");
  sub->callback([command, &job] {
    job = [command, params = paramsFrom(command->config, command->settings)]() -> Result<void> {
      command->json ? printParamsAsJson(params) : printTable(params);
      return {};
    };
  });
}

}  // namespace scantrove
