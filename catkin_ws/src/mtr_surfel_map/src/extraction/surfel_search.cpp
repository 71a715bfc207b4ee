/// @file
/// Quadtree of squares.
// SPDX-License-Identifier: Apache-2.0
#include "extraction/surfel_search.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace mtr_surfel_map {
namespace {

using Iterator = SeenPoints::iterator;

// Elongation (length over thickness, as root mean squares) from which on the direction of the points is well defined.
constexpr double kElongation = 2.0;
// Largest standard error of the direction, from the scatter of the points.
constexpr double kDirectionErrorRad = 0.1;
// Points seen at more than 75 degrees from the normal on average are the smeared edge of an object.
constexpr double kMinFacing = 0.25;
// Largest deviation of a part of a line. A larger one makes views of both ends disagree by more than
// AdjustmentParameters::surface_sigma_m.
constexpr double kMaxUnevennessM = 0.003;

/// Result of the fit in one square: divide it again, or a surfel, or nothing.
struct SquareFit {
  bool divide = false;
  std::optional<Surfel> surfel;
};

/// Divides squares until the points of each are on a line or are too few.
class Search {
 public:
  Search(const SurfelShape& shape, std::vector<Surfel>& found) : shape_(shape), found_(found) {}

  void square(Iterator first, Iterator last, const Eigen::Vector2d& corner, double side_m) {
    if (!is_enough(first, last)) {
      return;
    }
    // The two sides of a thin object are two surfaces.
    const Line line = line_through(first, last);
    const Iterator turned =
        std::partition(first, last, [&](const SeenPoint& point) { return line.normal.dot(point.direction) < 0.0; });
    const bool divisible = side_m > 1.5 * shape_.min_m;
    const SquareFit front = judge(first, turned, divisible);
    const SquareFit back = judge(turned, last, divisible);
    if (front.divide || back.divide) {
      divide(first, last, corner, side_m / 2.0);
      return;
    }
    for (const SquareFit& fit : {front, back}) {
      if (fit.surfel) {
        found_.push_back(*fit.surfel);
      }
    }
  }

 private:
  SquareFit judge(Iterator first, Iterator last, bool divisible) const {
    if (!is_enough(first, last)) {
      return {};
    }
    const Line line = line_through(first, last);
    if (line.thickness_m > shape_.thickness_m || (divisible && unevenness_m(first, last, line) > kMaxUnevennessM)) {
      return {divisible, std::nullopt};
    }
    return {false, surfel_along(line, static_cast<int>(std::distance(first, last)))};
  }

  void divide(Iterator first, Iterator last, const Eigen::Vector2d& corner, double side_m) {
    const Eigen::Vector2d middle = corner + Eigen::Vector2d::Constant(side_m);
    const auto below = [&](const SeenPoint& point) { return point.position.y() < middle.y(); };
    const auto left = [&](const SeenPoint& point) { return point.position.x() < middle.x(); };
    const Iterator upper = std::partition(first, last, below);
    const Iterator lower_right = std::partition(first, upper, left);
    const Iterator upper_right = std::partition(upper, last, left);
    square(first, lower_right, corner, side_m);
    square(lower_right, upper, {middle.x(), corner.y()}, side_m);
    square(upper, upper_right, {corner.x(), middle.y()}, side_m);
    square(upper_right, last, middle, side_m);
  }

  const SurfelShape& shape_;
  std::vector<Surfel>& found_;
};

}  // namespace

std::optional<Surfel> surfel_along(const Line& line, int hits) {
  const double elongation = line.spread_m / std::max(line.thickness_m, 1e-9);
  const double direction_error_rad = 1.0 / (elongation * std::sqrt(static_cast<double>(hits)));
  if (elongation < kElongation || direction_error_rad > kDirectionErrorRad || line.facing < kMinFacing) {
    return std::nullopt;
  }
  return Surfel{line.middle, line.normal, line.length_m(), 0.0, hits};
}

std::vector<Surfel> search_surfels(SeenPoints points, const SurfelShape& shape) {
  const auto cell_of = [&](const SeenPoint& point) -> Eigen::Array2d {
    return ((point.position - shape.origin) / shape.max_m).array().floor();
  };
  const auto before = [&](const SeenPoint& a, const SeenPoint& b) {
    const Eigen::Array2d first = cell_of(a);
    const Eigen::Array2d second = cell_of(b);
    return first.y() != second.y() ? first.y() < second.y() : first.x() < second.x();
  };
  std::stable_sort(points.begin(), points.end(), before);
  std::vector<Surfel> found;
  Search search(shape, found);
  for (Iterator first = points.begin(); first != points.end();) {
    const Iterator last = std::upper_bound(first, points.end(), *first, before);
    const Eigen::Vector2d corner = shape.origin + (cell_of(*first) * shape.max_m).matrix();
    search.square(first, last, corner, shape.max_m);
    first = last;
  }
  return found;
}

}  // namespace mtr_surfel_map
