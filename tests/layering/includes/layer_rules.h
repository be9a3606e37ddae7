#pragma once
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace scantrove::test {

/// Files (paths from the root) and the headers that each includes, without quotes and brackets.
using IncludeTree = std::map<std::string, std::vector<std::string>>;

/// The header that a line includes, without quotes or brackets; empty: none.
inline std::optional<std::string> includedHeader(const std::string& line) {
  const auto skipBlanks = [&](std::size_t from) { return line.find_first_not_of(" \t", from); };
  std::size_t at = skipBlanks(0);
  if (at == std::string::npos || line[at] != '#') return std::nullopt;
  at = skipBlanks(at + 1);
  if (at == std::string::npos || line.compare(at, 7, "include") != 0) return std::nullopt;
  at = skipBlanks(at + 7);
  if (at == std::string::npos || (line[at] != '"' && line[at] != '<')) return std::nullopt;
  const std::size_t end = line.find_first_of("\">", at + 1);
  if (end == std::string::npos) return std::nullopt;
  return line.substr(at + 1, end - at - 1);
}

/// All C++ and OpenCL files below app, core and ui of `root`.
inline IncludeTree readIncludes(const std::filesystem::path& root) {
  static const std::set<std::string> kExtensions{".h", ".cpp", ".cl", ".clh"};
  IncludeTree tree;
  for (const char* top : {"app", "core", "ui"}) {
    if (!std::filesystem::exists(root / top)) continue;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(root / top)) {
      if (!kExtensions.contains(entry.path().extension().string())) continue;
      std::vector<std::string>& headers =
          tree[std::filesystem::relative(entry.path(), root).generic_string()];
      std::ifstream file(entry.path());
      for (std::string line; std::getline(file, line);) {
        if (const std::optional<std::string> header = includedHeader(line)) headers.push_back(*header);
      }
    }
  }
  return tree;
}

/// The layer rules of docs/architecture.md, as pure functions of an IncludeTree.
class LayerRules {
 public:
  /// A sentence for each violation, in order of files.
  [[nodiscard]] static std::vector<std::string> broken(const IncludeTree& tree) {
    std::vector<std::string> findings;
    for (const auto& [file, headers] : tree) {
      for (const std::string& header : headers) {
        if (const std::string why = whyForbidden(file, header); !why.empty()) {
          findings.push_back(file + " includes " + header + ": " + why);
        }
      }
      checkReach(tree, file, findings);
    }
    checkSharedFile(tree, findings);
    return findings;
  }

  /// The modules that each module of core may include, lowest module first.
  static const std::map<std::string, std::set<std::string>>& allowedArrows() {
    static const std::map<std::string, std::set<std::string>> kArrows{
        {"base", {}},
        {"geometry", {}},
        {"image", {"base"}},
        {"compute", {"base"}},
        {"database", {"base"}},
        {"capture", {"base", "image"}},
        {"evaluation", {"base", "capture"}},
        {"synthetic", {"base", "capture"}},
        {"exchange", {"base", "image", "capture"}},
        {"fusion", {"base", "geometry", "compute", "capture"}},
        {"tracking", {"base", "compute", "capture", "fusion"}},
        {"segmentation", {"base", "geometry", "compute", "capture", "fusion"}},
        {"labeling", {"base", "geometry", "compute", "fusion", "segmentation"}},
        {"discovery", {"base", "geometry", "capture", "fusion"}},
        {"editing", {"base", "labeling"}},
        {"meshing", {"base", "compute", "fusion", "labeling"}},
        {"catalogue", {"base", "image", "compute", "database", "capture"}},
        {"texturing", {"base", "image", "capture"}},
        {"dataset", {"base", "image", "compute", "capture", "exchange", "catalogue", "texturing"}},
        {"picture", {"base", "image", "exchange", "dataset"}},
        {"pipeline",
         {"base", "compute", "capture", "fusion", "tracking", "segmentation", "labeling", "discovery",
          "editing", "meshing"}},
        {"collection", {"base", "geometry", "image", "capture", "fusion", "discovery", "catalogue"}},
        {"session",
         {"base", "geometry", "image", "compute", "database", "capture", "exchange", "dataset", "fusion",
          "tracking", "segmentation", "labeling", "discovery", "editing", "catalogue", "pipeline",
          "collection"}},
        {"project", {"base", "database", "dataset", "exchange", "session"}},
        {"refinement",
         {"base", "compute", "capture", "labeling", "discovery", "editing", "pipeline", "collection",
          "session"}}};
    return kArrows;
  }

 private:
  enum class Toolkit { none, qt_core, qt_sql, qt_gui, vtk };

  static bool startsWith(const std::string& text, const std::string& start) {
    return text.rfind(start, 0) == 0;
  }

  /// "core/fusion/raycaster.h" -> {"core", "fusion"}; "app/main.cpp" -> {"app", ""}.
  static std::pair<std::string, std::string> layerOf(const std::string& path) {
    const std::size_t first = path.find('/');
    if (first == std::string::npos) return {"", ""};
    const std::size_t second = path.find('/', first + 1);
    return {path.substr(0, first),
            second == std::string::npos ? "" : path.substr(first + 1, second - first - 1)};
  }

  static bool isOurs(const std::string& header) {
    return startsWith(header, "core/") || startsWith(header, "ui/") || startsWith(header, "app/");
  }

