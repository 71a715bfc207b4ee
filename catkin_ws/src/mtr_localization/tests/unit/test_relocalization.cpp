/// @file
/// Evidence for a place.
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "scene_drive.hpp"
#include "tracking/relocalization.hpp"

namespace mtr_localization {
namespace {

class RelocalizationTest : public ::testing::Test {
 protected:
  void add_surfaces(const synthetic::World& scene) {
    std::vector<Surfel> surfels;
    for (const synthetic::Segment& side : scene) {
      const Eigen::Vector2d along = (side.to - side.from).normalized();
      for (double at = 0.1; at < (side.to - side.from).norm(); at += 0.2) {
        surfels.push_back({side.from + at * along, {along.y(), -along.x()}, 0.2, 0.002, 50});
      }
    }
    map.surfaces = SurfelMap(surfels);
  }

  /// Returns a view of a LiDAR in base_link with a field of 70 degrees ahead and range `range_max_m`; odom equals map.
  static View view_from(const synthetic::World& scene, const PoseVector& pose, double range_max_m = 30.0) {
    View view;
    view.odom = pose;
    view.turns.emplace_back();
    Sweep& sweep = view.sweeps.emplace_back();
    sweep.angle_min_rad = -0.6;
    sweep.angle_max_rad = 0.6;
    sweep.angle_increment_rad = 1.2 / 239;
    sweep.range_min_m = 0.1;
    sweep.range_max_m = range_max_m;
    for (int beam = 0; beam < 240; ++beam) {
      const double angle = sweep.angle_min_rad + beam * sweep.angle_increment_rad;
      const Eigen::Vector2d direction(std::cos(angle), std::sin(angle));
      const double range = synthetic::cast(scene, pose.head<2>(), rotation(pose.z()) * direction);
      const bool is_seen = range > 0.0 && range < range_max_m;
      sweep.ranges_m.push_back(is_seen ? static_cast<float>(range) : std::numeric_limits<float>::infinity());
      if (is_seen) {
        view.scan.points.push_back({range * direction, direction, range});
      }
    }
    return view;
  }

  /// Shows each view for all steps of a search.
  std::optional<Relocalization::Found> found_from(const std::vector<View>& views, const PoseVector& reckoned) {
    Relocalization search(TrackingParameters{}, map);
    for (const View& view : views) {
      for (int step = 0; step < 200; ++step) {
        if (const auto found = search.advance(view, reckoned)) {
          return found;
        }
      }
    }
    return std::nullopt;
  }

