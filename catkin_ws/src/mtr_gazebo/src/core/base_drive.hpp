/// @file
/// The base's own controller: limits of a velocity command, and how fast the wheels of each side turn for it.
// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace mtr_gazebo {

/// Of a diff_drive_controller. What the base believes of its wheels need not be true.
struct BaseFigures {
  double max_linear_mps{0.0};
  double max_angular_radps{0.0};
  double max_linear_mps2{0.0};
  double max_angular_radps2{0.0};
  double command_timeout_s{0.0};
  double believed_radius_m{1.0};
  double believed_half_track_m{1.0};
};

/// Speed of the wheels of each side, in rad/s.
struct WheelSpeeds {
  double left_radps{0.0};
  double right_radps{0.0};
};

/// Follows the last velocity command within its limits, and stops when none comes any more.
class BaseDrive {
 public:
  explicit BaseDrive(const BaseFigures& figures);

  /// A new command in m/s and rad/s; one that is not finite is ignored.
  void command(double linear_mps, double angular_radps);

  /// Wheel speeds for the next step.
  WheelSpeeds step(double step_s);

 private:
  BaseFigures figures_;
  double wanted_linear_{0.0};
  double wanted_angular_{0.0};
  double silent_s_;
  double linear_{0.0};
  double angular_{0.0};
};

}  // namespace mtr_gazebo
