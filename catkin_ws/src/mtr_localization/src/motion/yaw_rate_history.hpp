/// @file
/// Gyro rate over time.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <deque>
#include <optional>

#include "samples.hpp"

namespace mtr_localization {

/// Recent samples of the gyro, oldest first. Implausible samples are received but not stored.
///
/// A sample is the mean rate since the previous one, because gyros filter at their output rate.
class YawRateHistory {
 public:
  /// Adds the next sample; a second sample at the same time is ignored. Returns false if its stamp is before the last
  /// one; the history then restarts with it.
  bool add(const ImuSample& sample);

  /// Stamp of the newest received sample, plausible or not.
  std::optional<std::int64_t> newest_received_ns() const { return newest_received_ns_; }

  /// True if the newest received sample is plausible.
  bool newest_is_good() const;

  /// True if stored samples enclose the time.
  bool covers(std::int64_t time_ns) const;

  /// Returns the sample whose interval contains a covered time.
  const ImuSample& sample_at(std::int64_t time_ns) const;
  /// Returns the rate at a covered time, rad/s.
  double rate_at(std::int64_t time_ns) const { return sample_at(time_ns).yaw_rate_radps; }

  /// Returns the integral of the rate between two covered times, rad.
  double integral(std::int64_t from_ns, std::int64_t to_ns) const;

  /// Returns the longest time without a sample between two covered times, ns.
  std::int64_t max_gap_ns(std::int64_t from_ns, std::int64_t to_ns) const;

  /// Drops samples that are not needed for times from the given one on.
  void forget_before(std::int64_t time_ns);

 private:
  std::deque<ImuSample> samples_;
  std::optional<std::int64_t> newest_received_ns_;
};

}  // namespace mtr_localization
