/// @file
/// Clusters of echoes: their size tells rain from things and things from surfaces.
// SPDX-License-Identifier: Apache-2.0
#include "mtr_drive_control/collision/echoes.hpp"

#include <algorithm>
#include <map>

namespace mtr_drive_control {
namespace {

// Two echoes belong together when they are nearer than this plus a share of their range, which covers the wider
// spacing of beams and echoes farther away.
constexpr double kGapM = 0.08;
constexpr double kGapPerRange = 0.03;
// So many beams between two echoes of one cluster may have ended elsewhere, e.g. on a raindrop.
constexpr std::size_t kMostBeamsBetween = 3;
// A leg of 0.14 m has so many beams at 5 m (720 beams over 270 degrees).
constexpr int kBeamsThatCountAtOnce = 4;
// Smaller clusters count when seen in so many sweeps within so much of their place.
constexpr int kSweepsThatCount = 4;
constexpr double kSamePlaceM = 0.05;
// Two legs in full stride measure less across; a wheel seen from its side more.
constexpr double kWiderThanAPersonM = 0.5;

struct Cluster {
  int beams = 0;
  double min_x = 1e9, max_x = -1e9, min_y = 1e9, max_y = -1e9;

  void add(const Point& point) {
    ++beams;
    min_x = std::min(min_x, point.x_m);
    max_x = std::max(max_x, point.x_m);
    min_y = std::min(min_y, point.y_m);
    max_y = std::max(max_y, point.y_m);
  }
  bool is_wide() const { return std::hypot(max_x - min_x, max_y - min_y) > kWiderThanAPersonM; }
};

}  // namespace

std::vector<Echo> EchoFinder::find(const Sweep& sweep, const Motion& motion, double max_range_m) {
  const std::vector<Hit> hits = hits_of(sweep, max_range_m);
  std::vector<Cluster> clusters;
  for (const Hit& hit : hits) {
    clusters.resize(std::max(clusters.size(), static_cast<std::size_t>(hit.cluster) + 1));
    clusters[static_cast<std::size_t>(hit.cluster)].add(hit.in_base);
  }
  std::vector<Echo> echoes;
  std::vector<Small> small;
  for (const Hit& hit : hits) {
    const auto stamp_ns = sweep.stamp_ns + static_cast<std::int64_t>(1e9 * sweep.time_increment_s * hit.beam);
    const Point point = motion.at(stamp_ns).apply(hit.in_base);
    const Cluster& cluster = clusters[static_cast<std::size_t>(hit.cluster)];
    if (cluster.beams < kBeamsThatCountAtOnce) {
      small.push_back({point, sweeps_seen(point) + 1});
      if (small.back().sweeps_seen < kSweepsThatCount) {
        continue;
      }
    }
    echoes.push_back({point, stamp_ns, cluster.is_wide()});
  }
  small_ = std::move(small);
  return echoes;
}

std::vector<EchoFinder::Hit> EchoFinder::hits_of(const Sweep& sweep, double max_range_m) const {
  std::vector<Hit> hits;
  int clusters = 0;
  for (std::size_t beam = 0; beam < sweep.ranges_m.size(); ++beam) {
    const double range = sweep.ranges_m[beam];
    if (!sweep.is_echo(beam) || range > max_range_m) {
      continue;
    }
    const Point point = mount_.in_base(range, sweep.angle_of(beam));
    // The robot's own mast and lift.
    if (footprint_.distance_to(point) == 0.0) {
      continue;
    }
    int cluster = -1;
    for (auto before = hits.rbegin(); before != hits.rend() && beam - before->beam <= kMostBeamsBetween; ++before) {
      if (distance_m(before->in_base, point) < kGapM + kGapPerRange * range) {
        cluster = before->cluster;
        break;
      }
    }
    hits.push_back({beam, point, range, cluster < 0 ? clusters++ : cluster});
  }
  return hits;
}

int EchoFinder::sweeps_seen(const Point& point) const {
  int most = 0;
  for (const Small& before : small_) {
    if (distance_m(before.point, point) < kSamePlaceM) {
      most = std::max(most, before.sweeps_seen);
    }
  }
  return most;
}

}  // namespace mtr_drive_control
