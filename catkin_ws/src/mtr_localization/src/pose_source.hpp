/// @file
/// Where poses come from: inputs go in as they arrive, estimates come out in the order of their stamps.
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

/// Pose of base_link in map. One estimate per wheel sample, as soon as IMU data reaches the sample's stamp; the order
/// in which the two arrive does not matter. How a step is made of a sample is what the classes below this one differ
/// in.
class PoseSource {
 public:
  virtual ~PoseSource() = default;
  PoseSource(const PoseSource&) = delete;
  PoseSource& operator=(const PoseSource&) = delete;

  std::vector<Estimate> add_imu(const ImuSample& sample);
  std::vector<Estimate> add_wheels(const WheelSample& sample);
  /// To be called at every step of the clock: invalid estimates while a sensor is silent, none otherwise.
  std::vector<Estimate> check_silence(std::int64_t now_ns);

  /// One sentence when the scan is refused, else empty.
  std::string add_scan(Sweep sweep) { return scans_.add(std::move(sweep)); }
  /// On the robot's own clock: uses scans as soon as wheels and gyro reach their end; true when there were any.
  bool use_scans();
  /// False: it is refused.
  virtual bool add_fix(const GnssFix& fix) = 0;
  void add_order(const MapOrder& order) { mapper_.add_order(order); }

  /// Answer to an order to freeze the map, each once.
  std::optional<MapResult> take_map() { return mapper_.take_result(); }
  const std::vector<KeyFrame>& key_frames() const { return mapper_.key_frames(); }
  /// Surfaces of the map that is tracked.
  virtual const std::vector<Surfel>& surfels() const = 0;

  /// The pose at the newest wheel sample, also as a scan between two samples has corrected it; not said to be valid.
  Estimate newest() const { return pose_at(history().newest().stamp_ns); }
  /// The transform from map to odom and the grid /map are this source's to publish.
  virtual bool owns_map_frame() const = 0;

  MotionState motion_state() const { return odometry_.state(); }
  int scans_used() const { return scans_.used(); }
  virtual PoseFigures figures() const;

 protected:
  /// @param adjust makes a map of key frames
  PoseSource(const Parameters& parameters, Mapper::Adjust adjust);

  /// Goes on to a sample that can be used; the estimate there.
  virtual Estimate step(const GatedSample& sample) = 0;
  /// Uses the scans that are due; true when there were any.
  virtual bool correct_by_scans() = 0;
  /// The newest pose, not yet said to be valid.
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

  /// What all estimates have in common.
  Estimate estimate_of(std::int64_t stamp_ns, const PoseVector& pose, const Eigen::Matrix3d& covariance) const;
  /// The step's answer; valid unless there is a problem, or the pose is no number.
  Estimate answer(std::int64_t stamp_ns, const mtr_core::Problem& problem) const;

 private:
  std::vector<Estimate> process();
  Estimate invalid(std::int64_t stamp_ns, const mtr_core::Problem& problem) const;

  Parameters parameters_;
  InputGate gate_;
  Odometry odometry_;
  ScanQueue scans_;
  Mapper mapper_;
};

}  // namespace mtr_localization
