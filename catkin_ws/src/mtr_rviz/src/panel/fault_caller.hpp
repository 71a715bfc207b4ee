/// @file
/// Calls the fault injection node without blocking the window.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QObject>
#include <QString>
#include <thread>

#include "core/fault_order.hpp"

namespace mtr_rviz {

/// Executes one order at a time: a service answers after its execution, while the window continues.
class FaultCaller : public QObject {
  Q_OBJECT
 public:
  using QObject::QObject;
  ~FaultCaller() override;

  /// Starts a call; the answer arrives by `answered`. A second order during a call is rejected.
  void call(const FaultOrder& order);

 Q_SIGNALS:
  /// Emitted in the window's thread.
  void answered(bool is_accepted, const QString& sentence);

 private:
  void take_answer(bool is_accepted, const QString& sentence);

  std::thread thread_;
};

}  // namespace mtr_rviz
