/// @file
/// Panel: state of the robot with reasons, checks, fault injection, and recording.
// SPDX-License-Identifier: Apache-2.0
#include "panel/robot_panel.hpp"

#include <QScrollArea>
#include <QVBoxLayout>
#include <pluginlib/class_list_macros.hpp>

namespace mtr_rviz {
namespace {

/// Update rates: fast enough for reading, and low load on the master.
constexpr int kShowEveryMs = 200;
constexpr int kAskMasterEveryMs = 2000;
const QString kFolder = "Recording Folder";

}  // namespace

RobotPanel::RobotPanel(QWidget* parent)
    : rviz::Panel(parent),
      content_(new ContentView),
      faults_(new FaultBox),
      record_(new RecordBox),
      timer_(new QTimer(this)),
      master_timer_(new QTimer(this)) {
  auto* inside = new QWidget;
  auto* column = new QVBoxLayout(inside);
  column->addWidget(content_);
  column->addWidget(faults_);
  column->addWidget(record_);
  column->addStretch(1);
  auto* scroller = new QScrollArea;
  scroller->setWidgetResizable(true);
  scroller->setFrameShape(QFrame::NoFrame);
  scroller->setWidget(inside);
  auto* frame = new QVBoxLayout(this);
  frame->setContentsMargins(0, 0, 0, 0);
  frame->addWidget(scroller);
  connect(timer_, &QTimer::timeout, this, &RobotPanel::show_robot);
  connect(master_timer_, &QTimer::timeout, this, [this] { listener_.look(); });
  connect(record_, &RecordBox::folder_changed, this, &rviz::Panel::configChanged);
  timer_->start(kShowEveryMs);
  master_timer_->start(kAskMasterEveryMs);
  show_robot();
}

void RobotPanel::load(const rviz::Config& config) {
  rviz::Panel::load(config);
  QString folder;
  if (config.mapGetString(kFolder, &folder)) {
    record_->set_folder(folder);
  }
}

void RobotPanel::save(rviz::Config config) const {
  rviz::Panel::save(config);
  config.mapSetValue(kFolder, record_->folder());
}

void RobotPanel::show_robot() {
  const PanelContent content = content_of(listener_.robot(), Listener::now_s());
  content_->show_content(content);
  faults_->show_content(content, listener_.catalogue());
}

}  // namespace mtr_rviz

PLUGINLIB_EXPORT_CLASS(mtr_rviz::RobotPanel, rviz::Panel)
