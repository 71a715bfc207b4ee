/// @file
/// Panel: state of the robot with reasons, checks, fault injection, and recording.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <rviz/panel.h>

#include <QTimer>

#include "panel/content_view.hpp"
#include "panel/fault_box.hpp"
#include "panel/listener.hpp"
#include "panel/record_box.hpp"

namespace mtr_rviz {

/// Only arranges widgets; the contents come from core/panel_content.
class RobotPanel : public rviz::Panel {
  Q_OBJECT
 public:
  explicit RobotPanel(QWidget* parent = nullptr);

  void load(const rviz::Config& config) override;
  void save(rviz::Config config) const override;

 private:
  void show_robot();

  Listener listener_;
  ContentView* content_;
  FaultBox* faults_;
  RecordBox* record_;
  QTimer* timer_;
  QTimer* master_timer_;
};

}  // namespace mtr_rviz
