/// @file
/// Quadtree search for straight pieces of surface.
// SPDX-License-Identifier: Apache-2.0
#include "mtr_localization/surfel_builder.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <utility>

namespace mtr_localization {
namespace {

using Iterator = std::vector<SeenPoint>::iterator;

// Fewer returns, or fewer places that saw them, may be a person who walks by, or rain.
constexpr int kFewestPoints = 6;
constexpr int kFewestKeyFrames = 3;
// Length over thickness of the points, as root mean squares, from which on their direction counts as known.
constexpr double kElongation = 2.0;
// Bow of a curved surface over the length of one element at most; beyond, a view from one end and one from the other
// disagree by more than AdjustmentParameters::surface_sigma_m.
constexpr double kLargestBowM = 0.004;
// Standard errors by which a bow must differ from zero.
constexpr double kBowSignificance = 3.0;

/// A line through points.
struct Line {
  Eigen::Vector2d middle;
  Eigen::Vector2d along;
  Eigen::Vector2d normal;
  double spread_along_m;
  double thickness_m;
};

Line line_through(Iterator first, Iterator last) {
  const double count = static_cast<double>(std::distance(first, last));
  Eigen::Vector2d middle = Eigen::Vector2d::Zero();
  Eigen::Vector2d seen_along = Eigen::Vector2d::Zero();
  for (Iterator point = first; point != last; ++point) {
    middle += point->position / count;
    seen_along += point->direction;
  }
  Eigen::Matrix2d scatter = Eigen::Matrix2d::Zero();
  for (Iterator point = first; point != last; ++point) {
    scatter += (point->position - middle) * (point->position - middle).transpose() / count;
  }
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> solver;
  solver.computeDirect(scatter);
  Eigen::Vector2d normal = solver.eigenvectors().col(0);
  if (normal.dot(seen_along) > 0.0) {
    normal = -normal;
  }
  const Eigen::Vector2d spread = solver.eigenvalues().cwiseMax(0.0).cwiseSqrt();
  return {middle, {-normal.y(), normal.x()}, normal, spread[1], spread[0]};
}

/// Height of the arc over the chord of the points' extent, when it is significant; else 0.
double bow_m(Iterator first, Iterator last, const Line& line) {
  double sum_q2 = 0.0;
  double sum_qh = 0.0;
  const double square = line.spread_along_m * line.spread_along_m;
  for (Iterator point = first; point != last; ++point) {
    const Eigen::Vector2d offset = point->position - line.middle;
    const double u = line.along.dot(offset);
    const double q = u * u - square;
    sum_q2 += q * q;
    sum_qh += q * line.normal.dot(offset);
  }
  if (sum_q2 <= 0.0) {
    return 0.0;
  }
  const double curvature = sum_qh / sum_q2;
  const double error = line.thickness_m / std::sqrt(sum_q2);
  // Evenly spread points reach to sqrt(3) times their root mean square.
  return std::abs(curvature) > kBowSignificance * error ? std::abs(curvature) * 3.0 * square : 0.0;
}

bool is_enough(Iterator first, Iterator last) {
  if (std::distance(first, last) < kFewestPoints) {
    return false;
  }
  std::vector<int> places;
  for (Iterator point = first; point != last && places.size() < kFewestKeyFrames; ++point) {
    if (std::find(places.begin(), places.end(), point->key_frame) == places.end()) {
      places.push_back(point->key_frame);
    }
  }
  return places.size() >= kFewestKeyFrames;
}

/// The points as one surface element, or why not.
struct Verdict {
  bool divide = false;
  std::optional<Surfel> surfel;
};

/// Divides squares until the points in each lie on a line, or are too few.
class Search {
 public:
  Search(const SurfelShape& shape, std::vector<Surfel>& found) : shape_(shape), found_(found) {}

  void square(Iterator first, Iterator last, const Eigen::Vector2d& corner, double side_m) {
    if (!is_enough(first, last)) {
      return;
    }
    // Two sides of a thin thing are two surfaces.
    const Line line = line_through(first, last);
    const Iterator turned =
        std::partition(first, last, [&](const SeenPoint& point) { return line.normal.dot(point.direction) < 0.0; });
    const bool divisible = side_m > 1.5 * shape_.smallest_m;
    const Verdict front = judge(first, turned, divisible);
    const Verdict back = judge(turned, last, divisible);
    if (front.divide || back.divide) {
      divide(first, last, corner, side_m / 2.0);
      return;
    }
    for (const Verdict& verdict : {front, back}) {
      if (verdict.surfel) {
        found_.push_back(*verdict.surfel);
      }
    }
  }

 private:
  Verdict judge(Iterator first, Iterator last, bool divisible) const {
    if (!is_enough(first, last)) {
      return {};
    }
    const Line line = line_through(first, last);
    if (line.thickness_m > shape_.thickness_m || (divisible && bow_m(first, last, line) > kLargestBowM)) {
      return {divisible, std::nullopt};
    }
    if (line.spread_along_m < kElongation * line.thickness_m) {
      return {};
    }
    // Evenly spread points: length is sqrt(12) times their root mean square.
    return {false, Surfel{line.middle, line.normal, std::sqrt(12.0) * line.spread_along_m, 0.0,
                          static_cast<int>(std::distance(first, last))}};
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

std::vector<Surfel> build_surfels(std::vector<SeenPoint> points, const SurfelShape& shape) {
  const auto cell_of = [&](const SeenPoint& point) -> Eigen::Array2d {
    return ((point.position - shape.origin) / shape.largest_m).array().floor();
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
    const Eigen::Vector2d corner = shape.origin + (cell_of(*first) * shape.largest_m).matrix();
    search.square(first, last, corner, shape.largest_m);
    first = last;
  }
  return found;
}

}  // namespace mtr_localization
