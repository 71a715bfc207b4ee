/// @file
/// Pose source for localization:=external: another program publishes the transform from map to odom.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "mtr_core/parameter.hpp"
#include "pose_source.hpp"

namespace mtr_localization {

/// Standard deviations (1 sigma) of the external pose, and the maximum age of map -> odom.
struct ExternalParameters {
  double external_position_sigma_m = 0.05;
  double external_heading_sigma_rad = 0.02;
  double external_timeout_s = 1.0;
};

using ExternalRow = mtr_core::ParameterRow<ExternalParameters>;

/// Range and unit of each parameter.
inline constexpr std::array<ExternalRow, 3> kExternalRows{{
    {"external_position_sigma_m", &ExternalParameters::external_position_sigma_m, 0.001, 10.0, "m"},
    {"external_heading_sigma_rad", &ExternalParameters::external_heading_sigma_rad, 0.0001, 1.0, "rad"},
    {"external_timeout_s", &ExternalParameters::external_timeout_s, 0.05, 60.0, "s"},
}};

/// Pose of odom in map at a time.
struct StampedPose {
  std::int64_t stamp_ns = 0;
  PoseVector pose = PoseVector::Zero();
};

/// Combines the external transform with odometry. Scans are collected at these poses only for a map of surfaces.
class ExternalPose : public PoseSource {
 public:
  /// Returns the newest pose of odom in map, or nothing if it is not published.
  using LookUp = std::function<std::optional<StampedPose>()>;

  ExternalPose(const Parameters& parameters, const ExternalParameters& own, LookUp look_up);

  /// Ignores fixes: satellites are a matter of the other program.
  bool add_fix(const GnssFix&) override { return true; }
  const std::vector<Surfel>& surfels() const override { return no_surfels_; }
  bool owns_map_frame() const override { return false; }

 protected:
  Estimate step(const GatedSample& sample) override;
  bool correct_by_scans() override;
  Estimate pose_at(std::int64_t stamp_ns) const override;

 private:
  void look_up();
  mtr_core::Problem problem_at(std::int64_t stamp_ns) const;

  ExternalParameters own_;
  LookUp look_up_;
  std::optional<StampedPose> map_from_odom_;
  std::vector<Surfel> no_surfels_;
};

}  // namespace mtr_localization
