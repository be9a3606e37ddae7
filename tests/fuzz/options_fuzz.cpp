// Texts of options: numbers, colour registrations, demos, and names given by users.
#include "core/base/label_name.h"
#include "core/base/text.h"
#include "core/capture/color_registration.h"
#include "core/capture/source_options.h"
#include "core/synthetic/synthetic_source.h"
#include "tests/fuzz/fuzz_target.h"

namespace scantrove::test {

std::vector<std::string> seeds() {
  return {"525,525,319.5,239.5",
          "528,528,320,240,0.025",
          "528,528,320,240,0.025,0,0,1,2,3",
          "registered",
          "kinect",
          "tabletop:3:uneven:drab",
          "room:12:exact",
          "room:5:hard",
          "hands:2",
          "turntable:4",
          "tabletop:phone",
          "red cup",
          "M\xC3\xBCsli \xE2\x80\xA8 \x1B[31m",
          "120:320,200"};
}

}  // namespace scantrove::test

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace scantrove;
  const std::string text(reinterpret_cast<const char*>(data), size);
  (void)parseNumbers(text);
  (void)parseFrameNumber(text);
  for (const std::size_t longest : {std::size_t{0}, std::size_t{7}, std::size_t{2000}}) {
    const std::string shown = forTerminal(text, longest);
    test::require(shown.size() <= longest + 4, "the shown text has a limit");
    for (const unsigned char c : shown)
      test::require(c == '\n' || (c >= 0x20 && c != 0x7F), "no control characters are shown");
  }
  if (const auto name = checkedLabelName(text)) {
    test::require(!name->empty() && name->find('\n') == std::string::npos, "a name is one line");
    test::require(checkedLabelName(*name) == *name, "a checked name stays as it is");
  }
  const auto registration = parseColorRegistration(text);
  test::require(registration || !registration.error().what.empty(), "an error has words");
  if (registration) {
    const auto camera =
        colorCameraFor(*registration, {640, 480}, {525, 525, 319.5F, 239.5F, 640, 480}, "input");
    test::require(camera || !camera.error().what.empty(), "an error has words");
  }
  if (text.size() < 40) {
    SourceOptions options;
    options.frames = 1;
    const auto demo = makeSyntheticSource(text, options);
    test::require(demo || !demo.error().what.empty(), "an error has words");
  }
  return 0;
}
