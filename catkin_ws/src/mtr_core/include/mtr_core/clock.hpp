/// @file
/// The robot's clocks in integer nanoseconds, and waiting for them while callbacks run.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ros/callback_queue.h>
#include <ros/ros.h>
#include <rosgraph_msgs/Clock.h>

#include <algorithm>
#include <cstdint>
#include <optional>

#include "mtr_core/leaving.hpp"
#include "mtr_core/samples.hpp"
#include "mtr_core/stamp_clock.hpp"
#include "mtr_core/steady_time.hpp"

namespace mtr_core {

/// Bounds the delay of a shutdown, in s of wall time; every message ends the wait earlier.
inline constexpr double kShutdownCheckS = 0.2;

/// True when /use_sim_time is set, so that time comes from /clock. Valid after the first ros::NodeHandle exists.
inline bool is_simulated() { return ros::Time::isSimTime(); }

/// In addition to /use_sim_time; without it, simulated time does not wait for the nodes, as with other simulators.
inline constexpr const char* kLockstepParameter = "/lockstep";

/// True when the simulated clock waits for the nodes' holds, and they for each other. The parameter is read once.
inline bool is_lockstep() {
  static const bool is_wanted = ros::param::param(kLockstepParameter, false);
  return is_wanted && is_simulated();
}

/// Set for the clock of a replay, which waits for the nodes while they do not wait for each other.
inline constexpr const char* kHeldParameter = "/held_clock";

/// True when the simulated clock waits for the nodes' computations, as in lock-step. The parameter is read once.
inline bool is_held() {
  static const bool is_wanted = ros::param::param(kHeldParameter, false);
  return is_lockstep() || (is_wanted && is_simulated());
}

/// Stamp of a message in nanoseconds.
inline std::int64_t to_ns(const ros::Time& time) { return static_cast<std::int64_t>(time.toNSec()); }

/// Nanoseconds as the stamp of a message.
inline ros::Time stamp_of(std::int64_t time_ns) {
  return ros::Time(static_cast<std::uint32_t>(time_ns / kSecondNs), static_cast<std::uint32_t>(time_ns % kSecondNs));
}

/// Monotonic wall time in s.
inline double wall_seconds() { return ros::SteadyTime::now().toSec(); }

/// If the two readings are farther apart than this, a clock step in between is not detectable, and they are repeated.
inline constexpr std::int64_t kReadingApartNs = 2 * kMillisecondNs;
inline constexpr int kReadings = 5;

/// Both clocks of the machine at one instant.
inline Instant read_clocks() {
  Instant now{};
  std::int64_t apart_ns = kReadingApartNs;
  for (int reading = 0; reading < kReadings && apart_ns >= kReadingApartNs; ++reading) {
    const std::int64_t before_ns = boot_time_ns();
    now = {0, to_ns(ros::Time::now())};
    now.time_ns = boot_time_ns();
    apart_ns = now.time_ns - before_ns;
  }
  return now;
}

/// The StampClock of the process, for the single thread of its callbacks.
inline StampClock& stamp_clock() {
  static StampClock clock;
  return clock;
}

/// Returns the time of the stamp of a message that arrives now, on the clock of Clock::now, unaffected by clock steps.
/// A stamp far in the future returns kNeverNs.
/// @param usual_age_ns see StampClock::time_of
inline std::int64_t time_of(const ros::Time& stamp, std::int64_t& usual_age_ns) {
  if (is_simulated()) {
    return to_ns(stamp);
  }
  const Instant now = read_clocks();
  const std::int64_t time_ns = stamp_clock().time_of(to_ns(stamp), now, usual_age_ns);
  return steady_time_of(time_ns, {now.time_ns, now.time_ns});
}

/// Runs the callbacks of the global queue, blocking at most max_wall_s for the first one. Returns false on shutdown,
/// and when the time of a node that was asked to leave is over.
inline bool run_callbacks(double max_wall_s) {
  ros::getGlobalCallbackQueue()->callAvailable(ros::WallDuration(std::min(max_wall_s, kShutdownCheckS)));
  return ros::ok() && !must_leave();
}

/// Waiting of inputs in lock-step; nothing otherwise. Tests that silence many producers reduce the wait.
inline std::optional<Waiting> lockstep_waiting() {
  if (!is_lockstep()) {
    return std::nullopt;
  }
  return Waiting{run_callbacks, wall_seconds, ros::param::param("/lockstep_patience_s", kProducerLostAfterWallS)};
}

/// The clocks of a single-threaded node.
///
/// It subscribes to /clock itself, on the global callback queue. ros::Time is set by another thread, and
/// ros::Time::sleepUntil polls it, which would cost 1 ms per tick.
class Clock {
 public:
  explicit Clock(ros::NodeHandle& node) {
    if (is_simulated()) {
      subscriber_ = node.subscribe<rosgraph_msgs::Clock>(
          "/clock", 1, [this](const rosgraph_msgs::Clock::ConstPtr& message) { simulated_ns_ = to_ns(message->clock); },
          ros::VoidConstPtr(), ros::TransportHints().tcpNoDelay());
    }
  }
  Clock(const Clock&) = delete;
  Clock& operator=(const Clock&) = delete;

  /// Returns the present on both clocks; in lock-step not before the start of the simulated clock.
  Instant now() const {
    if (!is_simulated()) {
      return {boot_time_ns(), to_ns(ros::Time::now())};
    }
    const std::int64_t simulated_ns = is_lockstep() ? std::max(simulated_ns_, kSimulationStartNs) : simulated_ns_;
    return {simulated_ns, simulated_ns};
  }

  /// Runs callbacks until the given time of the steady clock, so that a step of the ROS clock does not prolong the
  /// wait. Returns false on shutdown.
  bool wait_until(std::int64_t time_ns) {
    const auto remaining_s = [&] {
      const double left_s = static_cast<double>(time_ns - now().time_ns) * 1e-9;
      return is_simulated() && left_s > 0.0 ? kShutdownCheckS : left_s;
    };
    double remaining = remaining_s();
    while (remaining > 0.0 && run_callbacks(remaining)) {
      remaining = remaining_s();
    }
    return ros::ok() && !must_leave();
  }

 private:
  ros::Subscriber subscriber_;
  std::int64_t simulated_ns_ = 0;
};

}  // namespace mtr_core
