#include "app/object_options.h"

#include <algorithm>
#include <vector>

#include "core/base/text.h"

namespace scantrove {
namespace {

constexpr double kSmallestBox_m = 0.02, kLargestBox_m = 2;

std::vector<double> numbersFrom(const std::string& option, const std::string& text, std::size_t count,
                                const std::string& meaning) {
  const auto values = parseNumbers(text);
  if (!values || values->size() != count)
    throw CLI::ValidationError(option, "'" + text + "' is not " + meaning);
  return *values;
}

}  // namespace

void ObjectOptions::addTo(CLI::App& command) {
  CLI::Option* alone =
      command
          .add_flag("--object", is_alone,
                    "scan one object alone, on a turntable, a table or in a hand: the surface below it and\n"
                    "the room are left out, and poses are relative to the object")
          ->excludes("--resume");
  command
      .add_option("--object-box", box,
                  "with --object: a box of this size around the object, in metres (default: found)")
      ->needs(alone)
      ->type_name("W,D,H");
  command
      .add_option("--object-at", at,
                  "with --object: where the object is in the first depth image, in pixels (default: in its\n"
                  "middle)")
      ->needs(alone)
      ->type_name("X,Y");
}

std::optional<ObjectChoice> ObjectOptions::toChoice() const {
  if (!is_alone) return std::nullopt;
  ObjectChoice choice;
  if (!box.empty()) {
    const std::vector<double> size_m =
        numbersFrom("--object-box", box, 3, "3 numbers: W,D,H in metres, for example 0.2,0.2,0.3");
    const bool is_possible = std::ranges::all_of(
        size_m, [](double side_m) { return side_m >= kSmallestBox_m && side_m <= kLargestBox_m; });
    if (!is_possible)
      throw CLI::ValidationError("--object-box", "'" + box + "' has sides that are not from 0.02 to 2 m");
    choice.box_m = Eigen::Vector3d(size_m[0], size_m[1], size_m[2]);
  }
  if (!at.empty()) {
    const std::vector<double> pixel =
        numbersFrom("--object-at", at, 2, "2 numbers: X,Y in pixels, for example 320,240");
    if (pixel[0] < 0 || pixel[1] < 0)
      throw CLI::ValidationError("--object-at", "'" + at + "' is outside the image");
    choice.at_px = Eigen::Vector2d(pixel[0], pixel[1]);
  }
  return choice;
}

}  // namespace scantrove
