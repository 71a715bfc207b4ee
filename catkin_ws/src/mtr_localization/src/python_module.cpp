/// @file
/// Core of localization as the Python module mtr_localization_core, for simulations in one process.
// SPDX-License-Identifier: Apache-2.0
#include <pybind11/eigen.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "localizer.hpp"
#include "mtr_core/names.hpp"
#include "mtr_core/python_problem.hpp"
#include "mtr_description/robot_geometry.hpp"

namespace mtr_localization {
namespace {

namespace names = mtr_core::names;
namespace py = pybind11;

using Floats = py::array_t<float, py::array::c_style | py::array::forcecast>;
using Vector = std::array<double, 3>;

/// Localization of one robot in lock-step: inputs take effect at times that depend on their stamps only.
class RobotLocalizer {
 public:
  RobotLocalizer(const std::string& urdf, bool has_rear_lidar) : localizer_(in_lockstep()) {
    const mtr_description::RobotGeometry geometry(urdf);
    mounts_.push_back(level(geometry.mount(names::kFrontLidar)));
    if (has_rear_lidar) {
      mounts_.push_back(level(geometry.mount(names::kRearLidar)));
    }
  }

  /// Adds an object with the attributes of mtr_simulation.readings.Scan. Returns the reason of a rejection, or an empty
  /// text.
  std::string add_scan(bool is_rear, const py::object& scan) {
    const auto number = [&](const char* name) { return scan.attr(name).cast<double>(); };
    const auto ranges = scan.attr("ranges_m").cast<Floats>();
    const mtr_description::Mount& mount = mounts_.at(is_rear ? 1 : 0);
    Sweep sweep;
    sweep.lidar = is_rear ? Lidar::kRear : Lidar::kFront;
    sweep.stamp_ns = scan.attr("stamp_ns").cast<std::int64_t>();
    sweep.mount = PoseVector(mount.x_m, mount.y_m, mount.yaw_rad);
    sweep.mount_height_m = mount.z_m;
    sweep.angle_min_rad = number("angle_min_rad");
    sweep.angle_increment_rad = number("angle_increment_rad");
    sweep.angle_max_rad = sweep.angle_min_rad + sweep.angle_increment_rad * static_cast<double>(ranges.size() - 1);
    sweep.time_increment_s = number("time_increment_s");
    sweep.scan_time_s = number("scan_time_s");
    sweep.range_min_m = number("range_min_m");
    sweep.range_max_m = number("range_max_m");
    sweep.ranges_m.assign(ranges.data(), ranges.data() + ranges.size());
    return localizer_.add_scan(std::move(sweep));
  }

  void add_order(std::int64_t stamp_ns, std::uint64_t map_car_id, int phase) {
    localizer_.add_order({stamp_ns, map_car_id, static_cast<MapOrder::Phase>(phase)});
  }

  /// Processes objects with the attributes of mtr_simulation.readings.ImuReading and WheelOdometry.
  std::vector<Estimate> step(std::int64_t stamp_ns, const py::object& imu, const py::object& odometry) {
    const auto rate = imu.attr("angular_velocity").cast<Vector>();
    const auto force = imu.attr("acceleration").cast<Vector>();
    const auto number = [&](const char* name) { return odometry.attr(name).cast<double>(); };
    std::vector<Estimate> estimates = localizer_.add_imu(
        {stamp_ns, rate[2], Eigen::Vector2d(rate[0], rate[1]), Eigen::Vector3d(force[0], force[1], force[2])});
    const std::vector<Estimate> further = localizer_.add_wheels(
        {stamp_ns, number("x_m"), number("y_m"), number("heading_rad"), number("linear_mps"), number("angular_radps")});
    estimates.insert(estimates.end(), further.begin(), further.end());
    return estimates;
  }

  std::vector<Estimate> check_silence(std::int64_t now_ns) { return localizer_.check_silence(now_ns); }

  std::optional<MapResult> take_map() { return localizer_.take_map(); }

 private:
  static Parameters in_lockstep() {
    Parameters parameters;
    parameters.lockstep = true;
    return parameters;
  }

  static mtr_description::Mount level(const mtr_description::Mount& mount) {
    mtr_description::check_level(mount);
    return mount;
  }

