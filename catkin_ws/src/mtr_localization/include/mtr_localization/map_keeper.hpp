/// @file
/// Leads from order to map: what scans are used for, and which map poses are in.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <string>

#include "mtr_localization/localizer_parameters.hpp"
#include "mtr_localization/map_builder.hpp"
#include "mtr_localization/map_names.hpp"
#include "mtr_localization/scan_tracker.hpp"
#include "mtr_localization/sweep_queue.hpp"

namespace mtr_localization {

/// The answer to an order to freeze the map.
struct MapResult {
  /// Robot time from which poses are in this map.
  std::int64_t stamp_ns = 0;
  std::uint64_t map_car_id = 0;
  std::uint32_t revision = 0;
  AdjustedMap map;
  OccupancyGrid grid;
};

/// Joins queue, tracker and builder at each step of the filter.
class MapKeeper {
 public:
  explicit MapKeeper(const LocalizerParameters& parameters);

  bool add_sweep(Sweep sweep) { return sweeps_.add(std::move(sweep)); }
  void add_order(const MapOrder& order) { orders_.push_back(order); }

  /// The filter has come one step farther; true when a new map begins. @param standing the robot stands still
  bool advance(FilterHistory& history, bool standing);

  /// Uses the sweeps that are due; true when the pose was corrected.
  bool use_sweeps(FilterHistory& history, bool standing);

  /// Pose from elsewhere, of odom in map; only with localization:=external.
  void set_external(const PoseVector& map_from_odom) { external_ = map_from_odom; }

  const ScanTracker& tracker() const { return tracker_; }
  const SweepQueue& sweeps() const { return sweeps_; }
  const MapBuilder& builder() const { return builder_; }
  void lose(const std::string& reason) { tracker_.lose(reason); }

  /// The scans do not hold the pose in every direction, or there are none.
  bool degenerate(std::int64_t now_ns) const;
  /// Map that poses are in, 0: none.
  std::uint32_t revision() const { return revision_; }
  /// Added to the filter's covariance: what the growing map has drifted since its beginning.
  Eigen::Matrix3d map_covariance() const;

  /// Newest result, each once.
  std::optional<MapResult> take_result();

 private:
  bool obey(const MapOrder& order, FilterHistory& history);
  void collect(const Look& look, const FilterHistory& history, bool standing);
  void finish(MadeMap made, FilterHistory& history);
  void enter(const AdjustedMap& map, FilterHistory& history);

  LocalizerParameters parameters_;
  SweepQueue sweeps_;
  std::deque<MapOrder> orders_;
  MapBuilder builder_;
  ScanTracker tracker_;
  std::optional<PoseVector> external_;
  std::int64_t looked_ns_ = 0;
  double mapped_travel_m_ = 0.0;
  /// Since the pose was lost; 0 when it is not.
  double lost_travel_m_ = 0.0;
  std::uint32_t newest_revision_ = 0;
  std::uint32_t revision_ = 0;
  std::optional<MapResult> result_;
};

}  // namespace mtr_localization
