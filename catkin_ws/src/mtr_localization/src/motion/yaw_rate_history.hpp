/// @file
/// The gyro's rate over time.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <deque>
#include <optional>

#include "samples.hpp"

namespace mtr_localization {

/// Recent samples of the gyro, oldest first. A sample that is not plausible is received but not kept.
///
/// A sample is the mean rate since the one before it: gyros filter at the rate at which they are read.
class YawRateHistory {
 public:
  /// Takes the next sample; a second one of an instant is left out. False: its stamp lies before the last one, and
  /// history begins anew with it.
  bool add(const ImuSample& sample);

  /// Stamp of the newest sample received, good or not.
  std::optional<std::int64_t> newest_received_ns() const { return newest_received_ns_; }

  /// True when the newest sample received is plausible.
  bool newest_is_good() const;

  /// True when samples before, or at, and after, or at, the time are kept.
  bool covers(std::int64_t time_ns) const;

  /// Sample whose time a covered time lies in.
  const ImuSample& sample_at(std::int64_t time_ns) const;
  /// Rate at a covered time, rad/s.
  double rate_at(std::int64_t time_ns) const { return sample_at(time_ns).yaw_rate_radps; }

  /// Integral of the rate between two covered times, rad.
  double integral(std::int64_t from_ns, std::int64_t to_ns) const;

  /// Longest time without a sample between two covered times, ns.
  std::int64_t max_gap_ns(std::int64_t from_ns, std::int64_t to_ns) const;

  /// Drops what is not needed for times from the given one on.
  void forget_before(std::int64_t time_ns);

 private:
  std::deque<ImuSample> samples_;
  std::optional<std::int64_t> newest_received_ns_;
};

}  // namespace mtr_localization
