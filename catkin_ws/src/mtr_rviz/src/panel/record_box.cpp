/// @file
/// Starts and stops a recording of the running robot.
// SPDX-License-Identifier: Apache-2.0
#include "panel/record_box.hpp"

#include <sys/prctl.h>

#include <QDir>
#include <QGridLayout>
#include <QStringList>
#include <csignal>

namespace mtr_rviz {
namespace {

/// Profiles of mtr_recording.
const QStringList kProfiles{"small", "full"};
/// Time limit for closing the bag.
constexpr int kEndLimitMs = 5000;

/// Process that receives a termination signal if this program is killed.
class Recorder : public QProcess {
 public:
  using QProcess::QProcess;

 protected:
  void setupChildProcess() override { prctl(PR_SET_PDEATHSIG, SIGTERM); }
};

}  // namespace

RecordBox::RecordBox(QWidget* parent)
    : QGroupBox("Recording", parent),
      profile_(new QComboBox),
      folder_(new QLineEdit(QDir::homePath())),
      button_(new QPushButton),
      said_(new QLabel),
      process_(new Recorder(this)) {
  profile_->addItems(kProfiles);
  said_->setWordWrap(true);
  said_->setTextFormat(Qt::PlainText);
  auto* grid = new QGridLayout(this);
  grid->addWidget(profile_, 0, 0);
  grid->addWidget(folder_, 0, 1);
  grid->addWidget(button_, 0, 2);
  grid->addWidget(said_, 1, 0, 1, 3);
  process_->setProcessChannelMode(QProcess::MergedChannels);
  // If several programs match, rosrun asks for a selection, which nothing would answer.
  process_->setStandardInputFile(QProcess::nullDevice());
  connect(button_, &QPushButton::clicked, this, &RecordBox::start_or_end);
  connect(folder_, &QLineEdit::textEdited, this, &RecordBox::folder_changed);
  connect(process_, &QProcess::stateChanged, this, &RecordBox::show_state);
  connect(process_, &QProcess::readyRead, this, &RecordBox::read);
  connect(process_, &QProcess::errorOccurred, this, [this](QProcess::ProcessError error) {
    if (error == QProcess::FailedToStart) {
      said_->setText("rosrun is not there: " + process_->errorString() + ".");
    }
  });
  show_state();
}

RecordBox::~RecordBox() {
  process_->disconnect(this);
  if (process_->state() != QProcess::NotRunning) {
    process_->terminate();
    process_->waitForFinished(kEndLimitMs);
  }
}

void RecordBox::start_or_end() {
  if (process_->state() != QProcess::NotRunning) {
    process_->terminate();
    button_->setEnabled(false);
    return;
  }
  said_->clear();
  process_->start("rosrun",
                  {"mtr_recording", "record", "--profile", profile_->currentText(), "--out", folder_->text()});
}

void RecordBox::show_state() {
  const bool is_running = process_->state() != QProcess::NotRunning;
  button_->setText(is_running ? "End" : "Record");
  button_->setEnabled(true);
  profile_->setEnabled(!is_running);
  folder_->setEnabled(!is_running);
}

void RecordBox::read() {
  const QStringList lines = QString::fromUtf8(process_->readAll()).split('\n', Qt::SkipEmptyParts);
  if (!lines.isEmpty()) {
    said_->setText(lines.last());
  }
}

}  // namespace mtr_rviz
