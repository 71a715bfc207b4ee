/// @file
/// Starts and stops a recording of the running robot.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QComboBox>
#include <QGroupBox>
#include <QLabel>
#include <QLineEdit>
#include <QProcess>
#include <QPushButton>

namespace mtr_rviz {

/// Runs `rosrun mtr_recording record`, which ends with this object.
class RecordBox : public QGroupBox {
  Q_OBJECT
 public:
  explicit RecordBox(QWidget* parent = nullptr);
  ~RecordBox() override;

  QString folder() const { return folder_->text(); }
  void set_folder(const QString& folder) { folder_->setText(folder); }

 Q_SIGNALS:
  /// Emitted for a change by a person.
  void folder_changed();

 private:
  void start_or_end();
  void show_state();
  void read();

  QComboBox* profile_;
  QLineEdit* folder_;
  QPushButton* button_;
  QLabel* said_;
  QProcess* process_;
};

}  // namespace mtr_rviz
