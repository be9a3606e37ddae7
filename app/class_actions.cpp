#include "app/class_actions.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <filesystem>
#include <iomanip>
#include <iostream>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/catalogue_access.h"
#include "app/command.h"
#include "app/core_application.h"
#include "app/json_output.h"
#include "core/catalogue/class_json.h"
#include "core/catalogue/class_list.h"
#include "core/exchange/atomic_file.h"

namespace scantrove {
namespace {

struct ClassArguments {
  std::string class_text;  ///< an id or a name
  std::string other;       ///< the second class, or the new name
  std::string object, file;
  std::uint32_t id = 0;
  std::optional<std::string> color, supercategory;
  std::vector<std::string> attributes;
  bool json = false, undo = false, none = false;
};

using ClassAction = Result<void> (*)(ObjectDatabase&, const ClassArguments&);

Json classToJson(const CatalogueModel& catalogue, const ObjectClass& one) {
  const auto objects = std::ranges::count_if(catalogue.objects(), [&](const auto& entry) {
    const ObjectClass* own = catalogue.classOf(entry.second.classification);
    return !entry.second.hidden && own != nullptr && own->id == one.id;
  });
  return {{"id", one.id.value},
          {"name", one.name},
          {"color", hexOf(one.color)},
          {"supercategory", one.supercategory},
          {"attributes", attributesToJson(catalogue.classes().attributesOf(one.id))},
          {"objects", objects},
          {"hidden", one.hidden},
          {"merged_into", one.merged_into ? Json(one.merged_into.value) : Json(nullptr)}};
}

void printClass(const Json& one) {
  const auto objects = one["objects"].get<std::int64_t>();
  std::cout << std::right << std::setw(10) << one["id"].get<std::uint32_t>() << "  " << std::left
            << std::setw(24) << inLine(one["name"].get<std::string>()) << "  "
            << one["color"].get<std::string>() << "  " << objects
            << (objects == 1 ? " object   " : " objects  ") << inLine(one["supercategory"].get<std::string>())
            << (one["hidden"] == true ? "  hidden" : "") << '\n';
}

/// Prints a class after a change.
Result<void> reportClass(ObjectDatabase& database, ClassId id, const ClassArguments& arguments) {
  const auto catalogue = database.model();
  if (!catalogue) return fail(catalogue.error());
  const Json json = classToJson(*catalogue, *catalogue->classes().find(id));
  if (arguments.json) {
    printJson(json);
  } else {
    printClass(json);
  }
  return {};
}

Result<ObjectClass> classIn(ObjectDatabase& database, const std::string& text) {
  const auto catalogue = database.model();
  if (!catalogue) return fail(catalogue.error());
  return findClass(catalogue->classes(), text);
}

/// "name", "name=text", "name=yes_no" or "name=choice:one,two".
Result<ClassAttribute> attributeFrom(const std::string& text) {
  const std::size_t equals = text.find('='), colon = text.find(':', std::min(equals, text.size()));
  ClassAttribute attribute{text.substr(0, equals)};
  if (equals == std::string::npos) return attribute;
  const std::optional<AttributeKind> kind = attributeKindOf(text.substr(equals + 1, colon - equals - 1));
  if (!kind) {
    return fail("'" + text + "' is no attribute.", "Give NAME=text, NAME=yes_no or NAME=choice:ONE,TWO.");
  }
  attribute.kind = *kind;
  for (std::size_t at = colon; at != std::string::npos;) {
    const std::size_t end = text.find(',', at + 1);
    attribute.choices.push_back(text.substr(at + 1, end == std::string::npos ? end : end - at - 1));
    at = end;
  }
  return attribute;
}

Result<ClassDraft> draftFrom(const ClassArguments& arguments) {
  ClassDraft draft;
  if (arguments.color) {
    draft.color = colorFromHex(*arguments.color);
    if (!draft.color) return fail("'" + *arguments.color + "' is no color.", "Give one like #ff8000.");
  }
  draft.supercategory = arguments.supercategory;
  for (const std::string& text : arguments.attributes) {
    Result<ClassAttribute> attribute = attributeFrom(text);
    if (!attribute) return fail(attribute.error());
    if (!draft.attributes) draft.attributes.emplace();
    draft.attributes->push_back(std::move(*attribute));
  }
  return draft;
}

Result<void> listClasses(ObjectDatabase& database, const ClassArguments& arguments) {
  const auto catalogue = database.model();
  if (!catalogue) return fail(catalogue.error());
  Json json = Json::array();
  for (const ObjectClass& one : catalogue->classes().visible()) json.push_back(classToJson(*catalogue, one));
  if (arguments.json) {
    printJson(json);
    return {};
  }
  for (const Json& one : json) printClass(one);
  return {};
}

Result<void> addOneClass(ObjectDatabase& database, const ClassArguments& arguments) {
  Result<ClassDraft> draft = draftFrom(arguments);
  if (!draft) return fail(draft.error());
  draft->name = arguments.class_text;
  draft->id = ClassId{arguments.id};
  const Result<ClassId> added = database.classes().add(*draft);
  if (!added) return fail(added.error());
  return reportClass(database, *added, arguments);
}

Result<void> editOneClass(ObjectDatabase& database, const ClassArguments& arguments) {
  const auto known = classIn(database, arguments.class_text);
  if (!known) return fail(known.error());
  Result<ClassDraft> draft = draftFrom(arguments);
  if (!draft) return fail(draft.error());
  draft->id = known->id;
  if (const auto before = database.classes().edit(*draft); !before) return fail(before.error());
  return reportClass(database, known->id, arguments);
}

Result<void> renameClass(ObjectDatabase& database, const ClassArguments& arguments) {
  const auto known = classIn(database, arguments.class_text);
  if (!known) return fail(known.error());
  if (arguments.other.empty()) return fail("A class needs a name.", "Type one.");
  const auto before = database.classes().edit({.id = known->id, .name = arguments.other});
  if (!before) return fail(before.error());
  return reportClass(database, known->id, arguments);
}

Result<void> mergeTwoClasses(ObjectDatabase& database, const ClassArguments& arguments) {
  const auto from = classIn(database, arguments.class_text);
  if (!from) return fail(from.error());
  const auto into = classIn(database, arguments.other);
  if (!into) return fail(into.error());
  if (arguments.undo) {
    SCANTROVE_TRY(database.classes().unmerge({into->id, {from->id}}));
    return reportClass(database, from->id, arguments);
  }
  if (const auto merge = database.classes().merge({&from->id, 1}, into->id); !merge)
    return fail(merge.error());
  return reportClass(database, into->id, arguments);
}

Result<void> hideClass(ObjectDatabase& database, const ClassArguments& arguments) {
  const auto known = classIn(database, arguments.class_text);
  if (!known) return fail(known.error());
  SCANTROVE_TRY(database.classes().hide({&known->id, 1}));
  return reportClass(database, known->id, arguments);
}

Result<void> restoreClass(ObjectDatabase& database, const ClassArguments& arguments) {
  const auto known = classIn(database, arguments.class_text);
  if (!known) return fail(known.error());
  SCANTROVE_TRY(database.classes().restore({&known->id, 1}));
  return reportClass(database, known->id, arguments);
}

Result<void> classifyObject(ObjectDatabase& database, const ClassArguments& arguments) {
  const auto object = findObject(database, arguments.object);
  if (!object) return fail(object.error());
  if (arguments.class_text.empty() && !arguments.none && arguments.attributes.empty())
    return fail("No class is given.", "Give one, or --none, or answers with --attribute NAME=VALUE.");
  if (!arguments.class_text.empty() || arguments.none) {
    ClassId class_id;
    if (!arguments.none) {
      const auto known = classIn(database, arguments.class_text);
      if (!known) return fail(known.error());
      class_id = known->id;
    }
    const auto changes = database.classes().classify({&object->id, 1}, class_id);
    if (!changes) return fail(changes.error());
  }
  for (const std::string& text : arguments.attributes) {
    const std::size_t equals = text.find('=');
    if (equals == std::string::npos) return fail("'" + text + "' is no answer.", "Give NAME=VALUE.");
    const auto changes =
        database.classes().answer({&object->id, 1}, text.substr(0, equals), text.substr(equals + 1));
    if (!changes) return fail(changes.error());
  }
  const auto catalogue = database.model();
  if (!catalogue) return fail(catalogue.error());
  const Classification now = catalogue->find(object->id)->classification;
  const ObjectClass* own = catalogue->classOf(now);
  if (arguments.json) {
    printJson({{"id", object->id.value},
               {"name", object->name},
               {"class", own != nullptr ? Json(own->name) : Json(nullptr)},
               {"class_id", own != nullptr ? Json(own->id.value) : Json(nullptr)},
               {"attributes", answersToJson(catalogue->answersOf(now))}});
  } else {
    std::cout << inLine(object->name) << ": " << (own != nullptr ? inLine(own->name) : "no class") << '\n';
  }
  return {};
}

Result<void> importList(ObjectDatabase& database, const ClassArguments& arguments) {
  const auto list = readClassList(arguments.file);
  if (!list) return fail(list.error());
  const Result<ClassImport> imported = database.classes().import(*list);
  if (!imported) return fail(imported.error());
  if (arguments.json) {
    printJson({{"added", imported->added},
               {"updated", imported->updated},
               {"unchanged", imported->unchanged},
               {"conflicts", imported->conflicts}});
    return {};
  }
  for (const std::string& conflict : imported->conflicts)
    std::cerr << "scantrove: " << inLine(conflict) << '\n';
  std::cout << imported->added << " added, " << imported->updated << " updated, " << imported->unchanged
            << " unchanged\n";
  return {};
}

Result<void> exportList(ObjectDatabase& database, const ClassArguments& arguments) {
  const std::filesystem::path file = arguments.file;
  std::error_code ignored;
  if (std::filesystem::exists(std::filesystem::symlink_status(file, ignored)))
    return fail("The file " + file.string() + " exists.", "Give a new name.");
  const auto catalogue = database.model();
  if (!catalogue) return fail(catalogue.error());
  const std::vector<ObjectClass> classes = catalogue->classes().visible();
  const bool is_csv = file.extension() == ".csv";
  SCANTROVE_TRY(writeFileAtomically(file, is_csv ? classListToCsv(classes) : classListToJson(classes)));
  if (arguments.json) {
    printJson({{"file", file.string()}, {"classes", classes.size()}});
  } else {
    std::cout << classes.size() << (classes.size() == 1 ? " class" : " classes") << " written to "
              << inLine(file.string()) << '\n';
  }
  return {};
}

/// Adds the actions of one group.
class ClassActions {
 public:
  ClassActions(CLI::App& parent, CommandJob& job, CataloguePlace place)
      : parent_(parent), job_(job), place_(std::move(place)) {}

