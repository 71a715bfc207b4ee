/// @file
/// Joins wheel odometry and IMU by their stamps and says how far the resulting pose can be trusted.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "mtr_localization/dead_reckoning.hpp"
#include "mtr_localization/parameters.hpp"
#include "mtr_localization/samples.hpp"
#include "mtr_localization/standstill.hpp"
#include "mtr_localization/yaw_rate_history.hpp"

namespace mtr_localization {

/// How far the pose can be trusted.
///
/// Starting -> tracking: the gyro's bias is known after standstill.
/// Tracking -> interrupted: a gap in the data while the robot stood still; -> tracking after standstill.
/// Tracking or interrupted -> lost: it moved unseen; the pose is frozen for good, for any other would be a guess.
enum class Mode { kStarting, kTracking, kInterrupted, kLost };

/// Pose of base_link in map, which is where the robot started.
///
/// One estimate per wheel sample, as soon as IMU data reaches the sample's stamp; the order in which the two arrive
/// does not matter.
class Localizer {
 public:
  explicit Localizer(const Parameters& parameters);

  std::vector<Estimate> add_imu(const ImuSample& sample);
  std::vector<Estimate> add_wheels(const WheelSample& sample);

  /// To be called at every step of the clock: invalid estimates while a sensor is silent, none otherwise.
  std::vector<Estimate> check_silence(std::int64_t now_ns);

  Mode mode() const { return mode_; }
  const DeadReckoning& reckoning() const { return reckoning_; }

 private:
  std::vector<Estimate> process_pending();
  Estimate process(const WheelSample& wheels);
  void advance(const WheelSample& wheels);
  double rate_for_standstill(double gyro_rate_radps) const;

  std::string interruption_between(const WheelSample& last, const WheelSample& wheels) const;
  void interrupt(const std::string& reason, const WheelSample& wheels);
  void lose(const std::string& reason);

  Estimate estimate_at(std::int64_t stamp_ns) const;
  Estimate refused(std::int64_t stamp_ns, const std::string& message) const;
  std::vector<Estimate> not_older_than_emitted(std::vector<Estimate> estimates);
  std::int64_t gap_limit_ns() const;

  Parameters parameters_;
  DeadReckoning reckoning_;
  StandstillDetector standstill_;
  YawRateHistory gyro_;
  std::deque<WheelSample> pending_;
  std::optional<WheelSample> last_;
  std::optional<std::int64_t> newest_wheels_ns_;
  std::optional<std::int64_t> emitted_ns_;
  std::string restart_;
  Mode mode_ = Mode::kStarting;
  std::string message_;
};

}  // namespace mtr_localization
