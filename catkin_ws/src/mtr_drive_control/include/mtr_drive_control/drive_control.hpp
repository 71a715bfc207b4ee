/// @file
/// Which velocity goes to the wheels at a tick.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "mtr_drive_control/motion_locks.hpp"
#include "mtr_drive_control/parameters.hpp"
#include "mtr_drive_control/velocity_limiter.hpp"

namespace mtr_drive_control {

/// Velocity wanted by one source.
struct SourceCommand {
  std::int64_t stamp_ns;
  Velocity velocity;
  /// False: the source wants nothing, the next one is listened to.
  bool active;
};

/// Everything that is known at a tick.
struct Inputs {
  std::vector<EngagedLock> locks;
  std::optional<SourceCommand> manual;
  std::optional<SourceCommand> planner;
};

/// Velocity to send, and why.
struct Decision {
  Velocity velocity;
  /// none, locked, manual or planner.
  std::string source;
  std::vector<std::string> engaged_locks;
  /// One sentence, empty when all is well.
  std::string message;
};

/// Two stages: choose a source (locks, manual, planner), then limit what it wants.
///
/// A lock or a dead source is an emergency stop; a source that ends its wish is braked for at the normal limit.
class DriveControl {
 public:
  DriveControl(const Parameters& parameters, double period_s);

  /// Decision of this tick, ns of the ROS clock; to be called once per period.
  Decision step(std::int64_t tick_ns, const Inputs& inputs);

 private:
  struct Wish {
    std::string source;
    /// Nothing: emergency stop.
    std::optional<Velocity> velocity;
    std::string message;
  };

  Wish choose(std::int64_t tick_ns, const Inputs& inputs) const;
  Wish wish_of(const std::string& source, const std::optional<SourceCommand>& command, std::int64_t tick_ns) const;

  Parameters parameters_;
  VelocityLimiter limiter_;
};

}  // namespace mtr_drive_control
