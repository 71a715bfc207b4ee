"""What a node says to the Operator: a code, arguments, and the English sentence that they make.

Each package declares its sentences in one table, its module `problems` (in C++ its header `problems.hpp`); whoever
translates does it by code and never by text.
"""
# SPDX-License-Identifier: Apache-2.0
from dataclasses import dataclass
from string import Formatter
from typing import Callable, Iterator, List, Optional, Protocol, Sequence, Tuple, TypeVar, Union

from .errors import RobotError, figure

# Placeholder for the text of another problem, the cause.
CAUSE = "cause"
Value = Union[str, float]


@dataclass(frozen=True)
class Problem:
    """One sentence for the Operator: what is wrong, or what a node waits for or does. False when there is none.

    Attributes:
        code: stable word "package.what"; empty for a text that comes without one.
        text: the sentence in English.
        arguments: name and value of each placeholder, as they stand in the text.
        cause: the problem whose text stands for {cause}.
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
        """What stays the same while the numbers in the sentence change: a log says each kind once."""
        return tuple(word for problem in self.chain() for word in (
            problem.code or problem.text, *(value for _, value in problem.arguments if not _is_number(value))))

    def chain(self) -> Iterator["Problem"]:
        """This problem, its cause, the cause of that and so on; nothing when there is no problem."""
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
    """A row of a package's table: calling it with the values of its placeholders makes the problem.

    Attributes:
        code: stable word "package.what", a promise to whoever translates.
        template: English sentence with named placeholders and their formats, as in str.format.
    """

    def __init__(self, code: str, template: str):
        self.code, self.template = code, template

    @property
    def placeholders(self) -> Tuple[str, ...]:
        """Names of the placeholders in the order of the template."""
        return tuple(name for _, name, _, _ in Formatter().parse(self.template) if name)

    def __call__(self, **values: Union[Value, Problem]) -> Problem:
        """The problem with these values, `cause` with a problem; KeyError when a placeholder has none."""
        parts = list(Formatter().parse(self.template))
        shown = {name: _formatted(values[name], spec or "") for _, name, spec, _ in parts if name}
        text = "".join(literal + (shown[name] if name else "") for literal, name, _, _ in parts)
        cause = values.get(CAUSE)
        return Problem(self.code, text, tuple((name, value) for name, value in shown.items() if name != CAUSE),
                       cause if isinstance(cause, Problem) else None)


class ProblemError(RobotError):
    """An error that is told to the Operator.

    Attributes:
        problem: its sentence.
    """

    def __init__(self, problem: Problem):
        # The problem itself, so that the error can come from another process.
        super().__init__(problem)
        self.problem = problem


def problem_in(error: RobotError) -> Problem:
    """The error's problem; its text alone when it has none."""
    return error.problem if isinstance(error, ProblemError) else Problem(text=str(error))


class ProblemFields(Protocol):
    """What a message says of one problem, in mtr_msgs as in the link's proto."""

    code: str
    names: Sequence[str]
    values: Sequence[str]
    text: str


Message = TypeVar("Message")


def messages_of(problem: Problem, message_type: Callable[..., Message]) -> List[Message]:
    """The problem and its causes, outermost first, as messages of this type."""
    return [message_type(code=each.code, names=[name for name, _ in each.arguments],
                         values=[value for _, value in each.arguments], text=each.text) for each in problem.chain()]


def problem_of(messages: Sequence[ProblemFields], text: str) -> Problem:
    """The problem in messages of `messages_of`; the text alone when its sender knows no codes."""
    problem: Optional[Problem] = None
    for message in reversed(messages):
        problem = Problem(message.code, message.text, tuple(zip(message.names, message.values)), problem)
    return problem or Problem(text=text)


def _formatted(value: Union[Value, Problem], spec: str) -> str:
    if spec:
        return format(value, spec)
    return str(value) if isinstance(value, (str, Problem)) else figure(value)
