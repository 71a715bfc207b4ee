"""A parameter file to begin with is what the scenario proposes, and run and plan take it."""
# SPDX-License-Identifier: Apache-2.0
import pytest

from mtr_operator.cli import main
from mtr_operator.domain.scenarios import SCENARIOS
from mtr_operator.storage.parameter_file import load_parameters


@pytest.mark.parametrize("scenario", list(SCENARIOS))
def test_written_file_has_what_is_proposed(scenario, tmp_path):
    kind, path = SCENARIOS[scenario].parameters_type, tmp_path / "parameters.yaml"
    assert main(["params", scenario, "--write", str(path)]) == 0
    assert load_parameters(path, kind) == kind.from_mapping(kind.proposed())


@pytest.mark.parametrize("scenario", list(SCENARIOS))
def test_written_file_names_every_parameter_with_its_range(scenario, tmp_path):
    kind, path = SCENARIOS[scenario].parameters_type, tmp_path / "parameters.yaml"
    main(["params", scenario, "--write", str(path)])
    text = path.read_text(encoding="utf-8")
    for declared in kind.declarations().values():
        assert f"# {declared.allowed}." in text and f"{declared.file_key}:" in text
    assert all(f"{name}:" in text for name in (*kind.choices(), *kind.flags()))


def test_file_that_is_there_is_not_written_over(tmp_path, capsys):
    path = tmp_path / "mine.yaml"
    path.write_text("attempts: 3")
    assert main(["params", "autolock", "--write", str(path)]) == 2
    assert path.read_text() == "attempts: 3"
    assert capsys.readouterr().err == f"The file {path} is there already; give another name, or remove it.\n"


def test_file_that_cannot_be_written_is_a_sentence(tmp_path, capsys):
    assert main(["params", "autolock", "--write", str(tmp_path / "none" / "a.yaml")]) == 2
    assert "cannot be written: No such file or directory." in capsys.readouterr().err
