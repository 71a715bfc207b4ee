/// @file
/// Localization of the project's own: wheels, gyro, scans and satellites in one filter, on a map that it makes itself.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "gnss/gnss_monitor.hpp"
#include "memory.hpp"
#include "pose_source.hpp"
#include "tracking/tracker.hpp"

namespace mtr_localization {

/// Map is where the robot started, until a map is frozen: then its first key frame stays in place.
class Localizer : public PoseSource {
 public:
  explicit Localizer(const Parameters& parameters);

  /// To be called before the first sample: a map of before is the one that poses are in. They are not valid until the
  /// LiDARs see near the remembered pose what the map shows there, or the robot has been driven to where they do.
  void go_on(Memory memory);

  bool add_fix(const GnssFix& fix) override { return gnss_.add(fix); }
  const std::vector<Surfel>& surfels() const override { return tracker_.surfaces().surfels(); }
  bool owns_map_frame() const override { return true; }
  PoseFigures figures() const override;
  using PoseSource::filter;

 protected:
  Estimate step(const GatedSample& sample) override;
  bool correct_by_scans() override;
  Estimate pose_at(std::int64_t stamp_ns) const override;

 private:
  void correct(std::size_t step, const ScanPoints& scan);
  void relocalize(const ScanSet& set, const ScanPoints& scan);
  void map(std::size_t step, const ScanPoints& scan);
  void correct_by_satellites();
  void doubt_blind_pose();
  void begin_map();
  void take_up(const Memory& memory);
  void enter(const AdjustedMap& map);
  void leave(const AdjustedMap& refused);
  void bridge(const RememberedPose& before, const PoseVector& odom_before, const GatedSample& sample,
              const mtr_core::Problem& loss);
  /// How the robot turned while the wheels alone were silent, rad.
  std::optional<double> turn_of(const GatedSample& sample) const;
  Estimate estimate() const;
  PoseMode mode() const;
  /// There is a map, and no LiDAR says anything.
  bool is_blind() const;
  /// A map began so long ago without a scan that the pose is dead reckoning; the map begins with the first scan.
  bool has_seen_nothing() const;

  ScanTracker tracker_;
  GnssMonitor gnss_;
  /// Until it is taken up.
  std::optional<Memory> memory_;
  std::int64_t last_scan_ns_ = 0;
};

}  // namespace mtr_localization
