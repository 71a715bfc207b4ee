"""The direction of dependence: pure code imports only pure code, and no layer reaches over its border."""
# SPDX-License-Identifier: Apache-2.0
import ast
import pathlib
from typing import AbstractSet, Dict, Iterable, Iterator, List, Set, Tuple

from catkin_pkg.package import parse_package
from project import TOP, imports, package_folder, package_folders, tracked

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
         "inject.py", "replay.py", "service_call.py"}
# Packages whose job is the border itself, or whose shells have names of their own (SHELLS).
BORDER_PACKAGES = {"mtr_benchmarks", "mtr_commissioning", "mtr_graph_watch", "mtr_motion_check", "mtr_recording"}


# Lock-step, and the robot in one process, whose parts hand each other messages.
OF_ROS = {"lockstep", "cores"}


def robot_files() -> Iterator[pathlib.Path]:
    """Python files of the robot's packages; tests, set-up and what is made of ROS excluded."""
    for package in sorted(PACKAGES.iterdir()):
        if package.name not in BORDER_PACKAGES:
            yield from (path for path in sorted((package / "src").rglob("*.py")) if not OF_ROS & set(path.parts))


def operator_files(folder: pathlib.Path = OPERATOR) -> Iterator[pathlib.Path]:
    """Python files of the Operator's application."""
    yield from sorted(folder.rglob("*.py"))


def outside(folder: str, files: Iterable[pathlib.Path]) -> List[pathlib.Path]:
    """Files that are not below a folder of this name."""
    return [path for path in files if folder not in path.parts]


def core(files: Iterable[pathlib.Path]) -> List[pathlib.Path]:
    """Files of a robot package without the shell that may import ROS."""
    return [path for path in files if path.name not in SHELL]


def violations(files: Iterable[pathlib.Path], forbidden: AbstractSet[str]) -> Dict[str, List[str]]:
    """Forbidden imports of each file that has some, by its path in the project; there must be files."""
    files = list(files)
    assert files, "The rule applies to no file."
    found = {str(path.relative_to(TOP)): sorted(imports(path) & forbidden) for path in files}
    return {path: names for path, names in found.items() if names}


def test_there_are_files_to_look_at():
    assert len(list(robot_files())) > 20
    assert len(list(operator_files())) > 10


def test_robot_core_imports_no_ros():
    assert violations(core(robot_files()), ROS | ROS_MESSAGES | ROS_OF_CORE) == {}


# Files of packages with many programs that listen to the robot, start it, or read and play bags.
SHELLS = {
    "mtr_commissioning": {"preflight/command_line.py", "preflight/listening.py", "calibration/command_line.py",
                          "calibration/robot.py", "base_contract/command_line.py", "standstill/command_line.py"},
    "mtr_graph_watch": {"node.py", "master.py"},
    "mtr_motion_check": {"bag.py"},
    "mtr_recording": {"command_line.py", "bags.py", "listening.py", "player.py", "relay.py"},
}


def checking_files() -> Iterator[pathlib.Path]:
    """Files of these packages that decide, without their shells."""
    for package, shell in SHELLS.items():
        folder = PACKAGES / package / "src" / package
        assert all((folder / name).is_file() for name in shell)
        yield from (path for path in sorted(folder.rglob("*.py")) if str(path.relative_to(folder)) not in shell)


def test_checks_calibration_and_recording_import_no_ros():
    assert violations(checking_files(), ROS | ROS_MESSAGES | ROS_OF_CORE) == {}


def test_robot_imports_nothing_of_the_operator():
    assert violations(robot_files(), QT | {"mtr_operator"}) == {}


def test_shared_core_imports_neither_ros_nor_sockets():
    shared = [path for path in core(robot_files()) if "mtr_core" in path.parts]
    assert violations(shared, ROS | ROS_MESSAGES | SOCKETS | CAN | QT) == {}


def test_operator_imports_no_ros():
    assert violations(operator_files(), ROS | ROS_MESSAGES | OWN_ROBOT) == {}


def test_domain_is_pure():
    forbidden = QT | SOCKETS | CAN | {"yaml", "tqdm", "matplotlib", "mtr_proto", "google"}
    assert violations(operator_files(OPERATOR / "domain"), forbidden) == {}


