/// @file
/// Labels for the state, its reasons and the checks.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QGridLayout>
#include <QLabel>
#include <QWidget>
#include <array>
#include <vector>

#include "core/panel_content.hpp"

namespace mtr_rviz {

/// Creates labels on demand and updates their contents.
class ContentView : public QWidget {
  Q_OBJECT
 public:
  explicit ContentView(QWidget* parent = nullptr);
  void show_content(const PanelContent& content);

 private:
  void show_row(std::size_t index, const Row& row);

  QLabel* state_;
  QLabel* reasons_;
  QGridLayout* grid_;
  /// Sign, name and text of each check.
  std::vector<std::array<QLabel*, 3>> rows_;
};

}  // namespace mtr_rviz
