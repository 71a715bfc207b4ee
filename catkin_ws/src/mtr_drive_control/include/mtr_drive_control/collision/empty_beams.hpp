/// @file
/// Beams without an echo from a known surface: the LiDAR is covered, dirty or dazzled.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "mtr_drive_control/collision/sector.hpp"
#include "mtr_drive_control/collision/view.hpp"

namespace mtr_drive_control {

/// Beams of one sweep that contradict known surfaces.
class EmptyBeams {
 public:
  /// @param bearing of the surface that the sweep does not show
  void add(const Bearing& bearing) { bearings_.push_back(bearing); }

  /// Returns the widest contiguous sector without an echo, if it is wider than a leg.
  std::optional<Sector> widest(const View& view) const;

  /// Range of the nearest surface; infinite without one.
  double nearest_m() const;

 private:
  std::vector<Bearing> bearings_;
};

/// Sector of one LiDAR that contradicts known surfaces for longer than a flicker.
class EmptySector {
 public:
  /// Evaluates the next sweep.
  void update(const EmptyBeams& empty, const View& view);

  const std::optional<Sector>& confirmed() const { return confirmed_; }

  /// Returns true if each sweep since this time has contradicted known surfaces.
  bool has_lasted_since(std::int64_t time_ns) const { return since_ns_ && *since_ns_ <= time_ns; }

 private:
  std::optional<std::int64_t> since_ns_;
  std::optional<Sector> confirmed_;
};

}  // namespace mtr_drive_control