  Localizer localizer_;
  std::vector<mtr_description::Mount> mounts_;
};

/// Returns rows of x (m), y (m), direction of the normal (rad), length (m), sigma (m) and hits.
Eigen::MatrixXd surfels_of(const MapResult& result) {
  Eigen::MatrixXd rows(static_cast<Eigen::Index>(result.map.surfels.size()), 6);
  Eigen::Index row = 0;
  for (const Surfel& surfel : result.map.surfels) {
    rows.row(row++) << surfel.position.x(), surfel.position.y(), std::atan2(surfel.normal.y(), surfel.normal.x()),
        surfel.length_m, surfel.sigma_m, surfel.hits;
  }
  return rows;
}

/// Returns stamp in ns, x (m), y (m) and heading (rad) of each key frame.
std::vector<std::tuple<std::int64_t, double, double, double>> key_frames_of(const MapResult& result) {
  std::vector<std::tuple<std::int64_t, double, double, double>> frames;
  for (std::size_t i = 0; i < std::min(result.map.key_frames.size(), result.map.pose_covariances.size()); ++i) {
    const KeyFrame& frame = result.map.key_frames[i];
    frames.emplace_back(frame.stamp_ns, frame.pose.x(), frame.pose.y(), frame.pose.z());
  }
  return frames;
}

void bind_estimate(py::module& module) {
  py::class_<Estimate>(module, "Estimate")
      .def_readonly("stamp_ns", &Estimate::stamp_ns)
      .def_readonly("valid", &Estimate::valid)
      .def_property_readonly("mode", [](const Estimate& estimate) { return static_cast<int>(estimate.mode); })
      .def_readonly("degenerate", &Estimate::degenerate)
      .def_readonly("map_revision", &Estimate::map_revision)
      .def_readonly("origin_id", &Estimate::origin_id)
      .def_readonly("x_m", &Estimate::x_m)
      .def_readonly("y_m", &Estimate::y_m)
      .def_readonly("heading_rad", &Estimate::heading_rad)
      .def_readonly("covariance", &Estimate::covariance)
      .def_readonly("speed_mps", &Estimate::speed_mps)
      .def_readonly("yaw_rate_radps", &Estimate::yaw_rate_radps)
      .def_property_readonly("message", [](const Estimate& estimate) { return estimate.message.text; })
      .def_property_readonly("problems",
                             [](const Estimate& estimate) { return mtr_core::tuples_of(estimate.message); });
}

void bind_map(py::module& module) {
  py::class_<MapResult>(module, "MapResult")
      .def_readonly("stamp_ns", &MapResult::stamp_ns)
      .def_readonly("map_car_id", &MapResult::map_car_id)
      .def_readonly("revision", &MapResult::revision)
      .def_property_readonly("valid", [](const MapResult& result) { return result.map.valid; })
      .def_property_readonly("surfels", &surfels_of)
      .def_property_readonly("key_frames", &key_frames_of)
      .def_property_readonly("range_bias_m", [](const MapResult& result) { return result.map.range_bias.value_m; })
      .def_property_readonly("message", [](const MapResult& result) { return result.map.message.text; })
      .def_property_readonly("problems",
                             [](const MapResult& result) { return mtr_core::tuples_of(result.map.message); });
}

}  // namespace

PYBIND11_MODULE(mtr_localization_core, module) {
  module.doc() = "The core of localization: from wheels, gyro and sweeps to poses and maps.";
  bind_estimate(module);
  bind_map(module);
  py::class_<RobotLocalizer>(module, "Localizer")
      .def(py::init<const std::string&, bool>(), py::arg("urdf"), py::arg("rear_lidar") = true)
      .def("add_scan", &RobotLocalizer::add_scan, py::arg("is_rear"), py::arg("scan"))
      .def("add_order", &RobotLocalizer::add_order, py::arg("stamp_ns"), py::arg("map_car_id"), py::arg("phase"))
      .def("step", &RobotLocalizer::step, py::arg("stamp_ns"), py::arg("imu"), py::arg("odometry"))
      .def("check_silence", &RobotLocalizer::check_silence, py::arg("now_ns"))
      .def("take_map", &RobotLocalizer::take_map, "The answer to an order to freeze the map, each once.");
}

}  // namespace mtr_localization
