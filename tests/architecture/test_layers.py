"""The direction of dependence: pure code imports only pure code, and no layer reaches over its border."""
# SPDX-License-Identifier: Apache-2.0
import ast
import pathlib
from typing import Iterator

import pytest
from project import TOP, imports, package_folder

PACKAGES = TOP / "catkin_ws" / "src"
OPERATOR = TOP / "operator_gui" / "src" / "mtr_operator"
RESULTS = TOP / "operator_gui" / "src" / "mtr_results"
CAMPAIGN = TOP / "operator_gui" / "src" / "mtr_campaign"

ROS = {"rospy", "roslib", "rostest", "rosbag", "roslaunch", "tf2_ros", "tf", "actionlib"}
ROS_MESSAGES = {"std_msgs", "sensor_msgs", "nav_msgs", "geometry_msgs", "rosgraph_msgs", "visualization_msgs",
                "diagnostic_msgs", "mtr_msgs", "genpy"}
QT = {"PyQt5", "qasync", "pyqtgraph"}
SOCKETS = {"socket", "zmq", "serial", "asyncio"}
CAN = {"can", "cantools"}
OWN_ROBOT = {"mtr_core"}
# The parts of mtr_core that are made of ROS.
ROS_OF_CORE = {"mtr_core.lockstep", "mtr_core.conversions"}

# Files of a robot package that may import ROS: the shell around the core.
SHELL = {"node.py", "conversions.py", "robot_description.py", "connections.py", "sensors.py", "calibrate_lift.py",
         "inject.py", "replay.py"}
# Packages whose job is the border itself.
BORDER_PACKAGES = {"mtr_benchmarks", "mtr_bringup", "mtr_tests"}


def robot_files() -> Iterator[pathlib.Path]:
    """Python files of the robot's packages; tests, set-up and what is made of ROS excluded."""
    for package in sorted(PACKAGES.iterdir()):
        if package.name not in BORDER_PACKAGES:
            yield from (path for path in sorted((package / "src").rglob("*.py")) if "lockstep" not in path.parts)


def operator_files(folder: pathlib.Path = OPERATOR) -> Iterator[pathlib.Path]:
    """Python files of the Operator's application."""
    yield from sorted(folder.rglob("*.py"))


def ids(path: pathlib.Path) -> str:
    """Path within the project."""
    return str(path.relative_to(TOP)) if path.is_relative_to(TOP) else str(path)


def test_there_are_files_to_look_at():
    assert len(list(robot_files())) > 20
    assert len(list(operator_files())) > 10


@pytest.mark.parametrize("path", [path for path in robot_files() if path.name not in SHELL], ids=ids)
def test_robot_core_imports_no_ros(path):
    assert not imports(path) & (ROS | ROS_MESSAGES | ROS_OF_CORE)


def preflight_files() -> Iterator[pathlib.Path]:
    """Checks of the preflight, in a package of the border, without its two files that listen to the robot."""
    files = (TOP / "launch" / "src" / "mtr_bringup" / "preflight").rglob("*.py")
    yield from (path for path in sorted(files) if path.name not in ("command_line.py", "listening.py"))


def calibration_files() -> Iterator[pathlib.Path]:
    """Guided calibration, without the file that listens to the robot and the one that starts it."""
    files = (TOP / "launch" / "src" / "mtr_bringup" / "calibration").rglob("*.py")
    yield from (path for path in sorted(files) if path.name not in ("command_line.py", "robot.py"))


def recording_files() -> Iterator[pathlib.Path]:
    """Profiles of a recording and the comparison with its replay, without the files that read, play and
    record bags."""
    files = (TOP / "launch" / "src" / "mtr_bringup" / "recording").rglob("*.py")
    of_ros = ("command_line.py", "bags.py", "motion.py", "player.py", "relay.py")
    yield from (path for path in sorted(files) if path.name not in of_ros)


def base_contract_files() -> Iterator[pathlib.Path]:
    """Checks of a base, without the file that listens to the robot."""
    files = (TOP / "launch" / "src" / "mtr_bringup" / "base_contract").rglob("*.py")
    yield from (path for path in sorted(files) if path.name != "command_line.py")


def graph_watch_files() -> Iterator[pathlib.Path]:
    """The watch of the graph, without its node."""
    files = (TOP / "launch" / "src" / "mtr_bringup" / "graph_watch").rglob("*.py")
    yield from (path for path in sorted(files) if path.name != "node.py")


@pytest.mark.parametrize("path", [*preflight_files(), *calibration_files(), *recording_files(), *base_contract_files(),
                                  *graph_watch_files()],
                         ids=ids)
def test_checks_calibration_and_recording_import_no_ros(path):
    assert not imports(path) & (ROS | ROS_MESSAGES | ROS_OF_CORE)


