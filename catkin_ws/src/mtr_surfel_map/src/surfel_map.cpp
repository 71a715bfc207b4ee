/// @file
/// Grid index of surface elements.
// SPDX-License-Identifier: Apache-2.0
#include "mtr_surfel_map/surfel_map.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "cell_walk.hpp"

namespace mtr_surfel_map {
namespace {

// About the length of a surfel, so that a surfel is in few cells and a cell lists few surfels.
constexpr double kCellM = 0.25;
// Largest number of cells per side: a stray surfel far away must not exhaust the memory.
constexpr double kMaxCells = 1500.0;
// A beam at more than 84 degrees from the normal does not measure the surface.
constexpr double kGrazing = 0.1;
// Neighbouring surfels of one surface leave gaps of this size, so a surfel also matches beyond its ends.
constexpr double kGapM = 0.02;
// The middle part of a surfel, as a share of its length: a line of sight that passes an edge does not cross the
// surface.
constexpr double kMiddle = 0.6;

Eigen::Vector2d along(const Surfel& surfel) { return {-surfel.normal.y(), surfel.normal.x()}; }

bool crosses(const Surfel& surfel, const Eigen::Vector2d& from, const Eigen::Vector2d& to) {
  const double before = surfel.normal.dot(from - surfel.position);
  const double after = surfel.normal.dot(to - surfel.position);
  if (before * after >= 0.0 || std::abs(after - before) < kGrazing * (to - from).norm()) {
    return false;
  }
  const Eigen::Vector2d point = from + (to - from) * (before / (before - after));
  return std::abs(along(surfel).dot(point - surfel.position)) < kMiddle * surfel.length_m / 2.0;
}

}  // namespace

SurfelMap::SurfelMap(std::vector<Surfel> surfels) : surfels_(std::move(surfels)) {
  choose_grid();
  fill_grid();
}

void SurfelMap::choose_grid() {
  if (surfels_.empty()) {
    return;
  }
  Eigen::Vector2d low = surfels_.front().position;
  Eigen::Vector2d high = low;
  for (const Surfel& surfel : surfels_) {
    low = low.cwiseMin(surfel.position - Eigen::Vector2d::Constant(surfel.length_m));
    high = high.cwiseMax(surfel.position + Eigen::Vector2d::Constant(surfel.length_m));
  }
  origin_ = low;
  cell_m_ = std::max(kCellM, (high - low).maxCoeff() / kMaxCells);
  size_ = in_cells(high).array().floor().cast<int>() + 1;
}

void SurfelMap::fill_grid() {
  std::vector<std::pair<int, int>> entries;
  for (std::size_t i = 0; i < surfels_.size(); ++i) {
    const Eigen::Vector2d half = along(surfels_[i]) * (surfels_[i].length_m / 2.0 + kGapM);
    walk_cells(in_cells(surfels_[i].position - half), in_cells(surfels_[i].position + half),
               [&](const Eigen::Vector2i& cell) {
                 if (contains(cell)) {
                   entries.emplace_back(cell.y() * size_.x() + cell.x(), static_cast<int>(i));
                 }
               });
  }
  std::sort(entries.begin(), entries.end());
  starts_.assign(static_cast<std::size_t>(size_.x()) * size_.y() + 1, 0);
  for (const auto& entry : entries) {
    ++starts_[entry.first + 1];
    listed_.push_back(entry.second);
  }
  for (std::size_t i = 1; i < starts_.size(); ++i) {
    starts_[i] += starts_[i - 1];
  }
}

bool SurfelMap::contains(const Eigen::Vector2i& cell) const {
  return cell.x() >= 0 && cell.y() >= 0 && cell.x() < size_.x() && cell.y() < size_.y();
}

SurfelMap::Range SurfelMap::surfels_in(const Eigen::Vector2i& cell) const {
  const int index = cell.y() * size_.x() + cell.x();
  return {listed_.data() + starts_[index], listed_.data() + starts_[index + 1]};
}

std::optional<SurfelMatch> SurfelMap::match(const Eigen::Vector2d& point, double max_distance_m,
                                            const Eigen::Vector2d& seen_along) const {
  if (!point.allFinite()) {
    return std::nullopt;
  }
  const Eigen::Array2d radius = Eigen::Array2d::Constant(max_distance_m / cell_m_);
  const Eigen::Array2d middle = in_cells(point).array();
  // Clamp before the conversion: the cell index of a point far away would overflow.
  const Eigen::Vector2i low = (middle - radius).max(0.0).min(size_.array().cast<double>()).floor().cast<int>();
  const Eigen::Vector2i high = (middle + radius).min(size_.array().cast<double>() - 1.0).max(-1.0).floor().cast<int>();
  std::optional<SurfelMatch> best;
  double nearest = max_distance_m;
  for (int y = low.y(); y <= high.y(); ++y) {
    for (int x = low.x(); x <= high.x(); ++x) {
      for (const int index : surfels_in({x, y})) {
        const Surfel& surfel = surfels_[index];
        const Eigen::Vector2d offset = point - surfel.position;
        const double distance = surfel.normal.dot(offset);
        if (std::abs(distance) <= nearest && std::abs(along(surfel).dot(offset)) <= surfel.length_m / 2.0 + kGapM &&
            surfel.normal.dot(seen_along) < -kGrazing) {
          nearest = std::abs(distance);
          best = SurfelMatch{&surfel, distance};
        }
      }
    }
  }
  return best;
}

void SurfelMap::append_crossed(const Eigen::Vector2d& from, const Eigen::Vector2d& to,
                               std::vector<int>& indices) const {
  walk_cells(in_cells(from), in_cells(to), [&](const Eigen::Vector2i& cell) {
    if (contains(cell)) {
      for (const int index : surfels_in(cell)) {
        if (crosses(surfels_[index], from, to)) {
          indices.push_back(index);
        }
      }
    }
  });
}

}  // namespace mtr_surfel_map
