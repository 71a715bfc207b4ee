/// @file
/// Controller of the base: limits of velocity commands, and the resulting wheel speeds of each side.
// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace mtr_gazebo {

/// Parameters of a diff_drive_controller. The believed wheel geometry may differ from the true one.
struct BaseFigures {
  double max_linear_mps{0.0};
  double max_angular_radps{0.0};
  double max_linear_mps2{0.0};
  double max_angular_radps2{0.0};
  double command_timeout_s{0.0};
  double believed_radius_m{1.0};
  double believed_half_track_m{1.0};
};

/// Wheel speeds of each side, in rad/s.
struct WheelSpeeds {
  double left_radps{0.0};
  double right_radps{0.0};
};

/// Follows the last velocity command within its limits, and stops after a command time-out.
class BaseDrive {
 public:
  explicit BaseDrive(const BaseFigures& figures);

  /// Sets a new command in m/s and rad/s; a command that is not finite is ignored.
  void command(double linear_mps, double angular_radps);

  /// Returns the wheel speeds for the next step.
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
