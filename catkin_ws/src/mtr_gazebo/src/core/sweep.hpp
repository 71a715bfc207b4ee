/// @file
/// A LiDAR that turns: which beam is due when, and what it says of a true distance.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>

namespace mtr_gazebo {

/// Of one LiDAR; the field of view is centred on its x axis.
struct SweepFigures {
  int beams{2};
  double field_of_view_rad{1.0};
  std::int64_t rotation_ns{1};
  double range_min_m{0.0};
  double range_max_m{1.0};
};

/// One beam of the present turn.
struct Beam {
  int index{0};
  double angle_rad{0.0};
  std::int64_t time_ns{0};
};

/// Goes from beam to beam as time passes; each has an instant of its own.
class Sweep {
 public:
  using Cast = std::function<void(const Beam&)>;
  using Finish = std::function<void(std::int64_t start_ns)>;

  /// The first turn begins at start_ns.
  Sweep(const SweepFigures& figures, std::int64_t start_ns);

  /// Casts all beams that are due by now, and finishes each turn that is over with the time of its first beam.
  void advance(std::int64_t now_ns, const Cast& cast, const Finish& finish);

  /// Angle between two beams.
  [[nodiscard]] double angle_increment_rad() const;

  /// Time between two beams.
  [[nodiscard]] double time_increment_s() const;

 private:
  [[nodiscard]] Beam beam() const;

  SweepFigures figures_;
  std::int64_t start_ns_;
  int next_{0};
};

/// What a LiDAR says: infinity beyond its range, minus infinity nearer than it sees (REP-117). A distance of infinity
/// is nothing that a beam meets.
float range_reading(double distance_m, double error_m, const SweepFigures& figures);

}  // namespace mtr_gazebo
