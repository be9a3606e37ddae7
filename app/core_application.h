#pragma once
#include <QCoreApplication>
#include <clocale>

namespace scantrove {

/// Qt without a display: what the database drivers need. One at a time, on the main thread.
class CoreApplication {
 public:
  CoreApplication() : application_(count_, arguments_) {
    // Qt takes the numbers of the person's language (decimal commas); files and results keep the C ones.
    std::setlocale(LC_NUMERIC, "C");
  }

 private:
  int count_ = 1;
  char name_[10] = "scantrove";
  char* arguments_[2] = {name_, nullptr};
  QCoreApplication application_;
};

}  // namespace scantrove
