#pragma once
#include <QCoreApplication>
#include <clocale>

namespace scantrove {

/// Qt without a display, which the database drivers need. One instance at a time, on the main thread.
class CoreApplication {
 public:
  CoreApplication() : application_(count_, arguments_) {
    // Qt sets the user's locale (decimal commas); files and results need the C number format.
    std::setlocale(LC_NUMERIC, "C");
  }

 private:
  int count_ = 1;
  char name_[10] = "scantrove";
  char* arguments_[2] = {name_, nullptr};
  QCoreApplication application_;
};

}  // namespace scantrove
