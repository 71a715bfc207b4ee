/// @file
/// The rate of a periodic node: in lock-step the clock does not pass a tick before the node's work is done.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ros/ros.h>
#include <std_msgs/Header.h>

#include <cstdint>
#include <optional>

#include "mtr_core/clock.hpp"
#include "mtr_core/names.hpp"
#include "mtr_core/schedule.hpp"

namespace mtr_core {

/// Wakes at the ticks of a slot of the schedule; the node's callbacks run while it sleeps.
///
/// In lock-step each sleep first publishes a hold. Its frame_id is the node, its stamp the node's next tick, its seq
/// the number of messages sent to the simulator so far. The simulator does not advance past the stamp and waits until
/// the messages have arrived. Otherwise nothing is published.
class Ticker {
 public:
  Ticker(ros::NodeHandle& node, Slot slot) : slot_(slot), clock_(node) {
    if (is_lockstep()) {
      holds_ = node.advertise<std_msgs::Header>(names::kSimHold, 20, true);
    }
  }

  /// Waits for the next tick and returns it, or nothing on shutdown.
  ///
  /// A node that exceeded its period continues at the next future tick. The same applies if it was away (stopped,
  /// starved, or its machine suspended); until then it receives the messages that arrived meanwhile.
  std::optional<Instant> sleep() {
    std::int64_t tick_ns = 0;
    do {
      tick_ns = slot_.next_after(clock_.now().time_ns);
      hold(tick_ns);
      if (!clock_.wait_until(tick_ns)) {
        return std::nullopt;
      }
    } while (is_missed(slot_, tick_ns, clock_.now().time_ns));
    return is_lockstep() ? Instant{tick_ns, tick_ns} : clock_.now();
  }

  /// Returns the present on both clocks.
  Instant now() const { return clock_.now(); }

  /// Counts a message that the owner sends to the simulator.
  void count_message_sent() { ++messages_sent_; }

 private:
  void hold(std::int64_t tick_ns) {
    if (holds_) {
      std_msgs::Header message;
      message.seq = messages_sent_;
      message.stamp = stamp_of(tick_ns);
      message.frame_id = ros::this_node::getName();
      holds_.publish(message);
    }
  }

  Slot slot_;
  Clock clock_;
  ros::Publisher holds_;
  std::uint32_t messages_sent_ = 0;
};

}  // namespace mtr_core
