"""Calibration record as a file, which the Operator's application reads."""
# SPDX-License-Identifier: Apache-2.0
import os
import pathlib
from typing import Any, Dict, Mapping, Optional

import yaml

from .readings import ReadingsUnusable

HEADING = "# Calibration record of a robot; give it to the Operator's application (--calibration FILE).\n"
KEYS = ("robot", "date", "by", "valid_days", "key_ahead_m", "terms")


def load(path: pathlib.Path) -> Optional[Dict[str, Any]]:
    """Return the record in a file; None without a file.

    Raises:
        ReadingsUnusable: the file is not a record.
    """
    try:
        document = yaml.safe_load(path.read_text(encoding="utf-8"))
    except FileNotFoundError:
        return None
    except (OSError, UnicodeDecodeError, yaml.YAMLError) as error:
        raise ReadingsUnusable(f"{path} cannot be read ({_first_line(error)}); move it away, or name another file with "
                               "--record.") from None
    missing = [key for key in KEYS if not isinstance(document, dict) or key not in document]
    if missing:
        raise ReadingsUnusable(f"{path} is no calibration record: {missing[0]} is missing; move it away, or name "
                               "another file with --record.")
    return dict(document)


def save(path: pathlib.Path, document: Mapping[str, Any]) -> None:
    """Write the whole record, or leave the file unchanged.

    Raises:
        ReadingsUnusable: it cannot be written.
    """
    text = HEADING + yaml.safe_dump(dict(document), sort_keys=False, allow_unicode=True)
    beside = path.with_name(path.name + ".new")
    try:
        with open(str(beside), "w", encoding="utf-8") as file:
            file.write(text)
            file.flush()
            os.fsync(file.fileno())
        os.replace(str(beside), str(path))
    except OSError as error:
        raise ReadingsUnusable(f"{path} cannot be written ({error.strerror}); name a file in a folder that is there "
                               "with --record.") from None


def _first_line(error: Exception) -> str:
    return str(error).splitlines()[0]
