/// @file
/// Received state of the robot in plain types, as the source of the panel.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <limits>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace mtr_rviz {

/// High-level state from the state machine.
enum class Mode { kUnknown, kStarting, kReadyToMapCar, kMappingCar, kFollowingWaypoint, kFault, kCheckingCar };

/// Newest message of a topic; at_s is its arrival on a steady clock, NaN before the first one.
template <typename T>
struct Heard {
  T said{};
  double at_s = std::numeric_limits<double>::quiet_NaN();
};

/// Contents of RobotMode.
struct ModeSaid {
  Mode mode = Mode::kUnknown;
  /// The robot is on hold until the Operator resumes it.
  bool is_held = false;
  std::string message;
};

/// Contents of LocalizedPose.
struct PoseSaid {
  bool is_valid = false;
  /// 1 sigma in the worst direction.
  double sigma_m = 0.0;
  std::string message;
};

/// Contents of CarEstimate.
struct CarSaid {
  enum class State { kUnknown, kCollecting, kLocated, kFailed };
  State state = State::kUnknown;
  double length_m = 0.0;
  double width_m = 0.0;
  std::string message;
};

/// Contents of CarCheck.
struct SelfCheckSaid {
  enum class State { kNone, kRunning, kPassed, kFailed };
  State state = State::kNone;
  double difference_m = std::numeric_limits<double>::quiet_NaN();
  double limit_m = 0.0;
  std::string message;
};

/// Contents of MotionStatus.
struct MotionSaid {
  enum class Result { kIdle, kPending, kReached, kRefused, kBlocked };
  Result result = Result::kIdle;
  double remaining_m = 0.0;
  std::string message;
};

/// Contents of DriveStatus.
struct DriveSaid {
  enum class Zone { kClear, kSlowed, kBlocked, kBlind };
  std::string source;
  double linear_mps = 0.0;
  Zone zone = Zone::kClear;
  /// Distance from the footprint to the obstacle that limits the motion; NaN without one.
  double obstacle_m = std::numeric_limits<double>::quiet_NaN();
  std::string message;
};

/// Contents of MotionLock.
struct LockSaid {
  bool is_engaged = false;
  std::string reason;
};

/// Contents of PeripheralsState.
struct PartsSaid {
  bool is_alive = false;
  double key_height_m = 0.0;
  /// 0 to 1, NaN while unknown.
  double battery = std::numeric_limits<double>::quiet_NaN();
  std::string message;
};

/// Last preflight stored in the ROS master; age_s is the age at the time of the query.
struct Preflight {
  int checks = 0;
  int bad = 0;
  double age_s = 0.0;
  std::string first_bad;
};

/// All received data.
struct Robot {
  Heard<ModeSaid> mode;
  Heard<PoseSaid> pose;
  Heard<CarSaid> car;
  Heard<SelfCheckSaid> self_check;
  Heard<MotionSaid> motion;
  Heard<DriveSaid> drive;
  Heard<PartsSaid> parts;
  /// Motion locks by owner.
  std::map<std::string, Heard<LockSaid>> locks;
  /// Empty without a preflight in this run of the ROS master.
  std::optional<Preflight> preflight;
  /// Sentences about active faults; empty optional if the robot was started without fault injection.
  std::optional<std::vector<std::string>> faults;
};

}  // namespace mtr_rviz
