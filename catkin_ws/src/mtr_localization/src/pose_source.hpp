/// @file
/// Base of pose sources: inputs are added on arrival, estimates are returned in the order of their stamps.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "figures.hpp"
#include "mapping/mapper.hpp"
#include "motion/input_gate.hpp"
#include "motion/odometry.hpp"
#include "parameters.hpp"
#include "samples.hpp"
#include "scans/scan_queue.hpp"

namespace mtr_localization {

/// Estimates the pose of base_link in map, with one estimate per wheel sample as soon as IMU data reaches its stamp.
/// The order of arrival does not matter. Subclasses define how a sample becomes an estimate.
class PoseSource {
 public:
  virtual ~PoseSource() = default;
  PoseSource(const PoseSource&) = delete;
  PoseSource& operator=(const PoseSource&) = delete;

  std::vector<Estimate> add_imu(const ImuSample& sample);
  std::vector<Estimate> add_wheels(const WheelSample& sample);
  /// Must be called at every step of the clock; returns invalid estimates while a sensor is silent, otherwise none.
  std::vector<Estimate> check_silence(std::int64_t now_ns);

  /// Adds a scan. Returns one sentence if it is rejected, otherwise an empty text.
  std::string add_scan(Sweep sweep) { return scans_.add(std::move(sweep)); }
  /// On the robot's own clock: uses scans as soon as wheels and gyro cover them. Returns true if there were any.
  bool use_scans();
  /// Adds a satellite fix; returns false if it is rejected.
  virtual bool add_fix(const GnssFix& fix) = 0;
  void add_order(const MapOrder& order) { mapper_.add_order(order); }

  /// Returns each result of an order to freeze the map once.
  std::optional<MapResult> take_map() { return mapper_.take_result(); }
  const std::vector<KeyFrame>& key_frames() const { return mapper_.key_frames(); }
  /// Surfaces of the tracked map.
  virtual const std::vector<Surfel>& surfels() const = 0;

  /// Pose at the newest wheel sample, including corrections by later scans; without a statement of validity.
  Estimate newest() const { return pose_at(history().newest().stamp_ns); }
  /// True if this source publishes the transform from map to odom, and the grid /map.
  virtual bool owns_map_frame() const = 0;

  MotionState motion_state() const { return odometry_.state(); }
  int scans_used() const { return scans_.used(); }
  virtual PoseFigures figures() const;

 protected:
  /// @param adjust makes a map from key frames
  PoseSource(const Parameters& parameters, Mapper::Adjust adjust);

  /// Processes a usable sample and returns the estimate.
  virtual Estimate step(const GatedSample& sample) = 0;
  /// Uses the scans that are due; returns true if there were any.
  virtual bool correct_by_scans() = 0;
  /// Returns the newest pose, without a statement of validity.
  virtual Estimate pose_at(std::int64_t stamp_ns) const = 0;

  const Parameters& parameters() const { return parameters_; }
  const YawRateHistory& gyro() const { return gate_.gyro(); }
  Odometry& odometry() { return odometry_; }
  const Odometry& odometry() const { return odometry_; }
  FilterHistory& history() { return odometry_.history(); }
  const FilterHistory& history() const { return odometry_.history(); }
  const PoseFilter& filter() const { return odometry_.filter(); }
  ScanQueue& scans() { return scans_; }
  Mapper& mapper() { return mapper_; }
  const Mapper& mapper() const { return mapper_; }

  /// Sets the origin of map; poses of different origins are not comparable.
  void set_origin(std::uint64_t origin_id) { origin_id_ = origin_id; }

  /// Returns an estimate with the fields common to all estimates.
  Estimate estimate_of(std::int64_t stamp_ns, const PoseVector& pose, const Eigen::Matrix3d& covariance) const;
  /// Returns the estimate of a step; valid unless there is a problem or the pose is not finite.
  Estimate answer(std::int64_t stamp_ns, const mtr_core::Problem& problem) const;

 private:
  std::vector<Estimate> process();
  Estimate invalid(std::int64_t stamp_ns, const mtr_core::Problem& problem) const;

  Parameters parameters_;
  std::uint64_t origin_id_ = 0;
  InputGate gate_;
  Odometry odometry_;
  ScanQueue scans_;
  Mapper mapper_;
};

}  // namespace mtr_localization
