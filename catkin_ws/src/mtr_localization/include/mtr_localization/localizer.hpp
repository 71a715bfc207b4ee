/// @file
/// Joins wheels, gyro, scans and orders by their stamps and says how far the resulting pose can be trusted.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "mtr_localization/filter_history.hpp"
#include "mtr_localization/ground_level.hpp"
#include "mtr_localization/localizer_parameters.hpp"
#include "mtr_localization/map_keeper.hpp"
#include "mtr_localization/navsat_watch.hpp"
#include "mtr_localization/samples.hpp"
#include "mtr_localization/standstill.hpp"
#include "mtr_localization/tilt_filter.hpp"
#include "mtr_localization/yaw_rate_history.hpp"

namespace mtr_localization {

/// How far wheels and gyro can be trusted.
///
/// Starting -> tracking: the gyro's bias is known after standstill.
/// Tracking -> interrupted: a gap in the data while the robot stood still; -> tracking after standstill.
/// Tracking or interrupted -> lost: it moved unseen. With a map the scans find the pose again; without one it is frozen
/// until the Car is mapped anew, for any other would be a guess.
enum class MotionState { kStarting, kTracking, kInterrupted, kLost };

/// Pose of base_link in map. Map is where the robot started, until a map is frozen: then its first key-frame stays in
/// place.
///
/// One estimate per wheel sample, as soon as IMU data reaches the sample's stamp; the order in which the two arrive
/// does not matter.
class Localizer {
 public:
  explicit Localizer(const LocalizerParameters& parameters);

  std::vector<Estimate> add_imu(const ImuSample& sample);
  std::vector<Estimate> add_wheels(const WheelSample& sample);
  /// False: it is refused, see keeper().sweeps().problem().
  bool add_scan(Sweep sweep) { return keeper_.add_sweep(std::move(sweep)); }
  /// On the robot's own clock: uses scans as soon as wheels and gyro reach their end; true when there were any.
  bool use_scans();
  /// False: it is refused.
  bool add_fix(const NavsatSample& fix) { return navsat_.add(fix); }
  void set_order(const MapOrder& order) { keeper_.add_order(order); }
  /// With localization:=external: where the other source has odom in map, at which time.
  void set_external(std::int64_t stamp_ns, const PoseVector& map_from_odom);

  /// To be called at every step of the clock: invalid estimates while a sensor is silent, none otherwise.
  std::vector<Estimate> check_silence(std::int64_t now_ns);

  /// Answer to an order to freeze the map, each once.
  std::optional<MapResult> take_map() { return keeper_.take_result(); }

  MotionState motion_state() const { return state_; }
  const PoseFilter& filter() const { return history_.newest().filter; }
  /// Pose of odom in map at the newest wheel sample.
  PoseVector map_from_odom() const;
  const MapKeeper& keeper() const { return keeper_; }
  const NavsatFigures& navsat() const { return navsat_.figures(); }

 private:
  std::vector<Estimate> process_pending();
  Estimate process(const WheelSample& wheels);
  double rate_for_standstill(double gyro_rate_radps) const;

  void interrupt(const std::string& reason, const WheelSample& wheels);
  void lose(const std::string& reason);

  Eigen::Vector2d slope_at(const WheelSample& wheels, double duration_s);
  FilterInput input_since_last(const WheelSample& wheels);
  std::string why_not_valid(std::int64_t stamp_ns) const;
  PoseMode mode() const;
  Estimate estimate_at(std::int64_t stamp_ns) const;
  Estimate refused(std::int64_t stamp_ns, const std::string& message) const;
  std::vector<Estimate> not_older_than_emitted(std::vector<Estimate> estimates);
  std::int64_t gap_limit_ns() const;

  LocalizerParameters parameters_;
  FilterHistory history_;
  MapKeeper keeper_;
  NavsatWatch navsat_;
  StandstillDetector standstill_;
  TiltFilter tilt_;
  GroundLevel level_;
  PoseVector leveled_odom_ = PoseVector::Zero();
  YawRateHistory gyro_;
  std::deque<WheelSample> pending_;
  std::optional<WheelSample> last_;
  std::optional<std::int64_t> newest_wheels_ns_;
  std::optional<std::int64_t> emitted_ns_;
  std::string restart_;
  std::optional<std::int64_t> external_ns_;
  PoseVector external_ = PoseVector::Zero();
  MotionState state_ = MotionState::kStarting;
  std::string message_;
};

}  // namespace mtr_localization
