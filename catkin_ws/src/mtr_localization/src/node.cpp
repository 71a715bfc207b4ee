/// @file
/// Wiring of localization: topics to the core and back.
// SPDX-License-Identifier: Apache-2.0
#include "mtr_localization/node.hpp"

#include <diagnostic_msgs/DiagnosticArray.h>
#include <rosgraph_msgs/Clock.h>

#include <utility>

#include "mtr_core/clock.hpp"
#include "mtr_core/names.hpp"
#include "mtr_localization/conversions.hpp"
#include "mtr_localization/diagnostics.hpp"
#include "mtr_localization/map_messages.hpp"

namespace mtr_localization {
namespace {

namespace names = mtr_core::names;

constexpr double kPeriodS = static_cast<double>(mtr_core::kLocalization.period_ns) * 1e-9;

LocalizerParameters in_lockstep(LocalizerParameters parameters) {
  parameters.lockstep = mtr_core::is_simulated();
  return parameters;
}

template <typename M, typename Callback>
ros::Subscriber subscribe(ros::NodeHandle& node, const char* topic, Callback callback) {
  return node.subscribe<M>(
      topic, 100, [callback](const typename M::ConstPtr& message) { callback(*message); }, ros::VoidConstPtr(),
      ros::TransportHints().tcpNoDelay());
}

}  // namespace

NodeParameters Node::read(mtr_core::ParameterReader& reader) {
  NodeParameters parameters;
  reader.read_numbers(kRows, parameters.localizer.motion);
  reader.read_numbers(kTrackingRows, parameters.localizer.tracking);
  reader.read_numbers(mtr_surfel_map::kAdjustmentRows, parameters.localizer.adjustment);
  reader.read("publish_odom_tf", parameters.publish_odom_tf);
  std::string pose_source = "own";
  reader.read("pose_source", pose_source, {"own", "external"});
  parameters.localizer.external = pose_source == "external";
  return parameters;
}

Node::Node(ros::NodeHandle& node, const NodeParameters& parameters)
    : parameters_(parameters),
      localizer_(in_lockstep(parameters.localizer)),
      poses_(node.advertise<mtr_msgs::LocalizedPose>(names::kLocalizedPose, 50)),
      surfaces_(node.advertise<mtr_msgs::SurfaceMap>(names::kSurfaceMap, 1, true)),
      grids_(node.advertise<nav_msgs::OccupancyGrid>(names::kMapGrid, 1, true)),
      markers_(node.advertise<visualization_msgs::MarkerArray>(names::kLocalizationMarkers, 1)),
      diagnostics_(node.advertise<diagnostic_msgs::DiagnosticArray>("/diagnostics", 10)),
      listener_(frames_),
      front_(node, Lidar::kFront, frames_, [this](Sweep sweep) { receive_sweep(std::move(sweep)); }),
      rear_(node, Lidar::kRear, frames_, [this](Sweep sweep) { receive_sweep(std::move(sweep)); }),
      navsat_(node, frames_, [this](const NavsatSample& fix) { return localizer_.add_fix(fix); }),
      orders_heard_(mtr_core::kCarLocator, mtr_core::kClockStep.period_ns, input_waiting()),
      orders_(subscribe<mtr_msgs::MappingOrder>(node, names::kMappingOrder,
                                                [this](const auto& message) { receive_order(message); })),
      imu_(subscribe<sensor_msgs::Imu>(
          node, names::kImuData, [this](const auto& message) { publish(localizer_.add_imu(imu_sample_of(message))); })),
      wheels_(subscribe<nav_msgs::Odometry>(
          node, names::kWheelOdometry, [this](const auto& message) { waiting_.push_back(wheel_sample_of(message)); })) {
  watch_silence(node);
}

void Node::spin() {
  while (mtr_core::run_callbacks(mtr_core::kShutdownCheckS)) {
    answer_waiting();
  }
}

void Node::answer_waiting() {
  while (!waiting_.empty()) {
    const WheelSample wheels = waiting_.front();
    waiting_.pop_front();
    answer(wheels);
  }
}

void Node::watch_silence(ros::NodeHandle& node) {
  if (mtr_core::is_simulated()) {
    // By the simulated clock's own steps, so that silence is noticed at the same instant on any machine.
    clock_ = node.subscribe<rosgraph_msgs::Clock>(
        "/clock", 1,
        [this](const rosgraph_msgs::Clock::ConstPtr& message) {
          publish(localizer_.check_silence(mtr_core::to_ns(message->clock)));
        },
        ros::VoidConstPtr(), ros::TransportHints().tcpNoDelay());
  } else {
    timer_ = node.createWallTimer(ros::WallDuration(kPeriodS), [this](const ros::WallTimerEvent&) {
      publish(localizer_.check_silence(mtr_core::to_ns(ros::Time::now())));
    });
  }
}

void Node::receive_sweep(Sweep sweep) {
  if (!mtr_core::is_simulated()) {
    // A node that was woken late has heard both at once: the wheels came first.
    answer_waiting();
  }
  const std::int64_t end_ns = sweep.end_ns();
  const bool is_good = localizer_.add_scan(std::move(sweep));
  const std::string& problem = localizer_.keeper().sweeps().problem();
  if (!is_good && problem != scan_problem_) {
    ROS_WARN("%s It is not used; %d were refused so far.", problem.c_str(), localizer_.keeper().sweeps().refused());
  }
  scan_problem_ = problem;
  const WorkLoad::Watch watch;
  // On the robot's own clock a scan is used at once; the next pose comes with the next wheel odometry.
  if (localizer_.use_scans()) {
    load_.add(watch.elapsed_ms(), 1);
    if (!parameters_.localizer.external) {
      const PoseVector odom = localizer_.map_from_odom();
      transforms_.sendTransform(transform_message(end_ns, {names::kMap, names::kOdom, odom.x(), odom.y(), odom.z()}));
    }
  }
}

void Node::receive_order(const mtr_msgs::MappingOrder& message) {
  const MapOrder order = order_of(message);
  orders_heard_.add(order.stamp_ns, order.stamp_ns);
  localizer_.set_order(order);
}

void Node::answer(const WheelSample& wheels) {
  front_.wait_until_due(wheels.stamp_ns);
  rear_.wait_until_due(wheels.stamp_ns);
  if (orders_.getNumPublishers() > 0) {
    orders_heard_.at(wheels.stamp_ns);
  }
  hear_other_localization();
  const int scans_before = localizer_.keeper().sweeps().used();
  const WorkLoad::Watch watch;
  const std::vector<Estimate> estimates = localizer_.add_wheels(wheels);
  load_.add(watch.elapsed_ms(), localizer_.keeper().sweeps().used() - scans_before);
  publish(estimates);
}

void Node::hear_other_localization() {
  if (!parameters_.localizer.external) {
    return;
  }
  try {
    const auto map_from_odom = frames_.lookupTransform(names::kMap, names::kOdom, ros::Time(0));
    localizer_.set_external(mtr_core::to_ns(map_from_odom.header.stamp), pose_of(map_from_odom.transform));
  } catch (const tf2::TransformException&) {
    // Not there yet: the localizer says that it waits for it.
  }
}

void Node::publish(const std::vector<Estimate>& estimates) {
  // Before the first pose that is in it.
  if (const auto result = localizer_.take_map()) {
    publish_map(*result);
  }
  for (const Estimate& estimate : estimates) {
    poses_.publish(message_of(estimate));
    publish_transforms(estimate);
    publish_each_second(estimate);
    log(estimate);
  }
}

void Node::publish_map(const MapResult& result) {
  surfaces_.publish(message_of(result));
  if (result.map.valid) {
    // With another SLAM, /map is that one's.
    if (!parameters_.localizer.external) {
      grids_.publish(grid_message_of(result));
    }
    ROS_INFO("Map %u: %zu surfaces of %zu key-frames, range bias %.1f mm.", result.revision, result.map.surfels.size(),
             result.map.key_frames.size(), 1e3 * result.map.range_bias_m);
  } else {
    ROS_WARN("The key-frames gave no map. %s", result.map.message.c_str());
  }
}

void Node::publish_transforms(const Estimate& estimate) {
  const bool is_reckoned = parameters_.publish_odom_tf;
  const auto& odom = is_reckoned ? estimate.odom : estimate.wheel_odom;
  std::vector<geometry_msgs::TransformStamped> messages;
  if (!parameters_.localizer.external) {
    messages.push_back(map_from_odom_message(estimate, odom));
  }
  if (is_reckoned) {
    messages.push_back(transform_message(estimate.stamp_ns, {names::kOdom, names::kBase, odom[0], odom[1], odom[2]}));
  }
  transforms_.sendTransform(messages);
}

void Node::publish_each_second(const Estimate& estimate) {
  const std::int64_t second = estimate.stamp_ns / mtr_core::kSecondNs;
  if (second == told_second_) {
    return;
  }
  told_second_ = second;
  diagnostics_.publish(diagnostics_of(localizer_, estimate, load_));
  if (markers_.getNumSubscribers() > 0) {
    markers_.publish(markers_of(localizer_.keeper(), estimate));
  }
}

void Node::log(const Estimate& estimate) {
  if (estimate.message == message_) {
    return;
  }
  message_ = estimate.message;
  if (message_.empty()) {
    ROS_INFO("Tracking; gyro bias %.5f rad/s.", localizer_.filter().gyro_bias_radps());
  } else if (localizer_.motion_state() == MotionState::kStarting) {
    ROS_INFO("%s", message_.c_str());
  } else {
    ROS_WARN("%s", message_.c_str());
  }
}

}  // namespace mtr_localization
