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
  /// Its last sweeps contradicted the memory.
  bool is_doubted;
};

/// Remembers the echoes of both LiDARs in odom until a sweep proves that their surface has gone.
///
/// Proof is an echo from behind the place, or a new place within a step of the old one: a person who walks, a car that
/// drives. A beam that returns nothing proves nothing. It may as well be covered, dazzled or too near its target, so
/// the surface stays where it was. A sweep that looks through more surfaces than it confirms is from another place: the
/// robot was carried, and all that was remembered is forgotten.
class EchoMemory {
 public:
  /// Compares what is remembered with a sweep of a LiDAR, then adds the sweep's echoes.
  /// @return beams that returned nothing from where something is remembered
  EmptyBeams observe(const View& view, const Witness& lidar, const std::vector<Echo>& echoes);

  /// Surfaces that count as obstacles although the newest sweeps do not show them.
  std::vector<MissingEcho> missing() const;

  /// The robot is at rest, and nothing wants to move it, for this time more.
  void rest(std::int64_t duration_ns) { rest_ns_ += duration_ns; }

  /// The odometry began again: the robot is where it was, under another pose.
  void move(const Pose& before, const Pose& now);

 private:
  struct Remembered {
    Echo echo;
    std::size_t lidar;
    /// Of the resting clock, when it was seen.
    std::int64_t rest_ns;
    /// Time of the first sweep that returned nothing from there.
    std::optional<std::int64_t> missing_ns;
  };
  bool survives(Remembered& remembered, const View& view, const Witness& lidar, const std::vector<Echo>& echoes);
  bool is_explained(const Remembered& remembered, double range_m, const std::vector<Echo>& echoes) const;
  /// True when the sweep that is compared is from another place than the odometry tells.
  bool was_carried() const;
  /// True when an echo that counts came from this direction.
  bool counts(std::size_t beam) const;

  std::vector<Remembered> remembered_;
  /// Of the sweep that is compared, by beam.
  std::vector<bool> counting_;
  EmptyBeams empty_;
  /// Of the same sweep: remembered surfaces that it shows, and that it looks through.
  int confirmed_ = 0;
  int seen_through_ = 0;
  std::int64_t rest_ns_ = 0;
};

}  // namespace mtr_drive_control
