// SPDX-License-Identifier: Apache-2.0
#include "plugin/imu.hpp"

#include <string>

namespace mtr_gazebo {
namespace {

using ignition::math::Vector3d;

constexpr int kQueue = 50;
constexpr double kSPerNs = 1e-9;

ImuFigures figures_of(const sdf::ElementPtr& element) {
  const auto figure = [&](const char* name) { return value_of<double>(element, name); };
  return {figure("gyro_density"),           figure("gyro_bias_radps"),       figure("gyro_bias_walk"),
          figure("gyro_scale_error"),       figure("accelerometer_density"), figure("accelerometer_bias_mps2"),
          figure("accelerometer_bias_walk")};
}

template <typename Covariance>
void fill_diagonal(Covariance& covariance, double density, double period_s) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    covariance[4 * axis] = density * density / period_s;
  }
}

}  // namespace

Imu::Imu(const sdf::ElementPtr& element, const gazebo::physics::LinkPtr& base, std::uint64_t seed, ros::NodeHandle& ros)
    : slot_(slot_of(element)),
      period_s_(static_cast<double>(slot_.period_ns) * kSPerNs),
      base_from_imu_(pose_of(element)),
      base_(base),
      errors_(figures_of(element), period_s_, seed),
      publisher_(ros.advertise<sensor_msgs::Imu>(value_of<std::string>(element, "topic"), kQueue)) {
  const ImuFigures figures = figures_of(element);
  message_.header.frame_id = value_of<std::string>(element, "frame");
  message_.orientation_covariance[0] = -1.0;
  fill_diagonal(message_.angular_velocity_covariance, figures.gyro_density, period_s_);
  fill_diagonal(message_.linear_acceleration_covariance, figures.accelerometer_density, period_s_);
}

void Imu::update(const Step& step) {
  turned_ += base_->RelativeAngularVel() * (static_cast<double>(step.now_ns - step.before_ns) * kSPerNs);
  if (step.has_tick(slot_)) {
    publish(step.now_ns);
    turned_ = Vector3d::Zero;
    velocity_before_ = velocity();
    since_ns_ = step.now_ns;
  }
}

void Imu::publish(std::int64_t now_ns) {
  if (since_ns_ == 0) {
    return;
  }
  const double period_s = static_cast<double>(now_ns - since_ns_) * kSPerNs;
  const ignition::math::Quaterniond imu_from_base = base_from_imu_.Rot().Inverse();
  const Vector3d rate = imu_from_base.RotateVector(turned_ / period_s);
  const Vector3d acceleration = (velocity() - velocity_before_) / period_s - base_->GetWorld()->Gravity();
  const Vector3d force = imu_from_base.RotateVector(base_->WorldPose().Rot().RotateVectorReverse(acceleration));
  const ImuReading reading = errors_.read({{rate.X(), rate.Y(), rate.Z()}, {force.X(), force.Y(), force.Z()}});
  message_.header.stamp.fromNSec(static_cast<std::uint64_t>(now_ns));
  message_.angular_velocity.x = reading.rate[0];
  message_.angular_velocity.y = reading.rate[1];
  message_.angular_velocity.z = reading.rate[2];
  message_.linear_acceleration.x = reading.force[0];
  message_.linear_acceleration.y = reading.force[1];
  message_.linear_acceleration.z = reading.force[2];
  publisher_.publish(message_);
}

Vector3d Imu::velocity() const { return base_->WorldLinearVel(base_from_imu_.Pos()); }

}  // namespace mtr_gazebo
