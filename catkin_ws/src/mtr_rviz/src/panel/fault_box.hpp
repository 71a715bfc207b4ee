/// @file
/// Selection of a fault to inject, and list of active faults.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QComboBox>
#include <QDoubleSpinBox>
#include <QGroupBox>
#include <QLabel>
#include <QPushButton>

#include "core/fault_order.hpp"
#include "core/panel_content.hpp"
#include "panel/fault_caller.hpp"

namespace mtr_rviz {

/// Hidden if the robot was started without fault injection.
class FaultBox : public QGroupBox {
  Q_OBJECT
 public:
  explicit FaultBox(QWidget* parent = nullptr);
  void show_content(const PanelContent& content, const FaultCatalogue& catalogue);

 private:
  void show_kinds();
  void inject(const QString& kind);

  FaultCatalogue catalogue_;
  QComboBox* part_;
  QComboBox* kind_;
  QDoubleSpinBox* duration_s_;
  QPushButton* inject_;
  QPushButton* end_;
  QLabel* said_;
  FaultCaller* caller_;
  QString answer_;
};

}  // namespace mtr_rviz
