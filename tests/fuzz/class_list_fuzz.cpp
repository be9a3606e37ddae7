// Lists of classes of other programs, as JSON or CSV: read, imported, and written again.
#include <algorithm>
#include <set>

#include "core/catalogue/catalogue_model.h"
#include "core/catalogue/class_import.h"
#include "core/catalogue/class_list.h"
#include "tests/fuzz/fuzz_target.h"

namespace scantrove::test {

std::vector<std::string> seeds() {
  return {
      R"({"categories": [{"id": 3, "name": "chair", "supercategory": "furniture", "scantrove":)"
      R"( {"color": "#ff8000", "attributes": [{"name": "material", "kind": "choice", "choices": ["wood"]},)"
      R"( {"name": "broken", "kind": "yes_no"}, {"name": "note", "kind": "text"}]}}]})",
      R"({"images": [{"id": 1}], "categories": [{"id": 1, "name": "person"}, {"name": "mug"}]})",
      "id,name,supercategory,color\n3,chair,furniture,#ff8000\n2147483647,\"a \"\"b\"\", c\",,\n",
      "name\r\nchair\r\ntable\r\n"};
}

}  // namespace scantrove::test

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace scantrove;
  const auto list = parseClassList({reinterpret_cast<const char*>(data), size}, "list.json");
  if (!list) {
    test::require(list.error().what.find("list.json") != std::string::npos, "errors name the file");
    return 0;
  }
  CatalogueModel catalogue;
  const Result<ClassImport> imported = importClasses(catalogue, *list);
  test::require(imported.has_value(), "a list that was read can be imported");
  std::set<std::string> names;
  for (const auto& [id, one] : catalogue.classes().all()) {
    test::require(id.value >= 1 && id.value <= kLargestClassId, "ids are in range");
    test::require(names.insert(one.name).second, "names are unique");
  }
  const std::vector<ObjectClass> classes = catalogue.classes().visible();
  for (const std::string& text : {classListToJson(classes), classListToCsv(classes)}) {
    const auto again = parseClassList(text, "list.json");
    test::require(again && again->size() == classes.size(), "what was written can be read");
    for (std::size_t i = 0; i < classes.size(); ++i) {
      ClassDraft expected = draftOf(classes[i]);
      if (!(*again)[i].attributes) expected.attributes.reset();
      test::require((*again)[i] == expected, "what is read is what was written");
    }
  }
  return 0;
}
