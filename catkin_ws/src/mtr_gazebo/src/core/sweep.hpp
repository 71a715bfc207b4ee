/// @file
/// Rotating LiDAR: times of the beams, and readings of true distances.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>

namespace mtr_gazebo {

/// Parameters of one LiDAR; the field of view is centred on its x axis.
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

/// Advances from beam to beam with time; each beam has its own time.
class Sweep {
 public:
  using Cast = std::function<void(const Beam&)>;
  using Finish = std::function<void(std::int64_t start_ns)>;

  /// Starts the first turn at start_ns.
  Sweep(const SweepFigures& figures, std::int64_t start_ns);

  /// Casts all due beams, and calls finish with the time of the first beam for each completed turn.
  void advance(std::int64_t now_ns, const Cast& cast, const Finish& finish);

  /// Returns the angle between two beams.
  [[nodiscard]] double angle_increment_rad() const;

  /// Returns the time between two beams.
  [[nodiscard]] double time_increment_s() const;

 private:
  [[nodiscard]] Beam beam() const;

  SweepFigures figures_;
  std::int64_t start_ns_;
  int next_{0};
};

/// Returns the reading of a LiDAR: infinity beyond its range, minus infinity below it (REP-117). An infinite distance
/// means that the beam does not hit anything.
float range_reading(double distance_m, double error_m, const SweepFigures& figures);

}  // namespace mtr_gazebo
