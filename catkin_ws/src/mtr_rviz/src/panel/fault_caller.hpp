/// @file
/// Asks the node that injects faults, beside the window.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QObject>
#include <QString>
#include <thread>

#include "core/fault_order.hpp"

namespace mtr_rviz {

/// One order at a time: a service answers when it has done what it was asked for, and the window goes on meanwhile.
class FaultCaller : public QObject {
  Q_OBJECT
 public:
  using QObject::QObject;
  ~FaultCaller() override;

  /// The answer comes by answered; an order beside another one is refused.
  void call(const FaultOrder& order);

 Q_SIGNALS:
  /// In the thread of the window.
  void answered(bool is_accepted, const QString& sentence);

 private:
  void take_answer(bool is_accepted, const QString& sentence);

  std::thread thread_;
};

}  // namespace mtr_rviz
