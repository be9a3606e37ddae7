#include "core/catalogue/class_list.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <utility>

#include "core/base/regular_file.h"
#include "core/base/text.h"
#include "core/catalogue/class_json.h"

namespace scantrove {
namespace {

using ListJson = nlohmann::ordered_json;

constexpr const char* kOwnKey = "scantrove";
constexpr std::array<std::string_view, 4> kColumns{"id", "name", "supercategory", "color"};
constexpr int kDeepest = 8;  // levels of a class list in JSON

Error isNoList(const std::string& file, const std::string& why) {
  return {"The list of classes " + file + " cannot be read: " + why + ".",
          "Give JSON with \"categories\", or CSV with the first line id,name,supercategory,color."};
}

/// Collects the classes of one file.
class ListedClasses {
 public:
  explicit ListedClasses(std::string file) : file_(std::move(file)) {}

  Result<void> add(const ClassDraft& given) {
    const std::string where = "class " + std::to_string(drafts_.size() + 1);
    if (drafts_.size() == kMostListedClasses) {
      return fail(isNoList(file_, "it has more than " + std::to_string(kMostListedClasses) + " classes"));
    }
    Result<ClassDraft> draft = checkedDraft(given);
    if (!draft)
      return fail("In the list " + file_ + ", " + where + ": " + draft.error().what, draft.error().advice);
    if (draft->name.empty()) return fail(isNoList(file_, where + " has no name"));
    if (draft->id && !ids_.insert(draft->id).second)
      return fail(isNoList(file_, "the id " + std::to_string(draft->id.value) + " occurs twice"));
    if (!names_.insert(draft->name).second)
      return fail(isNoList(file_, "the name '" + draft->name + "' occurs twice"));
    drafts_.push_back(std::move(*draft));
    return {};
  }
  [[nodiscard]] std::vector<ClassDraft> take() && { return std::move(drafts_); }
  [[nodiscard]] const std::string& file() const { return file_; }

