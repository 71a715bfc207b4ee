/// @file
/// Messages to the Operator about a failed map; a contract test reads this table, too.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "mtr_core/problem.hpp"

namespace mtr_surfel_map::problems {

using mtr_core::Sentence;

constexpr Sentence kFewKeyFrames{"surfel_map.few_key_frames",
                                 "Only {count} key-frames were taken, {needed} are needed: drive round the Car."};
constexpr Sentence kNotNumbers{"surfel_map.not_numbers", "A key-frame contains values that are no numbers."};
constexpr Sentence kFewSurfaces{
    "surfel_map.few_surfaces",
    "The LiDARs saw only {count} pieces of surface, {needed} are needed: is the Car in view?"};
constexpr Sentence kNotClosed{
    "surfel_map.not_closed",
    "The way round the Car was not closed: it must end within {limit_m:.1f} m of where it passed before."};
constexpr Sentence kScansDisagree{
    "surfel_map.scans_disagree",
    "What the LiDARs saw from different places disagrees by {ratio:.1f} times its uncertainty."};
constexpr Sentence kOutliers{"surfel_map.outliers",
                             "{percent:.0f} % of what the LiDARs saw does not fit the map: did something large move?"};
constexpr Sentence kMotionDisagrees{"surfel_map.motion_disagrees",
                                    "Wheels and gyro disagree with the LiDARs by {ratio:.1f} times their uncertainty."};
constexpr Sentence kJump{
    "surfel_map.jump",
    "On the way round the LiDARs show a jump of {distance_m:.2f} m and {angle_deg:.1f} degrees that "
    "wheels and gyro exclude: drive round the Car again, slowly and on even ground, and let nobody "
    "push the robot."};

}  // namespace mtr_surfel_map::problems
