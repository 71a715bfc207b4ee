/// @file
/// Messages of localization to the Operator; a contract test reads this table, too.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "mtr_core/problem.hpp"

namespace mtr_localization::problems {

using mtr_core::Sentence;

// Wheels and gyro
constexpr Sentence kStandStill{"localization.stand_still", "Stand still: measuring the gyro's bias."};
constexpr Sentence kWaitingForWheels{"localization.waiting_for_wheels", "Waiting for wheel odometry."};
constexpr Sentence kWheelsSilent{"localization.wheels_silent", "Wheel odometry is silent, or its stamps are old."};
constexpr Sentence kWheelsNotFinite{"localization.wheels_not_finite",
                                    "Wheel odometry shows no numbers, or none that a base drives."};
constexpr Sentence kWheelsWereSilent{"localization.wheels_were_silent", "Wheel odometry was silent for {gap_s:.2f} s."};
constexpr Sentence kWheelsJumped{"localization.wheels_jumped", "Wheel odometry jumped by {distance_m:.2f} m."};
constexpr Sentence kWheelsWentBack{"localization.wheels_went_back", "The time of the wheel odometry went backwards."};
constexpr Sentence kWaitingForImu{"localization.waiting_for_imu", "Waiting for the IMU."};
constexpr Sentence kImuSilent{"localization.imu_silent", "The IMU is silent."};
constexpr Sentence kImuNotANumber{"localization.imu_not_a_number",
                                  "The IMU's readings are no numbers, or none that a robot's motion gives."};
constexpr Sentence kImuWasSilent{"localization.imu_was_silent", "The IMU was silent for {gap_s:.2f} s."};
constexpr Sentence kImuWentBack{"localization.imu_went_back", "The time of the IMU went backwards."};

// The position
constexpr Sentence kLost{"localization.lost", "Position lost: {cause} Map the Car again."};
constexpr Sentence kSearching{"localization.searching",
                              "Position lost: {cause} Drive or turn it by hand until it knows where it is."};
constexpr Sentence kOtherView{"localization.other_view",
                              "Position lost: the LiDAR does not see what the map shows here. Drive or turn it by hand "
                              "until it knows where it is."};
constexpr Sentence kOtherViewWhileMapping{
    "localization.other_view_while_mapping",
    "Position lost: the LiDAR does not see what it saw on the way. Unless it does again, map the Car again."};
constexpr Sentence kOutOfView{"localization.out_of_view",
                              "Position lost: nothing of the map has been in view for too long. Drive or turn it by "
                              "hand until it knows where it is."};
constexpr Sentence kElsewhere{"localization.elsewhere",
                              "Position lost: by satellites the robot is {distance_m:.1f} m from there. Drive or turn "
                              "it by hand until it knows where it is."};
constexpr Sentence kWaitingForOther{"localization.waiting_for_other",
                                    "Waiting for map to odom from the other localization."};
constexpr Sentence kNotANumber{"localization.not_a_number",
                               "Position lost: what localization has computed is no number. Start the robot's "
                               "programs anew."};

constexpr Sentence kDoubted{"localization.doubted",
                            "Position lost: {cause} It is taken up again when the LiDARs see what the map shows here; "
                            "else drive or turn the robot by hand until it knows where it is."};
constexpr Sentence kStartedAnew{"localization.started_anew", "Localization was started anew."};
constexpr Sentence kBlind{"localization.blind", "The LiDARs have been silent, frozen or covered for too long."};

// The map
constexpr Sentence kLostOnTheWay{
    "localization.lost_on_the_way",
    "The position was lost on the way round the Car, and the robot went on; map the Car again."};
constexpr Sentence kMapRefused{"localization.map_refused",
                               "Position lost: there is no map of the Car. {cause} Put the robot at the starting place "
                               "and map again."};
constexpr Sentence kNotAdjusted{"localization.not_adjusted", "Surfaces by poses from elsewhere, not adjusted."};
constexpr Sentence kNoScan{"localization.no_scan", "No scan has been seen."};

}  // namespace mtr_localization::problems