 private:
  std::string file_;
  std::vector<ClassDraft> drafts_;
  std::set<ClassId> ids_;
  std::set<std::string> names_;
};

Error isNoId(const std::string& file, const std::string& text) {
  return isNoList(file,
                  "'" + forTerminal(text, 40) + "' is no id from 1 to " + std::to_string(kLargestClassId));
}

Error isNoColor(const std::string& file, const std::string& text) {
  return isNoList(file, "'" + forTerminal(text, 40) + "' is no color like #ff8000");
}

// JSON.

/// Of one category. Throws nlohmann's exceptions.
Result<ClassDraft> draftFromJson(const ListJson& json, const std::string& file) {
  ClassDraft draft;
  draft.name = json.at("name").get<std::string>();
  if (json.contains("id")) {
    const ListJson& id = json.at("id");
    const bool is_id =
        id.is_number_unsigned() && id.get<std::uint64_t>() >= 1 && id.get<std::uint64_t>() <= kLargestClassId;
    if (!is_id) return fail(isNoId(file, id.dump(-1, ' ', true, ListJson::error_handler_t::replace)));
    draft.id = ClassId{id.get<std::uint32_t>()};
  }
  if (json.contains("supercategory") && !json.at("supercategory").is_null())
    draft.supercategory = json.at("supercategory").get<std::string>();
  if (!json.contains(kOwnKey)) return draft;
  const ListJson& own = json.at(kOwnKey);
  static_cast<void>(own.get_ref<const ListJson::object_t&>());
  if (own.contains("color")) {
    const auto text = own.at("color").get<std::string>();
    draft.color = colorFromHex(text);
    if (!draft.color) return fail(isNoColor(file, text));
  }
  if (own.contains("attributes")) draft.attributes = attributesFromJson(own.at("attributes"));
  return draft;
}

Result<std::vector<ClassDraft>> parseJson(std::string_view text, const std::string& file) {
  bool is_too_deep = false;
  // Only the categories are built: images and annotations of a COCO file may be large.
  const auto isNeeded = [&](int depth, ListJson::parse_event_t event, const ListJson& parsed) {
    using Event = ListJson::parse_event_t;
    const bool is_start = event == Event::object_start || event == Event::array_start;
    if (is_start && depth >= kDeepest) is_too_deep = true;
    if (is_too_deep) return false;
    return event != Event::key || depth != 1 || parsed == "categories";
  };
  ListedClasses classes(file);
  std::string what = "it has no list of categories";
  try {
    const ListJson json = ListJson::parse(text, isNeeded);
    if (is_too_deep) return fail(isNoList(file, "its values are nested too deep"));
    const auto& categories = json.at("categories").get_ref<const ListJson::array_t&>();
    for (std::size_t i = 0; i < categories.size(); ++i) {
      what = "class " + std::to_string(i + 1) + " lacks its name, or has a member of another type";
      const Result<ClassDraft> draft = draftFromJson(categories[i], file);
      if (!draft) return fail(draft.error());
      SCANTROVE_TRY(classes.add(*draft));
    }
  } catch (const ListJson::parse_error& failure) {
    return fail(isNoList(file, is_too_deep ? "its values are nested too deep"
                                           : "it is no valid JSON at byte " + std::to_string(failure.byte)));
  } catch (const ListJson::exception&) {
    return fail(isNoList(file, what));
  }
  return std::move(classes).take();
}

// CSV.

using Cells = std::vector<std::string>;

/// The next line, with quoted cells as in RFC 4180. None: a quote is not closed, or text follows a quoted
/// cell.
std::optional<Cells> nextLine(std::string_view& text) {
  Cells cells(1);
  bool is_quoted = false, was_quoted = false;
  std::size_t at = 0;
  for (; at < text.size(); ++at) {
    const char c = text[at];
    if (is_quoted) {
      if (c != '"') {
        cells.back() += c;
      } else if (text.substr(at + 1, 1) == "\"") {
        cells.back() += text[++at];
      } else {
        is_quoted = false;
        was_quoted = true;
      }
    } else if (c == '\n') {
      break;
    } else if (c == ',') {
      cells.emplace_back();
      was_quoted = false;
    } else if (c == '"' && cells.back().empty() && !was_quoted) {
      is_quoted = true;
    } else if (c != '\r' || text.substr(at + 1, 1) != "\n") {
      if (was_quoted || c == '"') return std::nullopt;
      cells.back() += c;
    }
    if (cells.size() > 2 * kColumns.size()) return std::nullopt;
  }
  if (is_quoted) return std::nullopt;
  text.remove_prefix(std::min(at + 1, text.size()));
  return cells;
}

Result<ClassDraft> draftFromCells(const std::map<std::string_view, std::string>& cells,
                                  const std::string& file) {
  const auto cell = [&](const char* column) {
    const auto found = cells.find(column);
    return found == cells.end() ? std::string() : std::string(trimmed(found->second));
  };
  ClassDraft draft;
  draft.name = cell("name");
  if (const std::string id = cell("id"); !id.empty()) {
    const char* end = id.data() + id.size();
    const auto [stop, failure] = std::from_chars(id.data(), end, draft.id.value);
    const bool is_id = failure == std::errc{} && stop == end && draft.id && draft.id.value <= kLargestClassId;
    if (!is_id) return fail(isNoId(file, id));
  }
  if (cells.contains("supercategory")) draft.supercategory = cell("supercategory");
  if (const std::string color = cell("color"); !color.empty()) {
    draft.color = colorFromHex(color);
    if (!draft.color) return fail(isNoColor(file, color));
  }
  return draft;
}

Result<std::vector<ClassDraft>> parseCsv(std::string_view text, const std::string& file) {
  std::vector<std::string_view> columns;
  ListedClasses classes(file);
  for (int line = 1; !text.empty(); ++line) {
    const std::optional<Cells> cells = nextLine(text);
    const std::string where = "line " + std::to_string(line);
    if (!cells) return fail(isNoList(file, where + " is no line of CSV"));
    if (line == 1) {
      for (const std::string& cell : *cells) {
        const auto known = std::ranges::find(kColumns, trimmed(cell));
        if (known == kColumns.end() || std::ranges::count(columns, *known) > 0) {
          return fail(isNoList(file, "its first line has no column '" + forTerminal(cell, 40) + "'" +
                                         (known == kColumns.end() ? "" : " twice")));
        }
        columns.push_back(*known);
      }
      if (std::ranges::count(columns, "name") == 0)
        return fail(isNoList(file, "its first line has no column 'name'"));
      continue;
    }
    if (cells->size() == 1 && trimmed(cells->front()).empty()) continue;
    if (cells->size() != columns.size()) {
      return fail(isNoList(file, where + " has " + std::to_string(cells->size()) + " columns, not " +
                                     std::to_string(columns.size())));
    }
    std::map<std::string_view, std::string> of_column;
    for (std::size_t i = 0; i < columns.size(); ++i) of_column[columns[i]] = (*cells)[i];
    const Result<ClassDraft> draft = draftFromCells(of_column, file);
    if (!draft) return fail(draft.error());
    SCANTROVE_TRY(classes.add(*draft));
  }
  return std::move(classes).take();
}

std::string csvCell(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + '"';
}

}  // namespace

std::string classListToJson(std::span<const ObjectClass> classes) {
  ListJson categories = ListJson::array();
  for (const ObjectClass& one : classes) {
    categories.push_back(
        {{"id", one.id.value},
         {"name", one.name},
         {"supercategory", one.supercategory},
         {kOwnKey, {{"color", hexOf(one.color)}, {"attributes", attributesToJson(one.attributes)}}}});
  }
  return ListJson{{"categories", categories}}.dump(1, ' ', false, ListJson::error_handler_t::replace) + "\n";
}

std::string classListToCsv(std::span<const ObjectClass> classes) {
  std::string text = "id,name,supercategory,color\n";
  for (const ObjectClass& one : classes) {
    text += std::to_string(one.id.value) + ',' + csvCell(one.name) + ',' + csvCell(one.supercategory) + ',' +
            hexOf(one.color) + '\n';
  }
  return text;
}

Result<std::vector<ClassDraft>> parseClassList(std::string_view text, const std::string& file) {
  if (text.size() > kLargestClassList)
    return fail(isNoList(file, "it has more than " + std::to_string(kLargestClassList >> 20U) + " MiB"));
  constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
  if (text.starts_with(kByteOrderMark)) text.remove_prefix(kByteOrderMark.size());
  const std::string_view content = trimmed(text);
  if (content.empty()) return fail(isNoList(file, "it is empty"));
  return content.front() == '{' ? parseJson(content, file) : parseCsv(text, file);
}

Result<std::vector<ClassDraft>> readClassList(const std::filesystem::path& file) {
  const Result<std::string> text = readFile(file, kLargestClassList + 1);
  if (!text) return fail(text.error());
  return parseClassList(*text, file.string());
}

}  // namespace scantrove
