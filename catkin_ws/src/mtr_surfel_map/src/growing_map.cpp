/// @file
/// Point cells and the line fit through the neighbourhood of each cell.
// SPDX-License-Identifier: Apache-2.0
#include "mtr_surfel_map/growing_map.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "mtr_surfel_map/se2.hpp"

namespace mtr_surfel_map {
namespace {

constexpr double kCellM = 0.05;
// Neighbouring cells on either side for the direction of a surface: 0.1 m, less than the rounded corner of a car.
constexpr int kNeighbours = 2;
constexpr int kMinCells = 4;
// A neighbourhood is a line if its variance ratio (across over along) is below this limit.
constexpr double kFlatness = 0.15;
// 1 sigma of the mean of a few beams, including the pose error.
constexpr double kSigmaM = 0.01;

std::int64_t key_of(int x, int y) {
  return static_cast<std::int64_t>((static_cast<std::uint64_t>(static_cast<std::uint32_t>(x)) << 32) |
                                   static_cast<std::uint32_t>(y));
}

}  // namespace

void GrowingMap::clear() {
  cells_.clear();
  index_.clear();
}

void GrowingMap::insert(const PoseVector& pose, const ScanPoints& scan) {
  const Eigen::Matrix2d turn = rotation(pose.z());
  std::vector<std::size_t> met;
  for (const ScanPoint& point : scan.points) {
    const Eigen::Vector2d position = pose.head<2>() + turn * point.position;
    met.push_back(index_at(position));
    Cell& cell = cells_[met.back()];
    cell.sum += position;
    cell.seen_along += turn * point.direction;
    cell.lowest_rise_m = cell.hits > 0 ? std::min(cell.lowest_rise_m, point.rise_m) : point.rise_m;
    cell.highest_rise_m = cell.hits > 0 ? std::max(cell.highest_rise_m, point.rise_m) : point.rise_m;
    ++cell.hits;
  }
  std::sort(met.begin(), met.end());
  met.erase(std::unique(met.begin(), met.end()), met.end());
  for (const std::size_t index : met) {
    cells_[index].surfel = surfel_of(cells_[index]);
  }
}

std::size_t GrowingMap::index_at(const Eigen::Vector2d& position) {
  const Eigen::Vector2i place = (position / kCellM).array().floor().cast<int>();
  const auto entry = index_.emplace(key_of(place.x(), place.y()), cells_.size());
  if (entry.second) {
    cells_.emplace_back();
    cells_.back().place = place;
  }
  return entry.first->second;
}

const GrowingMap::Cell* GrowingMap::cell_at(int x, int y) const {
  const auto found = index_.find(key_of(x, y));
  return found == index_.end() ? nullptr : &cells_[found->second];
}

std::vector<Surfel> GrowingMap::surfels() const {
  std::vector<Surfel> surfels;
  for (const Cell& cell : cells_) {
    if (cell.hits > 1) {
      surfels.push_back(cell.surfel);
    }
  }
  return surfels;
}

Surfel GrowingMap::surfel_of(const Cell& cell) const {
  double hits = 0.0;
  int cells = 0;
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  Eigen::Matrix2d square = Eigen::Matrix2d::Zero();
  const Eigen::Vector2d own = cell.sum / cell.hits;
  for (int x = cell.place.x() - kNeighbours; x <= cell.place.x() + kNeighbours; ++x) {
    for (int y = cell.place.y() - kNeighbours; y <= cell.place.y() + kNeighbours; ++y) {
      if (const Cell* other = cell_at(x, y)) {
        const Eigen::Vector2d offset = other->sum / other->hits - own;
        hits += other->hits;
        ++cells;
        mean += other->hits * offset;
        square += other->hits * offset * offset.transpose();
      }
    }
  }
  mean /= hits;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> axes(square / hits - mean * mean.transpose());
  // At a corner or a post, a line does not fit: the surfel then faces the viewer and constrains the range only.
  const bool is_line = cells >= kMinCells && axes.eigenvalues()[0] < kFlatness * axes.eigenvalues()[1];
  const Eigen::Vector2d towards_viewer = -cell.seen_along.normalized();
  Eigen::Vector2d normal = is_line ? Eigen::Vector2d(axes.eigenvectors().col(0)) : towards_viewer;
  if (normal.dot(towards_viewer) < 0.0) {
    normal = -normal;
  }
  const Eigen::Vector2d position = is_line ? own + normal * normal.dot(mean) : own;
  return {position, normal, std::sqrt(2.0) * kCellM, kSigmaM, cell.hits, cell.lowest_rise_m, cell.highest_rise_m};
}

}  // namespace mtr_surfel_map
