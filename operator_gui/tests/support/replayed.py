"""A whole test of a Car that speaks on its bus, recorded, and what a replay of it says."""
# SPDX-License-Identifier: Apache-2.0
import json

from mtr_operator.car_link.spoken_car import SpokenCar
from mtr_operator.cli import main
from mtr_operator.domain.actions.control_loop import ControlLoop
from mtr_operator.domain.exchange.run_context import RunContext
from mtr_operator.domain.results.progress import Progress
from mtr_operator.domain.results.session_record import now, session_record
from mtr_operator.domain.runner import Runner
from mtr_operator.robot_link.fake import FakeRobotLink
from mtr_operator.storage.progress_file import save_progress
from mtr_operator.storage.recorded.recording import Recording


def recorded(folder, scenario, parameters, profile, log_format="blf"):
    """Its progress; the recording lies beside it in the folder."""
    progress = Progress(scenario.name, parameters.to_mapping(), session_record(now(), "substitute", profile))
    spoken = SpokenCar(FakeRobotLink(1), f"{folder}", profile=profile)
    recording = Recording(folder / "progress.json", log_format)
    spoken.connect()
    spoken.car.connect()
    try:
        loop = ControlLoop(spoken, spoken.car, context=RunContext(course=recording.begin(spoken.car)))
        Runner(scenario, parameters, loop, progress, lambda _: None).run()
    finally:
        problems = [problem for problem in recording.end() if problem]
        spoken.car.close()
        spoken.close()
    assert problems == []
    save_progress(folder / "progress.json", progress)
    return progress


def replayed(folder, capsys, *options):
    """Exit code and document of a replay."""
    capsys.readouterr()
    code = main(["replay", str(folder), "--json", *options])
    return code, json.loads(capsys.readouterr().out)
