/// @file
/// Which velocity goes to the wheels at a tick.
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

/// Who engages the locks that are drive control's own.
inline constexpr char kOwner[] = "drive_control";

/// Velocity wanted by one source.
struct SourceCommand {
  std::int64_t stamp_ns;
  Velocity velocity;
  /// False: the source wants nothing, the next one is listened to.
  bool active;
};

/// Height of the key above ground as the peripherals measured it.
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

/// Everything that is known at a tick.
struct Inputs {
  std::vector<EngagedLock> locks;
  /// Age of the oldest word of those who must speak to let the robot move.
  double locks_age_s = 0.0;
  std::optional<SourceCommand> manual;
  std::optional<SourceCommand> planner;
  Sensors sensors;
  std::optional<KeyHeight> key;
  /// Without one the tilt is not known and the robot stands.
  std::optional<ImuReading> imu = std::nullopt;
  AreaInputs area = {};
  /// Of the planner's motion; nothing where no state machine takes part. A person with the manual controller has the
  /// limits of that.
  std::optional<SpeedLimit> speed_limit = std::nullopt;
};

/// Three stages: choose a source (locks, manual, planner), reduce what it wants to what is safe, limit its change.
///
/// A lock, a dead source, blindness or a sudden obstacle is an emergency stop; a source that wants no more is braked
/// for at the normal limit. Every velocity that is sent is one from which an emergency stop ends before a collision,
/// and within kStandstillWithinS of the oldest word on which it rests: who is late slows the robot before it counts as
/// dead.
///
/// On a slope the limits are lower, and from tilt_stop_rad on, or while the tilt is not known, the robot stops as for
/// an obstacle, see tilt.hpp. A person may drive it off slowly.
///
/// A motion that contradicts what was sent, see motion_watch.hpp, is a lock of its own: it is released when nobody has
/// wanted to move for a while.
///
/// What is sent begins from what the wheels do and keeps near it: after a pause without ticks (a process that was
/// stopped or starved) from their measured velocity, and from standstill when that is not known. A tick that comes late
/// brakes for the whole time; when two in a row are late the next one is expected as late, and what is sent is safe so
/// long.
class DriveControl {
 public:
  DriveControl(const Parameters& parameters, const CollisionParameters& collision, const RobotShape& shape,
               double period_s, const AreaParameters& area = {});

  /// Decision of this tick, ns of a clock that nobody sets; to be called once per period.
  Decision step(std::int64_t tick_ns, const Inputs& inputs);

  /// For display: the outline, and where it would get when stopped now at the normal limit.
  const Footprint& footprint() const { return collision_stop_.footprint(); }
  std::vector<PathPoint> stopping_path_of(const Velocity& velocity) const;

 private:
  /// The source that is chosen, and what it wants.
  struct Selection {
    std::string source;
    /// Nothing: emergency stop.
    std::optional<Velocity> velocity;
    mtr_core::Problem message;
  };

  /// Notes how long ago the step before was, and how late the next one is expected.
  void time_step(std::int64_t tick_ns);
  Sensors with_gyro(std::int64_t tick_ns, const Inputs& inputs) const;
  void follow_wheels(std::int64_t tick_ns, const std::optional<Motion>& motion);
  /// Locks of others, and its own.
  std::vector<EngagedLock> locks_at(std::int64_t tick_ns, const Inputs& inputs);
  mtr_core::Problem contradiction_at(std::int64_t tick_ns, const Inputs& inputs);
  void watch_tilt(std::int64_t tick_ns, const Inputs& inputs);
  /// False when the tilt forbids the motion, and then the decision says so.
  bool permits_tilt(const Selection& selection, Decision& decision) const;
  Selection wanted_at(std::int64_t tick_ns, const Inputs& inputs) const;
  Selection selection_of(const std::string& source, const std::optional<SourceCommand>& command,
                         std::int64_t tick_ns) const;
  /// The planner's command within the Command's speed; a limit that is missing or silent forbids motion.
  Selection limited(Selection selection, const std::optional<SpeedLimit>& limit, std::int64_t tick_ns) const;
  void adapt_limits(std::int64_t tick_ns, const std::optional<KeyHeight>& key);
  Deceleration normal_deceleration() const;
  double oldest_word_s(std::int64_t tick_ns, const Inputs& inputs, const std::string& source) const;
  /// True for a word of odometry or IMU that tells of the present.
  bool is_heard(std::int64_t stamp_ns, std::int64_t tick_ns) const;
  bool is_in_time(const Velocity& velocity, double oldest_word_s) const;
  /// Reduces a motion that the collision stop allows to one that stays in the test area.
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
  /// Until the next one.
  double expected_step_s_;
  MotionWatch watch_;
  TiltWatch tilt_;
  mtr_core::Problem contradiction_;
  Duration rest_;
};

}  // namespace mtr_drive_control
