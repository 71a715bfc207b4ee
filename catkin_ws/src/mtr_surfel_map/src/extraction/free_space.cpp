/// @file
/// Counts the beams that pass through each surface element.
// SPDX-License-Identifier: Apache-2.0
#include "extraction/free_space.hpp"

#include "mtr_surfel_map/se2.hpp"
#include "mtr_surfel_map/surfel_map.hpp"

namespace mtr_surfel_map {
namespace {

// A beam that ends within this distance behind a surface may have hit it: noise, tilt, or the next surface behind an
// edge.
constexpr double kMarginM = 0.2;
// A surface with more passing beams, as a share of its hits, was not there for the whole drive.
constexpr double kPassingShare = 0.5;

}  // namespace

std::vector<Surfel> without_seen_through(const std::vector<Surfel>& surfels, const std::vector<KeyFrame>& key_frames) {
  const SurfelMap map(surfels);
  std::vector<int> passed(surfels.size(), 0);
  std::vector<int> crossed;
  for (const KeyFrame& frame : key_frames) {
    for (const ScanPoint& point : frame.scan.points) {
      if (point.range_m < kMarginM) {
        continue;
      }
      crossed.clear();
      map.append_crossed(transformed(frame.pose, point.position - point.range_m * point.direction),
                         transformed(frame.pose, point.position - kMarginM * point.direction), crossed);
      for (const int surfel : crossed) {
        ++passed[surfel];
      }
    }
  }
  std::vector<Surfel> kept;
  for (std::size_t i = 0; i < surfels.size(); ++i) {
    if (passed[i] <= kPassingShare * surfels[i].hits) {
      kept.push_back(surfels[i]);
    }
  }
  return kept;
}

}  // namespace mtr_surfel_map
