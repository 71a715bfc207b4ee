/// @file
/// A topic as input of a periodic node.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ros/ros.h>

#include <cstdint>
#include <string>

#include "mtr_core/clock.hpp"
#include "mtr_core/samples.hpp"

namespace mtr_core {

/// A message with the time of its stamp on the clock of Instant::time_ns; false before the first one.
template <typename M>
struct Received {
  std::int64_t time_ns = 0;
  typename M::ConstPtr message;

  explicit operator bool() const { return message != nullptr; }
};

/// Subscription to a periodic topic with a header; `at(tick)` returns the message to use at a tick.
///
/// In simulation it waits for the message that is due at that tick, so that the result does not depend on the speed of
/// the machine. On the robot's own clock, and if waits is false, it returns the newest message.
template <typename M>
class TickInput {
 public:
  TickInput(ros::NodeHandle& node, const std::string& topic, Slot slot, std::int64_t lag_ns = kClockStep.period_ns,
            bool waits = true)
      : samples_(slot, lag_ns, waits ? lockstep_waiting() : std::nullopt),
        subscriber_(node.subscribe<M>(
            topic, 50,
            [this](const typename M::ConstPtr& message) {
              const std::int64_t time_ns = time_of(message->header.stamp, usual_age_ns_);
              samples_.add(time_ns, {time_ns, message});
            },
            ros::VoidConstPtr(), ros::TransportHints().tcpNoDelay())) {}
  TickInput(const TickInput&) = delete;
  TickInput& operator=(const TickInput&) = delete;

  /// Returns the message to use at the tick.
  Received<M> at(std::int64_t tick_ns) { return samples_.at(tick_ns).value_or(Received<M>{}); }

 private:
  std::int64_t usual_age_ns_ = 0;
  Samples<Received<M>> samples_;
  ros::Subscriber subscriber_;
};

}  // namespace mtr_core
