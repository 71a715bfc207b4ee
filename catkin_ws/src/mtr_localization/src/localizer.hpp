/// @file
/// Localization of the robot itself: one filter for wheels, gyro, scans and satellites, with a map that it builds.
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

/// The origin of map is the start of the robot until a map is adjusted; then its first key frame keeps its pose.
class Localizer : public PoseSource {
 public:
  explicit Localizer(const Parameters& parameters);

  /// Resumes with a previous map; must be called before the first sample. Poses are not valid until the LiDARs see the
  /// expected view near the remembered pose, or the robot was driven to a place with the expected view.
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
  /// Returns the turn of the robot while only the wheels were silent, rad.
  std::optional<double> turn_of(const GatedSample& sample) const;
  Estimate estimate() const;
  PoseMode mode() const;
  /// True if there is a map and all LiDARs are silent.
  bool is_blind() const;
  /// True if a map has been without a scan for too long, so the pose is dead reckoning; the first scan starts it.
  bool has_seen_nothing() const;

  ScanTracker tracker_;
  GnssMonitor gnss_;
  /// Previous map, until it is resumed.
  std::optional<Memory> memory_;
  std::int64_t last_scan_ns_ = 0;
};

}  // namespace mtr_localization
