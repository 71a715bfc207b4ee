/// @file
/// Orderly exit of a node that must not stop abruptly: request and time limit.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ros/xmlrpc_manager.h>

#include <atomic>
#include <csignal>
#include <cstdint>

#include "mtr_core/steady_time.hpp"

namespace mtr_core {

/// Limit in s after which a node that was asked to leave ends, even if its ticks no longer occur.
inline constexpr double kLeaveWithinS = 0.6;

namespace detail {

// Written by a signal handler; 0: no request.
inline std::atomic<std::int64_t> asked_to_leave_ns{0};

inline void ask_to_leave(int /*signal*/ = 0) {
  std::int64_t not_asked = 0;
  asked_to_leave_ns.compare_exchange_strong(not_asked, boot_time_ns());
}

inline void answer_shutdown(XmlRpc::XmlRpcValue& /*parameters*/, XmlRpc::XmlRpcValue& result) {
  ask_to_leave();
  result = ros::xmlrpc::responseInt(1, "", 0);
}

}  // namespace detail

/// True when the node must finish its work.
inline bool is_asked_to_leave() { return detail::asked_to_leave_ns != 0; }

/// True when the time for finishing is over.
inline bool must_leave() {
  return is_asked_to_leave() && !is_fresh(detail::asked_to_leave_ns, boot_time_ns(), kLeaveWithinS);
}

/// From now on SIGINT, SIGTERM and the master (rosnode kill, another node of the same name) only request an exit.
inline void leave_in_order() {
  std::signal(SIGINT, detail::ask_to_leave);
  std::signal(SIGTERM, detail::ask_to_leave);
  ros::XMLRPCManager::instance()->unbind("shutdown");
  ros::XMLRPCManager::instance()->bind("shutdown", detail::answer_shutdown);
}

}  // namespace mtr_core
