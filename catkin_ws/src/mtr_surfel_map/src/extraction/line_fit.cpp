/// @file
/// Orthogonal regression.
// SPDX-License-Identifier: Apache-2.0
#include "extraction/line_fit.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

namespace mtr_surfel_map {
namespace {

constexpr int kMinPoints = 6;
constexpr std::size_t kMinKeyFrames = 3;
// Number of equal parts of a line that are checked separately.
constexpr std::size_t kParts = 8;
// Deviation of a part in standard errors that counts as significant: by chance, 1 in 2000 lines has such a part among
// eight.
constexpr double kSignificance = 4.0;

}  // namespace

double Line::length_m() const { return std::sqrt(12.0) * spread_m; }

Line line_through(SeenPointIterator first, SeenPointIterator last) {
  const double count = static_cast<double>(std::distance(first, last));
  Eigen::Vector2d middle = Eigen::Vector2d::Zero();
  Eigen::Vector2d seen_along = Eigen::Vector2d::Zero();
  for (SeenPointIterator point = first; point != last; ++point) {
    middle += point->position / count;
    seen_along += point->direction / count;
  }
  Eigen::Matrix2d scatter = Eigen::Matrix2d::Zero();
  for (SeenPointIterator point = first; point != last; ++point) {
    scatter += (point->position - middle) * (point->position - middle).transpose() / count;
  }
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> solver;
  solver.computeDirect(scatter);
  Eigen::Vector2d normal = solver.eigenvectors().col(0);
  if (normal.dot(seen_along) > 0.0) {
    normal = -normal;
  }
  const Eigen::Vector2d spread = solver.eigenvalues().cwiseMax(0.0).cwiseSqrt();
  return {middle, normal, spread[1], spread[0], -normal.dot(seen_along)};
}

double unevenness_m(SeenPointIterator first, SeenPointIterator last, const Line& line) {
  std::array<double, kParts> sums{};
  std::array<double, kParts> counts{};
  for (SeenPointIterator point = first; point != last; ++point) {
    const Eigen::Vector2d offset = point->position - line.middle;
    const double part = std::floor((line.along().dot(offset) / line.length_m() + 0.5) * kParts);
    const std::size_t index = static_cast<std::size_t>(std::clamp(part, 0.0, kParts - 1.0));
    sums[index] += line.normal.dot(offset);
    ++counts[index];
  }
  double max_m = 0.0;
  for (std::size_t i = 0; i < kParts; ++i) {
    if (counts[i] > 0.0) {
      const double chance_m = kSignificance * line.thickness_m / std::sqrt(counts[i]);
      max_m = std::max(max_m, std::abs(sums[i]) / counts[i] - chance_m);
    }
  }
  return max_m;
}

bool is_enough(SeenPointIterator first, SeenPointIterator last) {
  if (std::distance(first, last) < kMinPoints) {
    return false;
  }
  std::vector<int> places;
  for (SeenPointIterator point = first; point != last && places.size() < kMinKeyFrames; ++point) {
    if (std::find(places.begin(), places.end(), point->key_frame) == places.end()) {
      places.push_back(point->key_frame);
    }
  }
  return places.size() >= kMinKeyFrames;
}

}  // namespace mtr_surfel_map
