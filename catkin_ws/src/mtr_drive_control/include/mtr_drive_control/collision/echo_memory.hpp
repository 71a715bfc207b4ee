/// @file
/// Surfaces that were seen and have not been seen to go: a missing echo alone is no free space.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "mtr_drive_control/collision/echoes.hpp"
#include "mtr_drive_control/collision/empty_beams.hpp"
#include "mtr_drive_control/collision/view.hpp"

namespace mtr_drive_control {

/// A surface whose direction returns nothing although it was not seen to go.
struct MissingEcho {
  /// In odom.
  Point point;
  std::int64_t seen_ns;
  bool is_wide;
};

/// A LiDAR whose sweep is compared with the memory.
struct Witness {
  std::size_t index;
  /// To each side: what it answers for.
  double own_view_rad;
};

/// Remembers the echoes of both LiDARs in odom until a sweep proves that their surface has gone.
///
/// Proof is an echo from behind the place, or a new place within a step of the old one: a person who walks, a car that
/// drives. A beam that returns nothing proves nothing. It may as well be covered, dazzled or too near its target, so
/// the surface stays where it was. A rest ends that: whoever then lets the robot go on has looked.
class EchoMemory {
 public:
  /// Compares what is remembered with a sweep of a LiDAR, then adds the sweep's echoes.
  /// @return beams that returned nothing from where something is remembered
  EmptyBeams observe(const View& view, const Witness& lidar, const std::vector<Echo>& echoes);

  /// Surfaces that count as obstacles although the newest sweeps do not show them.
  std::vector<MissingEcho> missing() const;

  /// Nothing has wanted to move the robot for this time more.
  void rest(std::int64_t duration_ns) { rest_ns_ += duration_ns; }

  /// The odometry began again: the robot is where it was, under another pose.
  void move(const Pose& before, const Pose& now);

 private:
  struct Remembered {
    Echo echo;
    std::size_t lidar;
    /// Its surface has been seen since then.
    std::int64_t since_ns;
    /// Of the resting clock, when it was seen.
    std::int64_t rest_ns;
    /// Time of the first sweep that returned nothing from there.
    std::optional<std::int64_t> missing_ns;
  };
  bool survives(Remembered& remembered, const View& view, const Witness& lidar, const std::vector<Echo>& echoes);
  bool is_explained(const Remembered& remembered, double range_m, const std::vector<Echo>& echoes) const;
  /// True when an echo that counts came from this direction.
  bool counts(std::size_t beam) const;
  /// Gives the age of a surface to the echoes from its direction; false when there are none.
  bool hands_on(const Remembered& remembered, std::size_t beam);

  std::vector<Remembered> remembered_;
  /// By beam of the sweep that is compared: since when the surface of its echo has been seen; nothing without an echo.
  std::vector<std::optional<std::int64_t>> since_ns_;
  EmptyBeams empty_;
  std::int64_t rest_ns_ = 0;
};

}  // namespace mtr_drive_control
