#include "core/catalogue/class_import.h"

#include <set>
#include <utility>

#include "core/catalogue/catalogue_model.h"

namespace scantrove {
namespace {

class ClassImporter {
 public:
  explicit ClassImporter(CatalogueModel& catalogue) : catalogue_(catalogue) {
    for (const auto& [id, object] : catalogue.objects()) {
      const ObjectClass* own = object.hidden ? nullptr : catalogue.classOf(object.classification);
      if (own != nullptr) used_.insert(own->id);
    }
  }

  Result<void> take(const ClassDraft& given) {
    const Result<ClassDraft> draft = checkedDraft(given);
    if (!draft) return fail(draft.error());
    const ClassTable& classes = catalogue_.classes();
    const ObjectClass* known = classes.named(draft->name);
    if (known == nullptr) known = classes.hiddenNamed(draft->name);
    if (known != nullptr) {
      if (draft->id && draft->id != known->id) note(*draft, "keeps its id " + numberOf(*known));
      return update(*known, *draft);
    }
    known = classes.find(draft->id);
    if (known == nullptr) {
      ++import_.added;
      return catalogue_.addClass(*draft).map([](ClassId) {});
    }
    if (known->merged_into) {
      note(*draft, "is left out: the class " + numberOf(*known) + " was merged into class " +
                       std::to_string(known->merged_into.value));
      return {};
    }
    if (used_.contains(known->id)) {
      note(*draft, "is left out: objects have the class " + numberOf(*known) + ", which is called " +
                       known->name + " here");
      return {};
    }
    return update(*known, *draft);
  }
  [[nodiscard]] ClassImport result() && { return std::move(import_); }

 private:
  static std::string numberOf(const ObjectClass& known) { return std::to_string(known.id.value); }
  void note(const ClassDraft& draft, const std::string& what) {
    const std::string id = draft.id ? " (" + std::to_string(draft.id.value) + " in the list)" : "";
    import_.conflicts.push_back(draft.name + id + ' ' + what + '.');
  }

  Result<void> update(const ObjectClass& known, ClassDraft draft) {
    const ObjectClass before = known;
    draft.id = before.id;
    if (before.hidden) SCANTROVE_TRY(catalogue_.restoreClasses({&before.id, 1}));
    if (const Result<ObjectClass> edited = catalogue_.editClass(draft); !edited) return fail(edited.error());
    ++(*catalogue_.classes().find(before.id) == before ? import_.unchanged : import_.updated);
    return {};
  }

  CatalogueModel& catalogue_;
  std::set<ClassId> used_;
  ClassImport import_;
};

}  // namespace

Result<ClassImport> importClasses(CatalogueModel& catalogue, std::span<const ClassDraft> list) {
  ClassImporter importer(catalogue);
  // Those without an id come last: they take ids that the list does not give.
  for (const bool has_id : {true, false}) {
    for (const ClassDraft& draft : list) {
      if (bool(draft.id) == has_id) SCANTROVE_TRY(importer.take(draft));
    }
  }
  return std::move(importer).result();
}

}  // namespace scantrove
