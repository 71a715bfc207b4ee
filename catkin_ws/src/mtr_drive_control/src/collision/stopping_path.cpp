/// @file
/// Path of a uniform stop along a circle.
// SPDX-License-Identifier: Apache-2.0
#include "mtr_drive_control/collision/stopping_path.hpp"

namespace mtr_drive_control {

std::vector<PathPoint> stopping_path(const Velocity& velocity, const Deceleration& deceleration, double reaction_s,
                                     double radius_m) {
  const double braking_s = std::max(std::abs(velocity.linear_mps) / deceleration.linear_mps2,
                                    std::abs(velocity.angular_radps) / deceleration.angular_radps2);
  // Time for the same path at the full velocity.
  const double way_s = reaction_s + braking_s / 2.0;
  const double corner_mps = std::abs(velocity.linear_mps) + std::abs(velocity.angular_radps) * radius_m;
  const int steps = std::max(1, static_cast<int>(std::ceil(corner_mps * way_s / kPathStepM)));
  std::vector<PathPoint> path;
  path.reserve(static_cast<std::size_t>(steps) + 1);
  for (int step = 0; step <= steps; ++step) {
    const double at_full_s = way_s * step / steps;
    const double braked_s = std::max(0.0, at_full_s - reaction_s);
    const double time_s =
        braked_s == 0.0 ? at_full_s
                        : reaction_s + braking_s * (1.0 - std::sqrt(std::max(0.0, 1.0 - 2.0 * braked_s / braking_s)));
    path.push_back({Pose().after(velocity, at_full_s), time_s});
  }
  return path;
}

}  // namespace mtr_drive_control
