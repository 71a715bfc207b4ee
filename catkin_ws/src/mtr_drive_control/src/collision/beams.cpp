/// @file
/// Tables by beam, computed once per sweep.
// SPDX-License-Identifier: Apache-2.0
#include "mtr_drive_control/collision/beams.hpp"

#include <cmath>

namespace mtr_drive_control {

void BeamDirections::follow(const Sweep& sweep) {
  if (directions_.size() == sweep.ranges_m.size() && angle_min_rad_ == sweep.angle_min_rad &&
      angle_increment_rad_ == sweep.angle_increment_rad) {
    return;
  }
  angle_min_rad_ = sweep.angle_min_rad;
  angle_increment_rad_ = sweep.angle_increment_rad;
  directions_.clear();
  for (std::size_t beam = 0; beam < sweep.ranges_m.size(); ++beam) {
    const double angle_rad = mount_.yaw_rad + sweep.angle_of(beam);
    directions_.push_back({std::cos(angle_rad), std::sin(angle_rad)});
  }
}

BeamPoses::BeamPoses(const Sweep& sweep, const Motion& motion) {
  const double beams = static_cast<double>(sweep.ranges_m.size());
  middle_ = motion.at(sweep.time_ns(0.5 * beams));
  if (sweep.time_increment_s == 0.0 || motion.velocity.is_zero()) {
    poses_.push_back(middle_);
    return;
  }
  poses_.reserve(sweep.ranges_m.size());
  for (std::size_t beam = 0; beam < sweep.ranges_m.size(); ++beam) {
    poses_.push_back(motion.at(sweep.time_ns(static_cast<double>(beam))));
  }
}

}  // namespace mtr_drive_control
