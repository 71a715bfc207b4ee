/// @file
/// Memory of surfaces that were not seen to disappear: a missing echo alone does not prove free space.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "mtr_drive_control/collision/echoes.hpp"
#include "mtr_drive_control/collision/empty_beams.hpp"
#include "mtr_drive_control/collision/view.hpp"

namespace mtr_drive_control {

/// Surface whose direction returns no echo although it was not seen to disappear.
struct MissingEcho {
  /// In odom.
  Point point;
  std::int64_t seen_ns;
  bool is_wide;
};

/// LiDAR whose sweep is compared with the memory.
struct Witness {
  std::size_t index;
  /// Angle to each side for which this LiDAR is responsible.
  double own_view_rad;
};

/// Remembers the echoes of both LiDARs in odom until a sweep proves that their surface has gone.
///
/// Proof is an echo from behind the place, or a new place within a step of the old one: a walking person, a driving
/// car. An empty beam proves nothing. The LiDAR may be covered, dazzled or too close to its target, so the surface is
/// assumed unchanged. A rest ends that, because the person who resumes the robot has checked its surroundings.
class EchoMemory {
 public:
  /// Compares the memory with a sweep of a LiDAR, then adds the sweep's echoes.
  /// @return beams that returned no echo from a remembered surface
  EmptyBeams observe(const View& view, const Witness& lidar, const std::vector<Echo>& echoes);

  /// Surfaces that count as obstacles although the newest sweeps do not show them.
  std::vector<MissingEcho> missing() const;

  /// Adds a time in which no source has requested motion.
  void rest(std::int64_t duration_ns) { rest_ns_ += duration_ns; }

  /// Handles a restart of the odometry: the robot has not moved, but its pose is different.
  void move(const Pose& before, const Pose& now);

 private:
  struct Remembered {
    Echo echo;
    std::size_t lidar;
    /// The surface has been seen since this time.
    std::int64_t since_ns;
    /// Value of the resting clock when it was seen.
    std::int64_t rest_ns;
    /// Time of the first sweep that returned no echo from there.
    std::optional<std::int64_t> missing_ns;
  };
  bool survives(Remembered& remembered, const View& view, const Witness& lidar, const std::vector<Echo>& echoes);
  bool is_explained(const Remembered& remembered, double range_m, const std::vector<Echo>& echoes) const;
  /// Returns true if a counting echo came from this direction.
  bool counts(std::size_t beam) const;
  /// Passes the age of a surface to the echoes from its direction; returns false without echoes.
  bool hands_on(const Remembered& remembered, std::size_t beam);

  std::vector<Remembered> remembered_;
  /// By beam of the compared sweep: time since which the surface of its echo has been seen; empty without an echo.
  std::vector<std::optional<std::int64_t>> since_ns_;
  EmptyBeams empty_;
  std::int64_t rest_ns_ = 0;
};

}  // namespace mtr_drive_control