  CLI::App* add(const char* name, const char* help, ClassAction action) {
    CLI::App* sub = parent_.add_subcommand(name, help);
    place_.add_options(*sub);
    sub->add_flag("--json", arguments_->json, "as JSON");
    sub->callback([arguments = arguments_, open = place_.open, &job = job_, action] {
      job = [arguments, open, action]() -> Result<void> {
        const CoreApplication qt;
        auto database = open();
        if (!database) return fail(database.error());
        return action(**database, *arguments);
      };
    });
    return sub;
  }
  CLI::App* addWithClass(const char* name, const char* help, ClassAction action) {
    CLI::App* sub = add(name, help, action);
    sub->add_option("CLASS", arguments_->class_text, "name or id")->required();
    return sub;
  }
  void addProperties(CLI::App* sub) {
    sub->add_option("--color", arguments_->color, "its color, such as #ff8000");
    sub->add_option("--supercategory", arguments_->supercategory, "its group, such as furniture");
    sub->add_option("--attribute", arguments_->attributes,
                    "an attribute, repeatable: NAME=text, NAME=yes_no or NAME=choice:ONE,TWO; replaces all")
        ->allow_extra_args(false);
  }
  [[nodiscard]] ClassArguments& arguments() { return *arguments_; }

 private:
  CLI::App& parent_;
  CommandJob& job_;
  CataloguePlace place_;
  std::shared_ptr<ClassArguments> arguments_ = std::make_shared<ClassArguments>();
};

}  // namespace

void addClassActions(CLI::App& classes, CommandJob& job, const CataloguePlace& place) {
  classes.require_subcommand(1);
  ClassActions actions(classes, job, place);
  ClassArguments& arguments = actions.arguments();
  actions.add("list", "All classes", listClasses);
  CLI::App* add = actions.add("add", "Add a class; a hidden one of that name returns", addOneClass);
  add->add_option("NAME", arguments.class_text, "its name")->required();
  add->add_option("--id", arguments.id, "its id, as in data sets (default: the next free one)")
      ->check(CLI::Range(std::uint32_t{1}, kLargestClassId));
  actions.addProperties(add);
  actions.addProperties(actions.addWithClass("edit", "Change the properties of a class", editOneClass));
  actions.addWithClass("rename", "Rename a class; its id stays", renameClass)
      ->add_option("NAME", arguments.other, "the new name")
      ->required();
  CLI::App* merge = actions.addWithClass(
      "merge", "Merge a class into another one, which its objects have then", mergeTwoClasses);
  merge->add_option("INTO", arguments.other, "name or id of the class that remains")->required();
  merge->add_flag("--undo", arguments.undo, "undo that merge");
  actions.addWithClass("hide", "Hide a class that no object has", hideClass);
  actions.addWithClass("restore", "Show a hidden class again", restoreClass);
  CLI::App* classify = actions.add("classify", "Give an object a class, or answers", classifyObject);
  classify->add_option("OBJECT", arguments.object, "name or id of the object")->required();
  CLI::Option* class_option = classify->add_option("CLASS", arguments.class_text, "name or id of the class");
  classify->add_flag("--none", arguments.none, "the object has no class")->excludes(class_option);
  classify->add_option("--attribute", arguments.attributes, "an answer, repeatable: NAME=VALUE; empty: none")
      ->allow_extra_args(false);
  actions
      .add("import", "Add and update classes from a JSON file (COCO categories) or a CSV file", importList)
      ->add_option("FILE", arguments.file, "the list")
      ->required();
  actions.add("export", "Write all classes to a new JSON or .csv file", exportList)
      ->add_option("FILE", arguments.file, "the file; .csv: CSV, else JSON")
      ->required();
}

}  // namespace scantrove
