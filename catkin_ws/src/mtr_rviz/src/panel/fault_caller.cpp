/// @file
/// Calls the fault injection node without blocking the window.
// SPDX-License-Identifier: Apache-2.0
#include "panel/fault_caller.hpp"

#include <mtr_msgs/InjectFault.h>
#include <ros/service.h>

#include "mtr_core/names.hpp"

namespace mtr_rviz {

FaultCaller::~FaultCaller() {
  if (thread_.joinable()) {
    thread_.join();
  }
}

void FaultCaller::call(const FaultOrder& order) {
  if (thread_.joinable()) {
    Q_EMIT answered(false, "The order before is not answered yet.");
    return;
  }
  thread_ = std::thread([this, order] {
    mtr_msgs::InjectFault service;
    service.request.part = order.part;
    service.request.kind = order.kind;
    service.request.duration_s = order.duration_s;
    service.request.amount = order.amount;
    const bool has_answered = ros::service::call(mtr_core::names::kInjectFault, service);
    const bool is_accepted = has_answered && service.response.accepted;
    const QString sentence = has_answered ? QString::fromStdString(service.response.message)
                                          : QString("The node that injects faults does not answer.");
    // Queued, because the thread must be joined in the window's thread.
    QMetaObject::invokeMethod(
        this, [this, is_accepted, sentence] { take_answer(is_accepted, sentence); }, Qt::QueuedConnection);
  });
}

void FaultCaller::take_answer(bool is_accepted, const QString& sentence) {
  thread_.join();
  Q_EMIT answered(is_accepted, sentence);
}

}  // namespace mtr_rviz
