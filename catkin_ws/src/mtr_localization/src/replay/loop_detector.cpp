/// @file
/// Full turn and return of the path.
// SPDX-License-Identifier: Apache-2.0
#include "replay/loop_detector.hpp"

#include <cmath>

#include "map_names.hpp"

namespace mtr_localization::replay {
namespace {

// Largest distance of a loop's end from its start: the approach accuracy of the Car locator's places, with a margin.
constexpr double kReturnedM = 0.8;
// Turn of the direction of motion; driving out and back, or round a corner and back, gives less.
constexpr double kTurnedRad = 0.9 * 2.0 * M_PI;

bool is_loop(const std::vector<KeyFrame>& frames, std::size_t last) {
  double turned_rad = 0.0;
  double direction_rad = std::nan("");
  for (std::size_t i = last; i-- > 0;) {
    const Eigen::Vector2d step = (frames[i + 1].pose - frames[i].pose).head<2>();
    if (step.norm() > 0.05) {
      const double direction = std::atan2(step.y(), step.x());
      turned_rad += std::isnan(direction_rad) ? 0.0 : wrapped(direction_rad - direction);
      direction_rad = direction;
    }
    if (std::abs(turned_rad) > kTurnedRad && (frames[last].pose - frames[i].pose).head<2>().norm() < kReturnedM) {
      return true;
    }
  }
  return false;
}

}  // namespace

bool LoopDetector::closes(const std::vector<KeyFrame>& key_frames) {
  for (; seen_ < key_frames.size() && !closed_; ++seen_) {
    closed_ = is_loop(key_frames, seen_);
  }
  return closed_;
}

}  // namespace mtr_localization::replay
