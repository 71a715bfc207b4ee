/// @file
/// Processing of samples from arrival to estimate.
// SPDX-License-Identifier: Apache-2.0
#include "pose_source.hpp"

#include <algorithm>
#include <cmath>

#include "problems.hpp"

namespace mtr_localization {
namespace {

// One step of the simulated clock, within which everything with an earlier stamp has arrived; see docs/lock-step.md.
constexpr std::int64_t kLockstepLagNs = 20'000'000;

std::optional<std::int64_t> lag_of(const Parameters& parameters) {
  return parameters.lockstep ? std::optional<std::int64_t>(kLockstepLagNs) : std::nullopt;
}

bool is_finite(const Estimate& estimate) {
  return std::isfinite(estimate.x_m) && std::isfinite(estimate.y_m) && std::isfinite(estimate.heading_rad) &&
         std::all_of(estimate.covariance.begin(), estimate.covariance.end(), [](double v) { return std::isfinite(v); });
}

}  // namespace

PoseSource::PoseSource(const Parameters& parameters, Mapper::Adjust adjust)
    : parameters_(parameters),
      gate_(parameters.sensors.gap_limit_s),
      odometry_(parameters.sensors),
      scans_(lag_of(parameters)),
      mapper_(parameters, std::move(adjust)) {
  check(parameters);
}

std::vector<Estimate> PoseSource::add_imu(const ImuSample& sample) {
  gate_.add_imu(sample);
  return process();
}

std::vector<Estimate> PoseSource::add_wheels(const WheelSample& sample) {
  gate_.add_wheels(sample);
  return process();
}

std::vector<Estimate> PoseSource::process() {
  std::vector<Estimate> estimates;
  while (const std::optional<GatedSample> sample = gate_.next()) {
    if (!sample->problem) {
      // Its time tells one start of localization from another.
      origin_id_ = origin_id_ == 0 ? static_cast<std::uint64_t>(sample->wheels.stamp_ns) : origin_id_;
      estimates.push_back(step(*sample));
      gate_.release(*sample);
    } else {
      estimates.push_back(invalid(sample->wheels.stamp_ns, sample->problem));
    }
  }
  return gate_.in_order(std::move(estimates));
}

std::vector<Estimate> PoseSource::check_silence(std::int64_t now_ns) {
  const mtr_core::Problem silence = gate_.silence(now_ns);
  if (!silence) {
    return {};
  }
  return gate_.in_order({invalid(now_ns, silence)});
}

bool PoseSource::use_scans() { return !parameters_.lockstep && odometry_.has_begun() && correct_by_scans(); }

PoseFigures PoseSource::figures() const {
  PoseFigures figures;
  figures.gyro_bias_radps = filter().gyro_bias_radps();
  figures.gyro_bias_sigma_radps = filter().gyro_bias_sigma_radps();
  figures.wheel_scale = filter().wheel_scale();
  figures.scans_used = scans_.used();
  figures.scans_refused = scans_.refused();
  return figures;
}

Estimate PoseSource::estimate_of(std::int64_t stamp_ns, const PoseVector& pose,
                                 const Eigen::Matrix3d& covariance) const {
  Estimate estimate;
  estimate.stamp_ns = stamp_ns;
  estimate.map_revision = mapper_.revision();
  estimate.origin_id = origin_id_;
  estimate.x_m = pose.x();
  estimate.y_m = pose.y();
  estimate.heading_rad = pose.z();
  Eigen::Map<Eigen::Matrix3d>(estimate.covariance.data()) = covariance;
  Eigen::Map<Eigen::Vector3d>(estimate.odom.data()) = history().newest().odom;
  estimate.wheel_odom = odometry_.wheel_odom();
  return estimate;
}

Estimate PoseSource::invalid(std::int64_t stamp_ns, const mtr_core::Problem& problem) const {
  Estimate estimate = pose_at(stamp_ns);
  estimate.message = problem;
  return estimate;
}

Estimate PoseSource::answer(std::int64_t stamp_ns, const mtr_core::Problem& problem) const {
  Estimate estimate = pose_at(stamp_ns);
  // Never report a non-finite pose as valid.
  estimate.message = problem || is_finite(estimate) ? problem : problems::kNotANumber();
  estimate.valid = !estimate.message;
  estimate.speed_mps = odometry_.speed_mps();
  estimate.yaw_rate_radps = odometry_.yaw_rate_radps();
  return estimate;
}

}  // namespace mtr_localization
