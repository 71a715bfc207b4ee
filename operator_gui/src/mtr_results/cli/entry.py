"""Entry point of the command line, with one handler for every error."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import sys

from mtr_operator.cli.exit_codes import EXIT_ERROR, EXIT_INTERRUPTED
from mtr_operator.domain.errors import OperatorError
from mtr_operator.terminal import show_error


def main(arguments: list[str] | None = None) -> int:
    """Run a command and return the exit code."""
    try:
        from .commands import parser
        options = parser().parse_args(arguments)
        return int(options.run(options))
    except OperatorError as error:
        show_error(error)
        return EXIT_ERROR
    except KeyboardInterrupt:
        print("Interrupted.", file=sys.stderr)
        return EXIT_INTERRUPTED
    except BrokenPipeError:
        # The reader closed the pipe, for example `head`.
        sys.stderr.close()
        return EXIT_ERROR
    except ModuleNotFoundError as error:
        if error.name is None or error.name.startswith("mtr_"):
            raise
        print(f'The package {error.name} is not installed; pip install "operator_gui/[results]" installs all of them.',
              file=sys.stderr)
        return EXIT_ERROR
