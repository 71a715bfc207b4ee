/// @file
/// Selects the velocity for the wheels at a tick.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "mtr_core/problem.hpp"
#include "mtr_drive_control/area/area_guard.hpp"
#include "mtr_drive_control/collision/collision_stop.hpp"
#include "mtr_drive_control/decision.hpp"
#include "mtr_drive_control/motion_locks.hpp"
#include "mtr_drive_control/motion_watch.hpp"
#include "mtr_drive_control/parameters.hpp"
#include "mtr_drive_control/tilt.hpp"
#include "mtr_drive_control/velocity_limiter.hpp"

namespace mtr_drive_control {

/// Owner of drive control's own locks.
inline constexpr char kOwner[] = "drive_control";

/// Desired velocity of one source.
struct SourceCommand {
  std::int64_t stamp_ns;
  Velocity velocity;
  /// False: the source is idle, and the next one is selected.
  bool active;
};

/// Height of the key above ground as measured by the peripherals.
struct KeyHeight {
  std::int64_t stamp_ns;
  double height_m;
};

/// Maximum speed of the Operator's Command, as the state machine publishes it with the goal.
struct SpeedLimit {
  /// mtr_core::kNeverNs before the first one.
  std::int64_t stamp_ns;
  double max_mps;
};

/// All inputs of a tick.
struct Inputs {
  std::vector<EngagedLock> locks;
  /// Age of the oldest message of the owners that are required for motion.
  double locks_age_s = 0.0;
  std::optional<SourceCommand> manual;
  std::optional<SourceCommand> planner;
  Sensors sensors;
  std::optional<KeyHeight> key;
  /// Without a reading the tilt is unknown and the robot is stopped.
  std::optional<ImuReading> imu = std::nullopt;
  AreaInputs area = {};
  /// Limit of the planner's motion; empty if no state machine takes part. The manual controller has its own limits.
  std::optional<SpeedLimit> speed_limit = std::nullopt;
};

/// Three stages: select a source (locks, manual, planner), reduce its velocity to a safe one, limit the change.
///
/// A lock, a dead source, blindness or a sudden obstacle is an emergency stop; an idle source is braked at the normal
/// limit. From every velocity that is sent, an emergency stop ends before a collision, and within kStandstillWithinS of
/// the oldest message it relies on. A late message therefore slows the robot before its sender counts as dead.
///
/// On a slope the limits are lower. From tilt_stop_rad on, or while the tilt is unknown, the robot stops as for an
/// obstacle, see tilt.hpp. A person may drive it off slowly.
///
/// A motion that contradicts the commands, see motion_watch.hpp, is a lock of its own. It is released after some time
/// without a motion request.
///
/// The sent velocity starts from the wheels' motion and stays close to it: after a pause without ticks (a stopped or
/// starved process) from their measured velocity, or from standstill if that is unknown. A late tick brakes for the
/// whole time. After two consecutive late ticks the next one is expected equally late, and the sent velocity is safe
/// for that time.
class DriveControl {
 public:
  DriveControl(const Parameters& parameters, const CollisionParameters& collision, const RobotShape& shape,
               double period_s, const AreaParameters& area = {});

  /// Decides at this tick, ns of a clock that is never set; must be called once per period.
  Decision step(std::int64_t tick_ns, const Inputs& inputs);

  /// For display: the outline, and its path for a stop now at the normal limit.
  const Footprint& footprint() const { return collision_stop_.footprint(); }
  std::vector<PathPoint> stopping_path_of(const Velocity& velocity) const;

 private:
  /// Selected source, and its desired velocity.
  struct Selection {
    std::string source;
    /// Empty: emergency stop.
    std::optional<Velocity> velocity;
    mtr_core::Problem message;
  };

  /// Records the time since the previous step, and the expected delay of the next one.
  void time_step(std::int64_t tick_ns);
  Sensors with_gyro(std::int64_t tick_ns, const Inputs& inputs) const;
  void follow_wheels(std::int64_t tick_ns, const std::optional<Motion>& motion);
  /// Locks of other owners, and of drive control itself.
  std::vector<EngagedLock> locks_at(std::int64_t tick_ns, const Inputs& inputs);
  mtr_core::Problem contradiction_at(std::int64_t tick_ns, const Inputs& inputs);
  void watch_tilt(std::int64_t tick_ns, const Inputs& inputs);
  /// Returns false if the tilt forbids the motion, with the reason in the decision.
  bool permits_tilt(const Selection& selection, Decision& decision) const;
  Selection wanted_at(std::int64_t tick_ns, const Inputs& inputs) const;
  Selection selection_of(const std::string& source, const std::optional<SourceCommand>& command,
                         std::int64_t tick_ns) const;
  /// Limits the planner's command to the Command's speed; a missing or silent limit forbids motion.
  Selection limited(Selection selection, const std::optional<SpeedLimit>& limit, std::int64_t tick_ns) const;
  void adapt_limits(std::int64_t tick_ns, const std::optional<KeyHeight>& key);
  Deceleration normal_deceleration() const;
  double oldest_word_s(std::int64_t tick_ns, const Inputs& inputs, const std::string& source) const;
  /// Returns true for a current message of odometry or IMU.
  bool is_heard(std::int64_t stamp_ns, std::int64_t tick_ns) const;
  bool is_in_time(const Velocity& velocity, double oldest_word_s) const;
  /// Reduces a motion that the collision stop permits such that the robot stays in the test area.
  Velocity keep_in_area(const DesiredMotion& desired, Decision& decision) const;
  StopPath stop_path(const Deceleration& deceleration) const;
  Velocity pursue(std::int64_t tick_ns, const Inputs& inputs, const Selection& selection, Decision& decision);

  Parameters parameters_;
  double period_s_;
  double odometry_timeout_s_;
  Limits limits_;
  CollisionStop collision_stop_;
  AreaGuard area_guard_;
  VelocityLimiter limiter_;
  std::optional<std::int64_t> stepped_ns_;
  double step_s_;
  /// Time until the next step.
  double expected_step_s_;
  MotionWatch watch_;
  TiltWatch tilt_;
  mtr_core::Problem contradiction_;
  Duration rest_;
};

}  // namespace mtr_drive_control
