// A program that uses a catalogue during a test: catalogue_user FILE. It executes commands from stdin, one
// per line, and answers each with one line: "ok", "stored ID", or an error message.
//   open             opens the catalogue, again if it is open
//   add              stores an object
//   rename ID NAME
//   write            stores objects until it is killed, with a line for each
//   quit             closes the catalogue and ends
#include <QCoreApplication>
#include <iostream>
#include <opencv2/core.hpp>
#include <sstream>

#include "core/catalogue/object_database.h"

namespace scantrove {
namespace {

class CatalogueUser {
 public:
  explicit CatalogueUser(std::string file) : file_(std::move(file)) {}

  /// Executes a command. Result: the answer.
  std::string answer(const std::string& line) {
    std::istringstream words(line);
    std::string command;
    words >> command;
    if (command == "open") return open();
    if (databases_.empty()) return "not open";
    if (command == "add") return add();
    if (command == "rename") return rename(words);
    return "unknown command '" + line + "'";
  }

 private:
  std::string open() {
    auto opened = ObjectDatabase::open(file_);
    if (!opened) return opened.error().message();
    databases_.push_back(std::move(*opened));
    return "ok";
  }

  std::string add() {
    ObjectView view;
    view.color = cv::Mat(120, 160, CV_8UC3);
    cv::randu(view.color, 0, 256);
    view.mask = cv::Mat(120, 160, CV_8UC1, cv::Scalar(255));
    const auto added = databases_.front()->addObject(view);
    return added ? "stored " + std::to_string(added->id.value) : added.error().message();
  }

  std::string rename(std::istream& words) {
    ObjectId object;
    std::string name;
    words >> object.value >> name;
    const auto done = databases_.front()->rename(object, name);
    return done ? "ok" : done.error().message();
  }

  std::string file_;
  std::vector<std::unique_ptr<ObjectDatabase>> databases_;
};

}  // namespace
}  // namespace scantrove

int main(int argc, char** argv) {
  const QCoreApplication qt(argc, argv);
  if (argc != 2) return 2;
  scantrove::CatalogueUser user(argv[1]);
  for (std::string line; std::getline(std::cin, line) && line != "quit";) {
    if (line != "write") {
      std::cout << user.answer(line) << std::endl;
      continue;
    }
    while (std::cout) std::cout << user.answer("add") << std::endl;
  }
}
