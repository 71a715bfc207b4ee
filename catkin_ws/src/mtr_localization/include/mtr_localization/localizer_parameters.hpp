/// @file
/// Everything that a localizer is started with.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "mtr_localization/parameters.hpp"
#include "mtr_localization/tracking_parameters.hpp"
#include "mtr_surfel_map/adjustment/parameters.hpp"

namespace mtr_localization {

struct LocalizerParameters {
  Parameters motion;
  TrackingParameters tracking;
  mtr_surfel_map::AdjustmentParameters adjustment;
  /// Sweeps, orders and maps take effect at times that follow from their stamps alone: in simulation and offline.
  bool lockstep = false;
  /// The pose comes from elsewhere; scans are collected for the map of surfaces only.
  bool external = false;
};

}  // namespace mtr_localization
