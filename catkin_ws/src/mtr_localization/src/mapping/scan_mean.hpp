/// @file
/// Mean of several scans from one place.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "map_names.hpp"

namespace mtr_localization {

/// Averages each beam over several scans of a stationary robot.
class ScanMean {
 public:
  void clear();
  void add(const ScanPoints& scan);
  int scans() const { return scans_; }

  /// Returns the beams with a consistent range in at least half of the scans; the stamp is the one of the last scan.
  ScanPoints mean() const;

 private:
  /// Key of a beam: LiDAR position and beam direction.
  using Beam = std::pair<std::int64_t, std::int64_t>;

  static Beam beam_of(const ScanPoint& point);

  int scans_ = 0;
  std::int64_t stamp_ns_ = 0;
  std::map<Beam, std::vector<ScanPoint>> beams_;
};

}  // namespace mtr_localization