@pytest.mark.parametrize("path", list(robot_files()), ids=ids)
def test_robot_imports_nothing_of_the_operator(path):
    assert not imports(path) & (QT | {"mtr_operator"})


@pytest.mark.parametrize("path", [path for path in robot_files() if "mtr_core" in path.parts
                                  and path.name not in SHELL], ids=ids)
def test_shared_core_imports_neither_ros_nor_sockets(path):
    assert not imports(path) & (ROS | ROS_MESSAGES | SOCKETS | CAN | QT)


@pytest.mark.parametrize("path", list(operator_files()), ids=ids)
def test_operator_imports_no_ros(path):
    assert not imports(path) & (ROS | ROS_MESSAGES | OWN_ROBOT)


@pytest.mark.parametrize("path", list(operator_files(OPERATOR / "domain")), ids=ids)
def test_domain_is_pure(path):
    assert not imports(path) & (QT | SOCKETS | CAN | {"yaml", "tqdm", "matplotlib", "mtr_proto", "google"})


@pytest.mark.parametrize("path", [path for path in operator_files() if "gui" not in path.parts], ids=ids)
def test_only_the_gui_imports_qt(path):
    assert not imports(path) & QT


@pytest.mark.parametrize("path", [path for path in operator_files() if "robot_link" not in path.parts], ids=ids)
def test_only_the_robot_link_speaks_zeromq_and_protobuf(path):
    assert not imports(path) & {"zmq", "mtr_proto", "google"}


@pytest.mark.parametrize("path", [path for path in operator_files() if "car_link" not in path.parts], ids=ids)
def test_only_the_car_link_speaks_can(path):
    assert not imports(path) & CAN


# Writes Parquet where the store's package is there, and says so where it is not.
PARQUET = "parquet.py"


@pytest.mark.parametrize("path", list(operator_files()), ids=ids)
def test_the_application_works_without_the_store_of_results(path):
    engine = set() if path.name == PARQUET else {"duckdb"}
    assert not imports(path) & ({"mtr_results", "mtr_campaign", "sqlalchemy", "alembic"} | engine)


def test_parquet_is_imported_only_when_it_is_written():
    path, = (path for path in operator_files() if path.name == PARQUET)
    top = ast.parse(path.read_text(encoding="utf-8")).body
    names = {alias.name for node in top if isinstance(node, ast.Import) for alias in node.names}
    assert "duckdb" not in names | {str(node.module) for node in top if isinstance(node, ast.ImportFrom)}


# What the store takes of the application: what decides, reads and reports, neither links nor windows.
LIVE = {f"mtr_operator.{folder}" for folder in ("robot_link", "car_link", "station", "gui", "doctor")}


@pytest.mark.parametrize("path", list(operator_files(RESULTS)), ids=ids)
def test_the_store_of_results_knows_neither_ros_nor_qt_nor_links(path):
    found = imports(path)
    assert not found & (ROS | ROS_MESSAGES | OWN_ROBOT | QT | CAN | {"zmq", "serial", "mtr_proto"})
    assert not {name for name in found for folder in LIVE if name == folder or name.startswith(f"{folder}.")}


@pytest.mark.parametrize("path", list(operator_files(RESULTS)), ids=ids)
def test_the_store_of_results_works_without_campaigns(path):
    assert not imports(path) & {"mtr_campaign", "dask", "distributed", "optuna", "SALib"}


@pytest.mark.parametrize("path", list(operator_files(CAMPAIGN)), ids=ids)
def test_campaigns_know_neither_ros_nor_qt_nor_sockets(path):
    assert not imports(path) & (ROS | ROS_MESSAGES | QT | CAN | SOCKETS | {"mtr_proto"})


@pytest.mark.parametrize("path", [path for path in operator_files(CAMPAIGN) if "kernels" not in path.parts], ids=ids)
def test_only_kernels_know_the_simulation(path):
    assert not imports(path) & {"mtr_simulation", "mtr_core", "mtr_bringup"}


def without_databases() -> Iterator[pathlib.Path]:
    """Files of the store of results that leave databases to others."""
    yield from (path for path in operator_files(RESULTS)
                if not {"model", "store", "migrations"} & set(path.parts) and path.name != "export.py")


@pytest.mark.parametrize("path", list(without_databases()), ids=ids)
def test_only_model_and_store_speak_to_databases(path):
    assert not imports(path) & {"sqlalchemy", "alembic", "duckdb"}


def test_messages_and_proto_depend_on_nothing_local():
    for package in ("mtr_msgs", "mtr_proto"):
        text = (package_folder(package) / "package.xml").read_text(encoding="utf-8")
        assert text.count("mtr_") == 1, f"{package} depends on another package of the project"
