/// @file
/// Surfel search, and repair of surfaces that the square borders of the search cut.
// SPDX-License-Identifier: Apache-2.0
#include "extraction/surfel_builder.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "mtr_surfel_map/surfel_map.hpp"

namespace mtr_surfel_map {
namespace {

// Cosine of the angle up to which two surfels may be one surface: 30 degrees.
constexpr double kSameDirection = 0.87;
// Association gate in multiples of the largest root mean square thickness.
constexpr double kGate = 2.5;
// Distance between two parts of a surface along which a border runs, in the same unit. The border cuts a normal
// distribution into parts whose means are at most 4 sigma apart, and a surface is at most 2 sigma thick.
constexpr double kApart = 2.0;

bool is_double_of(const Surfel& surfel, const Surfel& other, double apart_m) {
  const Eigen::Vector2d offset = surfel.position - other.position;
  const Eigen::Vector2d along(-other.normal.y(), other.normal.x());
  return surfel.normal.dot(other.normal) > kSameDirection && std::abs(other.normal.dot(offset)) < apart_m &&
         std::abs(along.dot(offset)) < other.length_m / 2.0;
}

/// Removes duplicates, which a square border along a surface causes, and keeps the surfel with the most points.
std::vector<Surfel> without_doubles(std::vector<Surfel> surfels, double apart_m) {
  std::stable_sort(surfels.begin(), surfels.end(), [](const Surfel& a, const Surfel& b) { return a.hits > b.hits; });
  std::vector<Surfel> kept;
  for (const Surfel& surfel : surfels) {
    if (std::none_of(kept.begin(), kept.end(),
                     [&](const Surfel& other) { return is_double_of(surfel, other, apart_m); })) {
      kept.push_back(surfel);
    }
  }
  return kept;
}

/// Fits each surfel again to all points near it, including points of neighbouring squares.
std::vector<Surfel> refitted(const std::vector<Surfel>& surfels, const SeenPoints& points, double gate_m) {
  const SurfelMap map(surfels);
  std::vector<SeenPoints> near(surfels.size());
  for (const SeenPoint& point : points) {
    const std::optional<SurfelMatch> match = map.match(point.position, gate_m, point.direction);
    if (match) {
      near[static_cast<std::size_t>(match->surfel - map.surfels().data())].push_back(point);
    }
  }
  std::vector<Surfel> fitted;
  for (std::size_t i = 0; i < surfels.size(); ++i) {
    if (is_enough(near[i].begin(), near[i].end())) {
      const Line line = line_through(near[i].begin(), near[i].end());
      const std::optional<Surfel> surfel = surfel_along(line, static_cast<int>(near[i].size()));
      if (surfel && surfel->normal.dot(surfels[i].normal) > kSameDirection) {
        fitted.push_back(*surfel);
      }
    }
  }
  return fitted;
}

}  // namespace

std::vector<Surfel> build_surfels(const SeenPoints& points, const SurfelShape& shape) {
  const std::vector<Surfel> found = without_doubles(search_surfels(points, shape), kApart * shape.thickness_m);
  return refitted(found, points, kGate * shape.thickness_m);
}

}  // namespace mtr_surfel_map