  /// The toolkit of a foreign header. Qt headers that are not listed as QtCore count as QtGui.
  static Toolkit toolkitOf(const std::string& header) {
    static const std::set<std::string> kQtCore{"QBuffer",       "QByteArray",     "QCoreApplication",
                                               "QDateTime",     "QDir",           "QFile",
                                               "QFileInfo",     "QIODevice",      "QList",
                                               "QLocale",       "QObject",        "QRegularExpression",
                                               "QScopeGuard",   "QStandardPaths", "QString",
                                               "QStringList",   "QTemporaryDir",  "QTemporaryFile",
                                               "QTextStream",   "QThread",        "QTimeZone",
                                               "QTimer",        "QUuid",          "QVariant",
                                               "QVector",       "QtGlobal",       "QtEndian",
                                               "QElapsedTimer", "QSettings",      "QUrl",
                                               "QResource",     "QMetaObject",    "QPointer",
                                               "QDebug",        "QVariantMap",    "QStringView",
                                               "QSaveFile",     "QHash",          "QEventLoop",
                                               "QUrlQuery"};
    if (startsWith(header, "vtk")) return Toolkit::vtk;
    if (startsWith(header, "QtCore/") || startsWith(header, "QJson") || kQtCore.contains(header))
      return Toolkit::qt_core;
    if (startsWith(header, "QtSql/") || startsWith(header, "QSql")) return Toolkit::qt_sql;
    const bool is_qt =
        header.size() > 1 && header[0] == 'Q' && std::isupper(static_cast<unsigned char>(header[1])) != 0;
    return is_qt || startsWith(header, "Qt") ? Toolkit::qt_gui : Toolkit::none;
  }

  static std::string whyForbidden(const std::string& file, const std::string& header) {
    const auto [layer, part] = layerOf(file);
    if (isOurs(header)) return whyForbiddenOurs(layer, part, header);
    const Toolkit toolkit = toolkitOf(header);
    if (toolkit == Toolkit::none) return {};
    if (layer == "core") {
      static const std::set<std::string> kWithSql{"database", "catalogue", "session"};
      const bool allowed =
          kWithSql.contains(part) && (toolkit == Toolkit::qt_core || toolkit == Toolkit::qt_sql);
      return allowed ? "" : "core knows no Qt (but QtCore and QtSql where data are kept) and no VTK";
    }
    if (layer == "ui" && (part == "scene" || part == "common") && toolkit != Toolkit::vtk) {
      return "ui/" + part + " is without Qt";
    }
    if (layer == "ui" && part != "scene" && part != "view" && toolkit == Toolkit::vtk) {
      return "only ui/scene and ui/view know VTK";
    }
    return {};
  }

  static std::string whyForbiddenOurs(const std::string& layer, const std::string& part,
                                      const std::string& header) {
    const auto [to_layer, to_part] = layerOf(header);
    static const std::map<std::string, int> kHeight{{"core", 0}, {"ui", 1}, {"app", 2}};
    if (kHeight.at(to_layer) > kHeight.at(layer)) return "dependencies go app -> ui -> core, never back";
    // `scan` may include all modules.
    if (layer != "core" || part == to_part || part == "scan") return {};
    const auto found = allowedArrows().find(part);
    if (found == allowedArrows().end()) return part + " is no module with allowed arrows";
    return found->second.contains(to_part) ? "" : part + " does not stand on " + to_part;
  }

  /// All headers that `file` includes, directly or through own headers.
  static std::set<std::string> reach(const IncludeTree& tree, const std::string& file) {
    std::set<std::string> seen;
    std::vector<std::string> open{file};
    while (!open.empty()) {
      const auto found = tree.find(open.back());
      open.pop_back();
      if (found == tree.end()) continue;
      for (const std::string& header : found->second) {
        if (seen.insert(header).second) open.push_back(header);
      }
    }
    return seen;
  }

  /// Checks indirect includes too.
  static void checkReach(const IncludeTree& tree, const std::string& file,
                         std::vector<std::string>& findings) {
    const auto [layer, part] = layerOf(file);
    if (layer != "ui") return;
    const bool without_qt = part == "scene" || part == "common";
    const bool without_vtk = part == "panels" || part == "models" || part == "bridge" || part == "theme" ||
                             part == "painting" || part == "language";
    if (!without_qt && !without_vtk) return;
    for (const std::string& header : reach(tree, file)) {
      const Toolkit toolkit = isOurs(header) ? Toolkit::none : toolkitOf(header);
      if (without_vtk && toolkit == Toolkit::vtk)
        findings.push_back(file + " reaches " + header + ": it is without VTK");
      if (without_qt && toolkit != Toolkit::none && toolkit != Toolkit::vtk) {
        findings.push_back(file + " reaches " + header + ": it is without Qt");
      }
    }
  }

  /// Only one file (a .cpp and its header) of ui/view uses both Qt and VTK.
  static void checkSharedFile(const IncludeTree& tree, std::vector<std::string>& findings) {
    std::set<std::string> stems;
    for (const auto& [file, headers] : tree) {
      const auto [layer, part] = layerOf(file);
      const auto uses = [&, &names = headers](bool vtk) {
        return std::any_of(names.begin(), names.end(), [&](const std::string& header) {
          const Toolkit toolkit = isOurs(header) ? Toolkit::none : toolkitOf(header);
          return vtk ? toolkit == Toolkit::vtk : toolkit != Toolkit::vtk && toolkit != Toolkit::none;
        });
      };
      if (layer == "ui" && part == "view" && uses(true) && uses(false))
        stems.insert(file.substr(0, file.rfind('.')));
    }
    if (stems.size() < 2) return;
    std::string names;
    for (const std::string& stem : stems) names += " " + stem;
    findings.push_back("Qt and VTK meet in more than one file:" + names);
  }
};

}  // namespace scantrove::test