  ReferenceMap map;
};

synthetic::World room() {
  synthetic::World scene;
  synthetic::add_polygon(scene, {{-4.0, 4.0}, {2.0, 4.0}, {2.0, 1.0}, {5.0, 1.0}, {5.0, -3.0}, {-4.0, -3.0}},
                         PoseVector::Zero());
  return scene;
}

TEST_F(RelocalizationTest, ThreeViewsOnTheWayProveAPlace) {
  add_surfaces(room());
  std::vector<View> views;
  for (const double turn : {0.0, 1.0, 2.0}) {
    views.push_back(view_from(room(), {0.5, 0.3, turn}));
  }
  const auto found = found_from(views, {-1.0, -1.0, 0.0});
  ASSERT_TRUE(found);
  EXPECT_LT((found->pose - PoseVector(0.5, 0.3, 2.0)).norm(), 0.02) << found->pose.transpose();
}

TEST_F(RelocalizationTest, OneViewProvesNothingHoweverLongItIsSeen) {
  add_surfaces(room());
  EXPECT_FALSE(found_from(std::vector<View>(20, view_from(room(), {0.5, 0.3, 1.0})), {-1.0, -1.0, 0.0}));
}

TEST_F(RelocalizationTest, TwoPlacesThatLookAlikeAreNotGuessedBetween) {
  // Two equal boxes 2.5 m apart and nothing else: either can be in view.
  synthetic::World scene;
  for (const double y : {-1.25, 1.25}) {
    scenes::add_box(scene, {0.0, y, 0.0}, 1.0, 1.0);
  }
  add_surfaces(scene);
  // The other box is out of view.
  synthetic::World one;
  scenes::add_box(one, {0.0, 1.25, 0.0}, 1.0, 1.0);
  std::vector<View> views;
  for (const double x : {1.3, 1.9, 2.5, 3.1}) {
    views.push_back(view_from(one, {x, 1.25, M_PI}, 2.7));
  }
  EXPECT_FALSE(found_from(views, {2.0, 0.0, M_PI}));
}

TEST_F(RelocalizationTest, PlaceThatShowsMoreThanIsSeenStaysARivalOfOneThatFitsBetter) {
  // Two plates 2.5 m apart, one of them with a gap in its middle.
  const auto plate = [](double y) { return synthetic::Segment{{0.5, y - 0.5}, {0.5, y + 0.5}}; };
  const auto with_gap = [](double y) {
    return synthetic::World{{{0.5, y - 0.5}, {0.5, y - 0.2}}, {{0.5, y + 0.2}, {0.5, y + 0.5}}};
  };
  synthetic::World scene = with_gap(1.25);
  scene.push_back(plate(-1.25));
  add_surfaces(scene);
  // The robot is in front of the complete plate, whose middle the low LiDAR does not see.
  std::vector<View> views;
  for (const double x : {1.3, 1.9, 2.5, 3.1}) {
    views.push_back(view_from(with_gap(-1.25), {x, -1.25, M_PI}, 2.7));
  }
  EXPECT_FALSE(found_from(views, {2.0, 0.0, M_PI}));
}

TEST_F(RelocalizationTest, RivalIsMeasuredByWhatTheBestPlaceExplainsItself) {
  // As before, with an unmapped object next to the plate that no place explains.
  const auto with_gap = [](double y) {
    return synthetic::World{{{0.5, y - 0.5}, {0.5, y - 0.2}}, {{0.5, y + 0.2}, {0.5, y + 0.5}}};
  };
  synthetic::World scene = with_gap(1.25);
  scene.push_back({{0.5, -1.75}, {0.5, -0.75}});
  add_surfaces(scene);
  synthetic::World seen = with_gap(-1.25);
  seen.push_back({{0.9, -0.7}, {0.9, -0.35}});
  std::vector<View> views;
  for (const double x : {1.7, 2.0, 2.5, 3.1}) {
    views.push_back(view_from(seen, {x, -1.25, M_PI}, 2.7));
  }
  EXPECT_FALSE(found_from(views, {2.0, 0.0, M_PI}));
}

TEST_F(RelocalizationTest, PlaceThatExplainsAllThatReturnsStaysARivalWhateverElseItLetsExpect) {
  // The correct plate is complete on the map, and 0.6 of 2 m are visible; the other one has only these parts.
  const auto ends = [](double y) {
    return synthetic::World{{{0.5, y - 1.0}, {0.5, y - 0.7}}, {{0.5, y + 0.7}, {0.5, y + 1.0}}};
  };
  synthetic::World scene = ends(2.5);
  scene.push_back({{0.5, -3.5}, {0.5, -1.5}});
  add_surfaces(scene);
  std::vector<View> views;
  for (const double x : {2.1, 2.7, 3.3}) {
    views.push_back(view_from(ends(-2.5), {x, -2.5, M_PI}, 3.0));
  }
  EXPECT_FALSE(found_from(views, {5.0, 3.0, 0.0}));
}

TEST_F(RelocalizationTest, PlaceWhereWheelsAndGyroHaveLedStaysARivalWithMoreThanHalf) {
  // The map has one of the correct plate's two ends, and a piece between them that is not visible; the other plate has
  // both.
  const auto ends = [](double y) {
    return synthetic::World{{{0.5, y - 1.0}, {0.5, y - 0.7}}, {{0.5, y + 0.7}, {0.5, y + 1.0}}};
  };
  synthetic::World scene = ends(2.5);
  scene.push_back({{0.5, -3.5}, {0.5, -3.2}});
  scene.push_back({{0.5, -2.6}, {0.5, -2.4}});
  add_surfaces(scene);
  std::vector<View> views;
  for (const double x : {2.1, 2.7, 3.3}) {
    views.push_back(view_from(ends(-2.5), {x, -2.5, M_PI}, 3.0));
  }
  EXPECT_TRUE(found_from(views, {5.0, 3.0, 0.0}));
  Relocalization search(TrackingParameters{}, map);
  for (const View& view : views) {
    for (int step = 0; step < 200; ++step) {
      EXPECT_FALSE(search.advance(view, view.odom));
    }
  }
}

TEST_F(RelocalizationTest, PlaceWhereReturnsLieBesideTheSurfacesIsNone) {
  // A room that is larger by a twentieth: at 4 m, a return 0.2 m off a surface still agrees with it.
  add_surfaces(room());
  synthetic::World larger = room();
  for (synthetic::Segment& side : larger) {
    side = {1.05 * side.from, 1.05 * side.to};
  }
  std::vector<View> views;
  for (const double turn : {0.0, 1.0, 2.0, 3.0}) {
    views.push_back(view_from(larger, {0.5, 0.3, turn}));
  }
  EXPECT_FALSE(found_from(views, {-1.0, -1.0, 0.0}));
}

TEST_F(RelocalizationTest, FoundPlaceIsAsSureAsTheViewMakesIt) {
  add_surfaces(room());
  std::vector<View> views;
  for (const double turn : {0.0, 1.0, 2.0}) {
    views.push_back(view_from(room(), {0.5, 0.3, turn}));
  }
  const auto found = found_from(views, {-1.0, -1.0, 0.0});
  ASSERT_TRUE(found);
  // Two perpendicular walls with a hundred beams of 1 cm each.
  EXPECT_LT(found->covariance.diagonal().head(2).sum(), 0.01 * 0.01);
  EXPECT_LT(found->covariance(2, 2), 0.005 * 0.005);
}

TEST_F(RelocalizationTest, PlaceAtTheRimOfTheSearchMayHaveABetterOneBeyond) {
  add_surfaces(room());
  const double rim_m = TrackingParameters{}.search_radius_m - 0.2;
  std::vector<View> views;
  for (const double turn : {0.0, 1.0, 2.0, 3.0}) {
    views.push_back(view_from(room(), {0.5, 0.3, turn}));
  }
  EXPECT_FALSE(found_from(views, {0.5 - rim_m, 0.3, 0.0}));
}

}  // namespace
}  // namespace mtr_localization
