"""Sentences for the Operator: code, arguments, and the resulting English sentence.

Each package declares its sentences in one table, its module `problems` (in C++ its header `problems.hpp`). Translations
refer to the code, never to the text.
"""
# SPDX-License-Identifier: Apache-2.0
from dataclasses import dataclass
from string import Formatter
from typing import Callable, Iterator, List, Optional, Protocol, Sequence, Tuple, TypeVar, Union

from .errors import RobotError, figure

# Placeholder for the text of the cause, another problem.
CAUSE = "cause"
Value = Union[str, float]


@dataclass(frozen=True)
class Problem:
    """One sentence for the Operator about a problem, or about what a node does or waits for. False if it is empty.

    Attributes:
        code: stable identifier "package.what"; empty for a text without a code.
        text: the sentence in English.
        arguments: name and formatted value of each placeholder.
        cause: the problem whose text replaces {cause}.
    """

    code: str = ""
    text: str = ""
    arguments: Tuple[Tuple[str, str], ...] = ()
    cause: Optional["Problem"] = None

    def __bool__(self) -> bool:
        return bool(self.text)

    def __str__(self) -> str:
        return self.text

    @property
    def kind(self) -> Tuple[str, ...]:
        """Key that does not change with the numbers in the sentence: a log shows each kind once."""
        return tuple(word for problem in self.chain() for word in (
            problem.code or problem.text, *(value for _, value in problem.arguments if not _is_number(value))))

    def chain(self) -> Iterator["Problem"]:
        """Yield this problem, its cause, the cause's cause and so on; nothing for NO_PROBLEM."""
        problem: Optional[Problem] = self
        while problem:
            yield problem
            problem = problem.cause


NO_PROBLEM = Problem()


def _is_number(text: str) -> bool:
    try:
        float(text)
    except ValueError:
        return False
    return True


class Sentence:
    """A row of a package's table: a call with the values of its placeholders returns the problem.

    Attributes:
        code: stable identifier "package.what", on which translations rely.
        template: English sentence with named placeholders and their formats, as in str.format.
    """

    def __init__(self, code: str, template: str):
        self.code, self.template = code, template

    @property
    def placeholders(self) -> Tuple[str, ...]:
        """Names of the placeholders in the order of the template."""
        return tuple(name for _, name, _, _ in Formatter().parse(self.template) if name)

    def __call__(self, **values: Union[Value, Problem]) -> Problem:
        """Return the problem with these values, where `cause` is a problem; KeyError if a value is missing."""
        parts = list(Formatter().parse(self.template))
        shown = {name: _formatted(values[name], spec or "") for _, name, spec, _ in parts if name}
        text = "".join(literal + (shown[name] if name else "") for literal, name, _, _ in parts)
        cause = values.get(CAUSE)
        return Problem(self.code, text, tuple((name, value) for name, value in shown.items() if name != CAUSE),
                       cause if isinstance(cause, Problem) else None)


class ProblemError(RobotError):
    """An error that is shown to the Operator.

    Attributes:
        problem: its sentence.
    """

    def __init__(self, problem: Problem):
        # Passing the problem itself allows the error to be pickled for another process.
        super().__init__(problem)
        self.problem = problem


def problem_in(error: RobotError) -> Problem:
    """Return the error's problem, or one with only its text."""
    return error.problem if isinstance(error, ProblemError) else Problem(text=str(error))


class ProblemFields(Protocol):
    """Fields of one problem in a message, both in mtr_msgs and in the link's proto."""

    code: str
    names: Sequence[str]
    values: Sequence[str]
    text: str


Message = TypeVar("Message")


def messages_of(problem: Problem, message_type: Callable[..., Message]) -> List[Message]:
    """Return the problem and its causes, outermost first, as messages of this type."""
    return [message_type(code=each.code, names=[name for name, _ in each.arguments],
                         values=[value for _, value in each.arguments], text=each.text) for each in problem.chain()]


def problem_of(messages: Sequence[ProblemFields], text: str) -> Problem:
    """Return the problem in messages of `messages_of`, or one with only the text if there are none."""
    problem: Optional[Problem] = None
    for message in reversed(messages):
        problem = Problem(message.code, message.text, tuple(zip(message.names, message.values)), problem)
    return problem or Problem(text=text)


def _formatted(value: Union[Value, Problem], spec: str) -> str:
    if spec:
        return format(value, spec)
    return str(value) if isinstance(value, (str, Problem)) else figure(value)