def test_only_the_gui_imports_qt():
    assert violations(outside("gui", operator_files()), QT) == {}


def test_only_the_robot_link_speaks_zeromq_and_protobuf():
    assert violations(outside("robot_link", operator_files()), {"zmq", "mtr_proto", "google"}) == {}


def test_only_the_car_link_speaks_can():
    assert violations(outside("car_link", operator_files()), CAN) == {}


# Writes Parquet where the store's package is there, and says so where it is not.
PARQUET = "parquet.py"


def test_the_application_works_without_the_store_of_results():
    assert violations(operator_files(), {"mtr_results", "mtr_campaign", "sqlalchemy", "alembic"}) == {}
    assert violations([path for path in operator_files() if path.name != PARQUET], {"duckdb"}) == {}


def test_parquet_is_imported_only_when_it_is_written():
    path, = (path for path in operator_files() if path.name == PARQUET)
    top = ast.parse(path.read_text(encoding="utf-8")).body
    names = {alias.name for node in top if isinstance(node, ast.Import) for alias in node.names}
    assert "duckdb" not in names | {str(node.module) for node in top if isinstance(node, ast.ImportFrom)}


# What the store takes of the application: what decides, reads and reports, neither links nor windows.
LIVE = {f"mtr_operator.{folder}" for folder in ("robot_link", "car_link", "station", "gui", "doctor")}


def test_the_store_of_results_knows_neither_ros_nor_qt_nor_links():
    live = {name for path in operator_files(RESULTS) for name in imports(path)
            for folder in LIVE if name == folder or name.startswith(f"{folder}.")}
    forbidden = ROS | ROS_MESSAGES | OWN_ROBOT | QT | CAN | {"zmq", "serial", "mtr_proto"} | live
    assert violations(operator_files(RESULTS), forbidden) == {}


def test_the_store_of_results_works_without_campaigns():
    assert violations(operator_files(RESULTS), {"mtr_campaign", "dask", "distributed", "optuna", "SALib"}) == {}


def test_campaigns_know_neither_ros_nor_qt_nor_sockets():
    assert violations(operator_files(CAMPAIGN), ROS | ROS_MESSAGES | QT | CAN | SOCKETS | {"mtr_proto"}) == {}


def test_only_kernels_know_the_simulation():
    files = outside("kernels", operator_files(CAMPAIGN))
    assert violations(files, {"mtr_simulation", "mtr_core"}) == {}


def without_databases() -> Iterator[pathlib.Path]:
    """Files of the store of results that leave databases to others."""
    yield from (path for path in operator_files(RESULTS)
                if not {"model", "store", "migrations"} & set(path.parts) and path.name != "export.py")


def test_only_model_and_store_speak_to_databases():
    assert violations(without_databases(), {"sqlalchemy", "alembic", "duckdb"}) == {}


def test_launch_files_have_no_python_and_no_package_imports_them():
    tests = TOP / "launch" / "tests"
    assert [path for path in (TOP / "launch").rglob("*.py") if tests not in path.parents] == []
    files = [path for path in tracked("*.py") if path.parent != tests / "unit"]
    assert violations(files, {"mtr_bringup"}) == {}


def circles(name: str, needed: Dict[str, Set[str]], above: Tuple[str, ...] = ()) -> Iterator[Tuple[str, ...]]:
    """Chains of packages from this one that come back to one of theirs."""
    if name in above:
        yield (*above, name)
    else:
        for below in sorted(needed[name]):
            yield from circles(below, needed, (*above, name))


def test_no_circle_of_packages():
    packages = [parse_package(str(folder)) for folder in package_folders()]
    names = {package.name for package in packages}
    needed = {package.name: {depend.name for kind in (package.build_depends, package.exec_depends,
                                                      package.build_export_depends) for depend in kind} & names
              for package in packages}
    assert sum(map(len, needed.values())) > 50
    assert [chain for name in sorted(needed) for chain in circles(name, needed)] == []


def test_messages_and_proto_depend_on_nothing_local():
    for package in ("mtr_msgs", "mtr_proto"):
        text = (package_folder(package) / "package.xml").read_text(encoding="utf-8")
        assert text.count("mtr_") == 1, f"{package} depends on another package of the project"
