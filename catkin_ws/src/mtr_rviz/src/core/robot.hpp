/// @file
/// What was heard of the robot, in plain types: what the panel shows is made of it.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <limits>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace mtr_rviz {

/// High-level state, by the state machine.
enum class Mode { kUnknown, kStarting, kReadyToMapCar, kMappingCar, kFollowingWaypoint, kFault, kCheckingCar };

/// The newest message of a topic; at_s is its arrival on a clock that nobody sets, NaN before the first.
template <typename T>
struct Heard {
  T said{};
  double at_s = std::numeric_limits<double>::quiet_NaN();
};

/// Of RobotMode.
struct ModeSaid {
  Mode mode = Mode::kUnknown;
  /// It stands until the Operator has it go on.
  bool is_held = false;
  std::string message;
};

/// Of LocalizedPose.
struct PoseSaid {
  bool is_valid = false;
  /// 1 sigma in the worst direction.
  double sigma_m = 0.0;
  std::string message;
};

/// Of CarEstimate.
struct CarSaid {
  enum class State { kUnknown, kCollecting, kLocated, kFailed };
  State state = State::kUnknown;
  double length_m = 0.0;
  double width_m = 0.0;
  std::string message;
};

/// Of CarCheck.
struct SelfCheckSaid {
  enum class State { kNone, kRunning, kPassed, kFailed };
  State state = State::kNone;
  double difference_m = std::numeric_limits<double>::quiet_NaN();
  double limit_m = 0.0;
  std::string message;
};

/// Of MotionStatus.
struct MotionSaid {
  enum class Result { kIdle, kPending, kReached, kRefused, kBlocked };
  Result result = Result::kIdle;
  double remaining_m = 0.0;
  std::string message;
};

/// Of DriveStatus.
struct DriveSaid {
  enum class Zone { kClear, kSlowed, kBlocked, kBlind };
  std::string source;
  double linear_mps = 0.0;
  Zone zone = Zone::kClear;
  /// From the footprint to what hinders the motion; NaN: nothing does.
  double obstacle_m = std::numeric_limits<double>::quiet_NaN();
  std::string message;
};

/// Of MotionLock.
struct LockSaid {
  bool is_engaged = false;
  std::string reason;
};

/// Of PeripheralsState.
struct PartsSaid {
  bool is_alive = false;
  double key_height_m = 0.0;
  /// 0 to 1, NaN while unknown.
  double battery = std::numeric_limits<double>::quiet_NaN();
  std::string message;
};

/// What the ROS master keeps of the last preflight; age_s was right when the master was asked.
struct Preflight {
  int checks = 0;
  int bad = 0;
  double age_s = 0.0;
  std::string first_bad;
};

/// Everything that was heard.
struct Robot {
  Heard<ModeSaid> mode;
  Heard<PoseSaid> pose;
  Heard<CarSaid> car;
  Heard<SelfCheckSaid> self_check;
  Heard<MotionSaid> motion;
  Heard<DriveSaid> drive;
  Heard<PartsSaid> parts;
  /// By owner.
  std::map<std::string, Heard<LockSaid>> locks;
  /// None before one was made in this run of the ROS master.
  std::optional<Preflight> preflight;
  /// Sentences of the faults that are injected now; none: the robot was not started for it.
  std::optional<std::vector<std::string>> faults;
};

}  // namespace mtr_rviz
