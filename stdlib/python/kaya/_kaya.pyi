"""The engine of kaya. Use the package kaya."""

from os import PathLike
from typing import Any, Callable, Sequence

import numpy as np
from numpy.typing import NDArray

__version__: str

class Error(RuntimeError):
    """What kaya says when something is wrong. str(error) is the whole text with the line and its underline."""

    message: str
    """What is wrong, in one sentence."""
    hint: str
    """What to do; may be empty."""
    code: str
    """The code that `kaya explain` explains; may be empty."""
    context: list[str]
    """Further lines: what was running, and where."""
    file: str | None
    """The deck, or the name of the text; None where there is no place."""
    line: int | None
    """From 1."""
    column: int | None
    """From 1."""
    status: int
    """The exit status of the program: 1 the deck is wrong, 2 the run failed, 3 a fault of kaya."""
    errors: Sequence[Error]
    """All of them, when several were found."""

def help(words: str) -> str:
    """The page on a command, a keyword, a name of FISH or a field. Raises Error for an unknown word."""

def needs_more(text: str) -> bool:
    """Whether a text ends inside a function, a chunk of Lua or a continued line."""

def kinds() -> list[str]:
    """Kinds of objects: "block", "sub_contact", ..."""

def fields(kind: str) -> list[tuple[str, str, str, str, str, bool]]:
    """(name, unit, help, classic FISH, newer FISH, can be set) of each field of a kind, or of "model". Raises KeyError."""

class Handle:
    """An object of a model: it stays the same object while others are made and deleted."""

class Session:
    """One model with its commands, functions and results."""

    def __init__(self, out: Callable[[str], Any], messages: Callable[[str], Any], threads: int, strict: bool, quiet: bool, trust: bool,
                 progress: bool, joints: Sequence[PathLike[str]], own_joints: Sequence[PathLike[str]], painter: PathLike[str]) -> None: ...
    def text(self, commands: str, name: str, caught: bool) -> str:
        """Runs commands, called `name` in messages. Returns what they print when `caught`, else ""."""
    def deck(self, file: str, parameters: dict[str, str]) -> None:
        """Runs a deck with values of `param` lines. Raises Error for a name that the deck does not mention."""
    def completions(self, before: str, line: str) -> tuple[int, list[str]]:
        """How many letters at the end of the line are typed of a word, and the words that fit. `before`: lines of an open function."""
    def count(self, kind: str) -> int:
        """Objects of a kind; contacts are searched when there are none yet."""
    def values(self, kind: str, field: str) -> Any:
        """A copy of a field of all objects."""
    def set_values(self, kind: str, field: str, rows: NDArray[np.int64], values: Any) -> None:
        """Sets a field: one value for all rows, or a list with one for each."""
    def handle(self, kind: str, row: int) -> Handle:
        """An object by its row. Raises IndexError."""
    def row(self, object: Handle) -> int:
        """The row of an object. Raises Error when it was deleted."""
    def nearest(self, kind: str, place: Sequence[float]) -> Handle | None:
        """The object nearest to a place, as block.near of FISH; None where there is none."""
    def quantity(self, name: str) -> Any:
        """A quantity of the whole model."""
    def columns(self) -> dict[str, dict[str, tuple[np.dtype[Any], tuple[int, ...]]]]:
        """Types and shapes of the stored columns by table."""
    def column(self, table: str, column: str) -> NDArray[Any]:
        """The memory of a column, read-only; commands raise BufferError while it is alive."""
    def histories(self) -> list[tuple[int, str, NDArray[np.float64], NDArray[np.float64], NDArray[np.float64]]]:
        """(number, label, times, cycles, values) of each history."""
    def interfaces(self) -> list[dict[str, Any]]:
        """Forces between bodies."""
    def reactions(self) -> dict[str, Any]:
        """Forces of supports."""
    def value(self, expression: str) -> Any:
        """The value of an expression of FISH."""
    def set_value(self, name: str, value: Any) -> None:
        """Sets a variable of FISH."""
    def call_in_cycles(self, function: Callable[[], Any], moment: str, interval: int) -> int:
        """Calls a function in cycles; returns its number for leave_out."""
    def leave_out(self, number: int) -> None:
        """Ends these calls."""
    def interrupt(self) -> None:
        """Ends the run after the present cycle; for any thread."""
    def hash(self) -> int:
        """Digest of the whole state."""
    def warnings(self) -> list[str]:
        """The first hundred warnings."""
    def written(self) -> list[str]:
        """Names of files that commands have written, in their order."""
