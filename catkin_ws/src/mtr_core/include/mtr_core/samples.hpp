/// @file
/// Samples of one periodic producer, and the selection of the sample for a consumer's tick. No ROS inside.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>
#include <deque>
#include <functional>
#include <iterator>
#include <optional>
#include <utility>

#include "mtr_core/schedule.hpp"

namespace mtr_core {

/// Functions with which a single-threaded consumer waits for a sample.
struct Waiting {
  /// Runs callbacks (which may call Samples::add), blocking at most the given number of seconds; false on shutdown.
  std::function<bool(double)> run_callbacks;
  /// Monotonic wall time in s.
  std::function<double()> wall_clock;
  /// Wall time after which a silent producer counts as dead. After its return the wait is a share of this
  /// (kLateProducerShare), until it is in time.
  double patience_s = kProducerLostAfterWallS;
};

/// History of stamped samples of one producer; used from one thread, which also runs the callbacks that call add.
template <typename T>
class Samples {
 public:
  /// @param slot the producer's ticks
  /// @param lag_ns a sample is due this long after its stamp; 0 for sensors, which precede the clock
  /// @param waiting set in lock-step, where `at` returns the same sample at any speed of the machine
  explicit Samples(Slot slot, std::int64_t lag_ns = kClockStep.period_ns, std::optional<Waiting> waiting = std::nullopt)
      : slot_(slot), lag_ns_(lag_ns), waiting_(std::move(waiting)) {}

  /// Adds the producer's next sample; one that is not newer than the last replaces the history (a restart).
  void add(std::int64_t stamp_ns, T value) {
    if (!samples_.empty() && stamp_ns <= samples_.back().first) {
      samples_.clear();
    }
    samples_.emplace_back(stamp_ns, std::move(value));
    if (samples_.size() > kKeptSamples) {
      samples_.pop_front();
    }
    lost_ = false;
  }

  /// Returns the sample for a consumer's tick: in lock-step the sample that is due, otherwise the newest.
  std::optional<T> at(std::int64_t tick_ns) {
    if (!waiting_) {
      return samples_.empty() ? std::nullopt : std::optional<T>(samples_.back().second);
    }
    wait_for(slot_.last_at(tick_ns - lag_ns_));
    const auto later =
        std::upper_bound(samples_.begin(), samples_.end(), tick_ns - lag_ns_,
                         [](std::int64_t time_ns, const auto& sample) { return time_ns < sample.first; });
    return later == samples_.begin() ? std::nullopt : std::optional<T>(std::prev(later)->second);
  }

  /// True when consumers no longer wait for the producer.
  bool lost() const { return lost_; }

 private:
  bool arrived(std::int64_t due_ns) const { return !samples_.empty() && samples_.back().first >= due_ns; }

  void wait_for(std::int64_t due_ns) {
    if (due_ns <= kSimulationStartNs) {
      return;
    }
    const double deadline = waiting_->wall_clock() + waiting_->patience_s * (late_ ? kLateProducerShare : 1.0);
    while (!lost_ && !arrived(due_ns)) {
      const double remaining = deadline - waiting_->wall_clock();
      if (remaining <= 0.0) {
        lost_ = true;
      } else if (!waiting_->run_callbacks(remaining)) {
        return;
      }
    }
    late_ = !arrived(due_ns);
  }

  Slot slot_;
  std::int64_t lag_ns_;
  std::optional<Waiting> waiting_;
  std::deque<std::pair<std::int64_t, T>> samples_;
  bool lost_ = false;
  bool late_ = false;
};

}  // namespace mtr_core
