#include <algorithm>
#include <array>
#include <iomanip>
#include <memory>

#include "app/catalogue_access.h"
#include "app/class_actions.h"
#include "app/command.h"
#include "app/copy_action.h"
#include "app/core_application.h"
#include "app/json_output.h"
#include "core/catalogue/class_json.h"
#include "core/catalogue/object_database.h"

namespace scantrove {
namespace {

struct ObjectsCommand {
  std::optional<std::string> database;  ///< none: that of the default project
  std::string object;                   ///< an id or a name
  std::string other;                    ///< the second object, or the new name
  bool json = false;
  bool undo = false;
};

Json toJson(const ObjectRecord& object, const CatalogueModel& catalogue) {
  const ObjectClass* own = catalogue.classOf(object.classification);
  return {{"id", object.id.value},
          {"name", object.name},
          {"class", own != nullptr ? Json(own->name) : Json(nullptr)},
          {"class_id", own != nullptr ? Json(own->id.value) : Json(nullptr)},
          {"attributes", answersToJson(catalogue.answersOf(object.classification))},
          {"named_by_person", object.named_by == NamedBy::user},
          {"confirmed", object.confirmed},
          {"size_m", {object.size_m.x(), object.size_m.y(), object.size_m.z()}},
          {"views", object.views},
          {"first_session", object.first_session_name},
          {"created", object.created}};
}

Json toJson(const ObjectView& view) {
  return {{"id", view.id},
          {"session", view.session},
          {"frame", view.frame_index},
          {"width", view.color.cols},
          {"height", view.color.rows},
          {"direction", {view.direction.x(), view.direction.y(), view.direction.z()}}};
}

std::string sizeText(const ObjectRecord& object) {
  std::ostringstream text;
  text << std::fixed << std::setprecision(0) << object.size_m.x() * 100 << " x " << object.size_m.y() * 100
       << " x " << object.size_m.z() * 100 << " cm";
  return text.str();
}

void printObject(const ObjectRecord& object) {
  std::cout << std::right << std::setw(5) << object.id.value << "  " << std::left << std::setw(24)
            << inLine(object.name) << std::setw(12) << (object.confirmed ? "confirmed" : "") << std::setw(18)
            << sizeText(object) << object.views << (object.views == 1 ? " view  " : " views  ")
            << inLine(object.created) << '\n';
}

Result<void> list(ObjectDatabase& database, const ObjectsCommand& command) {
  const auto objects = database.objects();
  if (!objects) return fail(objects.error());
  if (!command.json) {
    for (const ObjectRecord& object : *objects) printObject(object);
    return {};
  }
  const auto catalogue = database.model();
  if (!catalogue) return fail(catalogue.error());
  Json json = Json::array();
  for (const ObjectRecord& object : *objects) json.push_back(toJson(object, *catalogue));
  printJson(json);
  return {};
}

Result<void> show(ObjectDatabase& database, const ObjectsCommand& command) {
  const auto object = findObject(database, command.object);
  if (!object) return fail(object.error());
  const auto views = database.views().of(object->id);
  if (!views) return fail(views.error());
  const auto catalogue = database.model();
  if (!catalogue) return fail(catalogue.error());
  if (command.json) {
    Json json = toJson(*object, *catalogue);
    json["views"] = Json::array();
    for (const ObjectView& view : *views) json["views"].push_back(toJson(view));
    printJson(json);
    return {};
  }
  printObject(*object);
  std::cout << "       first seen in " << inLine(object->first_session_name) << '\n';
  if (const ObjectClass* own = catalogue->classOf(object->classification))
    std::cout << "       class " << own->id.value << ": " << inLine(own->name) << '\n';
  for (const ObjectView& view : *views) {
    std::cout << "       view " << view.id << ": session " << view.session << ", frame " << view.frame_index
              << ", " << view.color.cols << " x " << view.color.rows << " px\n";
  }
  return {};
}

/// Prints an object after a change.
Result<void> report(ObjectDatabase& database, ObjectId id, const ObjectsCommand& command) {
  const auto object = database.object(id);
  if (!object) return fail(object.error());
  const auto catalogue = database.model();
  if (!catalogue) return fail(catalogue.error());
  if (command.json) {
    printJson(toJson(*object, *catalogue));
  } else {
    printObject(*object);
  }
  return {};
}

Result<void> rename(ObjectDatabase& database, const ObjectsCommand& command) {
  const auto object = findObject(database, command.object);
  if (!object) return fail(object.error());
  SCANTROVE_TRY(database.rename(object->id, command.other));
  return report(database, object->id, command);
}

Result<void> confirm(ObjectDatabase& database, const ObjectsCommand& command) {
  const auto object = findObject(database, command.object);
  if (!object) return fail(object.error());
  SCANTROVE_TRY(database.setConfirmed({&object->id, 1}, !command.undo));
  return report(database, object->id, command);
}

Result<void> merge(ObjectDatabase& database, const ObjectsCommand& command) {
  const auto first = findObject(database, command.object);
  if (!first) return fail(first.error());
  const auto second = findObject(database, command.other);
  if (!second) return fail(second.error());
  const std::array objects{first->id, second->id};
  const auto merged = database.merge(objects);
  if (!merged) return fail(merged.error());
  const bool keeps_first = merged->into == first->id;
  if (!command.json) {
    std::cout << "kept " << inLine((keeps_first ? *first : *second).name) << " with the views of "
              << inLine((keeps_first ? *second : *first).name) << '\n';
  }
  return report(database, merged->into, command);
}

Result<void> remove(ObjectDatabase& database, const ObjectsCommand& command) {
  const auto object = findObject(database, command.object);
  if (!object) return fail(object.error());
  SCANTROVE_TRY(database.remove({&object->id, 1}));
  if (command.json) {
    printJson({{"deleted", object->id.value}});
  } else {
    std::cout << "deleted " << inLine(object->name) << '\n';
  }
  return {};
}

using ObjectsAction = Result<void> (*)(ObjectDatabase&, const ObjectsCommand&);

CLI::App* addAction(CLI::App& parent, const std::string& name, const std::string& help,
                    const std::shared_ptr<ObjectsCommand>& command, CommandJob& job, ObjectsAction action) {
  CLI::App* sub = parent.add_subcommand(name, help);
  addCatalogueOption(*sub, command->database);
  sub->add_flag("--json", command->json, "as JSON");
  sub->callback([command, &job, action] {
    job = [command, action]() -> Result<void> {
      const CoreApplication qt;
      auto database = openChosenCatalogue(command->database);
      if (!database) return fail(database.error());
      return action(**database, *command);
    };
  });
  return sub;
}

}  // namespace

void addObjectsCommand(CLI::App& app, CommandJob& job) {
  auto command = std::make_shared<ObjectsCommand>();
  CLI::App* objects = app.add_subcommand("objects", "List and edit the objects of a catalogue");
  objects->require_subcommand(1);
  const auto add = [&](const char* name, const char* help, ObjectsAction action) {
    return addAction(*objects, name, help, command, job, action);
  };
  const auto take_object = [&](CLI::App* sub, const char* what) {
    sub->add_option("OBJECT", command->object, what)->required();
    return sub;
  };
  add("list", "All objects", list);
  take_object(add("show", "One object with its views", show), "name or id");
  take_object(add("rename", "Rename an object", rename), "name or id")
      ->add_option("NAME", command->other, "the new name")
      ->required();
  take_object(add("confirm", "Mark an object as confirmed", confirm), "name or id")
      ->add_flag("--undo", command->undo, "remove the mark");
  take_object(
      add("merge",
          "Merge two objects. Keeps the one that a user named, else the confirmed one, else the older "
          "one",
          merge),
      "name or id")
      ->add_option("OTHER", command->other, "name or id of the other object")
      ->required();
  take_object(add("delete", "Delete an object from the catalogue", remove), "name or id");
  addCopyAction(*objects, job);
  const auto addDatabase = [command](CLI::App& sub) { addCatalogueOption(sub, command->database); };
  addClassActions(*objects->add_subcommand("classes", "List and edit the classes of a catalogue"), job,
                  {addDatabase, [command] { return openChosenCatalogue(command->database); }});
}

}  // namespace scantrove
