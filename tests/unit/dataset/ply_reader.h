#pragma once
#include <array>
#include <cstdint>
#include <cstring>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace scantrove::test {

/// A binary little-endian PLY file, read as its header says.
struct PlyFile {
  std::vector<std::string> properties;  ///< "float x", in order
  std::map<std::string, std::vector<double>> values;
  std::string face_property;
  std::vector<std::array<int, 3>> faces;

  explicit PlyFile(const std::string& bytes) {
    const std::string kEnd = "end_header\n";
    const std::size_t end = bytes.find(kEnd);
    if (end == std::string::npos) throw std::runtime_error("no header");
    std::istringstream header(bytes.substr(0, end));
    std::string line, element;
    std::map<std::string, std::size_t> counts;
    std::vector<std::pair<std::string, std::string>> layout;
    while (std::getline(header, line)) {
      std::istringstream words(line);
      std::string word, type, name;
      words >> word;
      if (word == "element") {
        words >> element;
        words >> counts[element];
      } else if (word == "property" && element == "face") {
        face_property = line.substr(9);
      } else if (word == "property") {
        words >> type >> name;
        layout.emplace_back(type, name);
        properties.push_back(type + " " + name);
      }
    }
    const char* at = bytes.data() + end + kEnd.size();
    const char* const last = bytes.data() + bytes.size();
    const auto take = [&]<class T>(T) {
      T value;
      if (at + sizeof value > last) throw std::runtime_error("too short");
      std::memcpy(&value, at, sizeof value);
      at += sizeof value;
      return value;
    };
    for (std::size_t i = 0; i < counts["vertex"]; ++i) {
      for (const auto& [type, name] : layout) {
        values[name].push_back(type == "float"    ? static_cast<double>(take(0.0F))
                               : type == "double" ? take(0.0)
                               : type == "uint"   ? static_cast<double>(take(std::uint32_t{}))
                                                  : static_cast<double>(take(std::uint8_t{})));
      }
    }
    for (std::size_t i = 0; i < counts["face"]; ++i) {
      if (take(std::uint8_t{}) != 3) throw std::runtime_error("no triangle");
      faces.push_back({take(0), take(0), take(0)});
    }
    if (at != last) throw std::runtime_error("too long");
  }

  [[nodiscard]] std::size_t size() const { return values.at("x").size(); }
};

}  // namespace scantrove::test
