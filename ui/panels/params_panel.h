#pragma once
#include <QWidget>
#include <functional>
#include <string>
#include <vector>

#include "core/session/scan_params.h"

class QFormLayout;
class QLabel;
class QSlider;

namespace scantrove {

struct ParamInfo;

/// Settings: k, and a few other parameters under "More settings". Emits changed() at once.
class ParamsPanel : public QWidget {
  Q_OBJECT

 public:
  explicit ParamsPanel(const ScanParams& params, QWidget* parent = nullptr);
  [[nodiscard]] const ScanParams& params() const { return params_; }

  /// Applies a number that is still being typed.
  void finishTyping();

 signals:
  void changed(const scantrove::ScanParams& params);

 public slots:
  void setDefaults();

 private:
  QWidget* makeDetailSlider();
  QWidget* makeField(const ParamInfo& info);
  void addField(QFormLayout* form, const std::string& key, const QString& label);
  void showK();

  ScanParams params_;
  QSlider* k_slider_ = nullptr;
  QLabel* k_value_ = nullptr;
  std::vector<std::function<void()>> refreshers_;  ///< each shows params_ in its field
};

}  // namespace scantrove
