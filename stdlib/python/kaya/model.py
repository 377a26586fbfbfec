"""Models that are read, made and run from Python."""

from __future__ import annotations

import operator
import os
import shutil
import sys
from pathlib import Path
from typing import Any, Callable, Iterable, NamedTuple

import numpy as np
from numpy.typing import NDArray

from . import _kaya
from .quantities import Quantities
from .table import Table, View

def _own_joints() -> list[Path]:
    """Folders with the joint and zone models of kaya: of a build, of an installation, of a wheel."""
    here = Path(__file__).resolve().parent
    folders = [here / "joints", here.parents[1] / "joints", here.parents[2] / "kaya/joints", Path("/usr/lib/kaya/joints")]
    return [folder for folder in folders if folder.is_dir()]


def _plain(value: Any) -> Any:
    """A scalar of numpy as the number or truth of Python that it is; other values as they are."""
    return value.item() if isinstance(value, np.generic) else value


def _parameter(name: str, value: object) -> str:
    """A value of `param` as a deck writes it. Raises TypeError for what is not a text, a truth or a finite number."""
    plain = _plain(value)
    if isinstance(plain, str):
        return f"'{plain}'"
    if isinstance(plain, (bool, int)) or (isinstance(plain, float) and np.isfinite(plain)):
        return repr(plain)
    raise TypeError(f"the parameter {name} is {value!r}: give a number, True, False or a text")


def _painter() -> Path:
    """The program that draws: of a build, or an installed one; empty where there is none."""
    built = Path(__file__).resolve().parents[2] / "kaya-painter"
    return built if built.exists() else Path(shutil.which("kaya-painter") or "")


def _shows_lines_in_place() -> bool:
    """Whether messages go to a terminal or a notebook."""
    return sys.stderr is not None and (sys.stderr.isatty() or type(sys.stderr).__module__.startswith("ipykernel"))


class History(NamedTuple):
    """A recorded quantity: arrays of the same length."""

    number: int
    label: str
    time: NDArray[np.float64]
    cycle: NDArray[np.float64]
    values: NDArray[np.float64]


class Model(Quantities):
    """One model with its own commands, functions and results; several may exist at once, and run in threads.

    threads: 0 takes all cores, as the program does (of this model); the bits of a result do not depend on it.
    strict: warnings are errors. quiet: results and messages only. trust: scripts may use all of Lua.
    progress: a line that shows how far a run is, renewed in place; by default in terminals and notebooks.
    joints: folders that are searched for joint and zone models. out, messages: functions that take printed text (default: sys.stdout,
    sys.stderr).
    """

    def __init__(self, *, threads: int = 0, strict: bool = False, quiet: bool = True, trust: bool = False,
                 progress: bool | None = None, joints: Iterable[str | os.PathLike[str]] = (),
                 out: Callable[[str], Any] | None = None, messages: Callable[[str], Any] | None = None) -> None:
        listed = [Path(folder) for folder in os.environ.get("KAYA_JOINTS", "").split(":") if folder]
        self._session = _kaya.Session(out or (lambda text: sys.stdout.write(text)), messages or (lambda text: sys.stderr.write(text)),
                                      threads, strict, quiet, trust,
                                      messages is None and _shows_lines_in_place() if progress is None else progress,
                                      [Path(folder) for folder in joints] + listed, _own_joints(), _painter())

    # Running.

    def command(self, text: str) -> None:
        """Runs commands of a deck, classic or modern, one or many lines. Raises kaya.Error; what ran before the error stays done."""
        self._session.text(text, "python", False)

    def capture(self, text: str) -> str:
        """The same; returns what the commands print."""
        return self._session.text(text, "python", True)

    def run(self, deck: str | os.PathLike[str], **parameters: object) -> "Model":
        """Runs a deck. Parameters replace those that it sets with `param`, in this run. Raises kaya.Error for one that the deck does not mention, TypeError for one that is not a number, a truth or a text."""
        shown = {name: _parameter(name, value) for name, value in parameters.items()}
        self._session.deck(os.fspath(deck), shown)
        return self

    def cycle(self, count: int = 1) -> None:
        """Runs that many cycles. Raises TypeError where it is not a whole number."""
        self.command(f"cycle {operator.index(count)}")

    def solve(self, *words: object) -> None:
        """The command `solve` with these words: m.solve("ratio", 1e-6). kaya.help("solve") lists them."""
        self.command(" ".join(["solve", *map(str, words)]))

    def save(self, file: str | os.PathLike[str]) -> None:
        """Writes the whole model into a file (docs/save-files.md)."""
        self.command(f"save '{os.fspath(file)}'")

    def restore(self, file: str | os.PathLike[str]) -> "Model":
        """Replaces the model by a saved one. Raises kaya.Error; the model is then unchanged."""
        self.command(f"restore '{os.fspath(file)}'")
        return self

    def interrupt(self) -> None:
        """Ends a run in another thread after its present cycle."""
        self._session.interrupt()

    def on_cycle(self, function: Callable[[], Any], every: int = 1, moment: str = "after_cycle") -> Callable[[], None]:
        """Calls the function in cycles whose number is a multiple of `every`; moment: before_cycle, after_forces, after_cycle.

        It may read everything, set fields and give commands (those that change the structure wait for the end of the cycle). An exception
        ends the run after the cycle and arrives where the run was called; the model can continue from there. Returns a function that takes it off.
        """
        number = self._session.call_in_cycles(function, moment, every)
        return lambda: self._session.leave_out(number)

    # Reading.

    def quantities(self) -> dict[str, dict[str, Any]]:
        """Quantities of the whole model by name, such as m.time and m.unbalanced_force: {name: {unit, help, ...}}."""
        return Table(self, "model").fields()

    @property
    def histories(self) -> dict[str, History]:
        """Histories by label; those after the first of a label by their number, as text."""
        found: dict[str, History] = {}
        for history in map(lambda row: History(*row), self._session.histories()):
            found.setdefault(history.label if history.label not in found else str(history.number), history)
        return found

    @property
    def hash(self) -> str:
        """Of the whole state: equal for equal bits. The program prints it at the end of a run."""
        return f"{self._session.hash():016x}"

    @property
    def warnings(self) -> list[str]:
        """The first hundred warnings."""
        return self._session.warnings()

    def view(self, table: str, column: str) -> View:
        """A column of the stored state; columns() has their names."""
        return View(self, table, column)

    def columns(self) -> dict[str, dict[str, tuple[np.dtype[Any], tuple[int, ...]]]]:
        """{table: {column: (dtype, shape)}} of the stored state (docs/save-files.md)."""
        return self._session.columns()

    def interfaces(self) -> list[dict[str, Any]]:
        """The interfaces of blocks that touch: block1, block2 (numbers; joined blocks count as one), area, normal (from the first to the
        second), force of the first on the second with its moment about `centre`, the point where it acts, normal_force (compression
        positive), shear_force, utilisation (the shear force over what friction and cohesion can take; None where that is unknown), polygons of
        the common area, rows of the contacts."""
        return self._session.interfaces()

    def reactions(self) -> dict[str, Any]:
        """Forces of supports: groups {name: {held, force, weight}}, and the sums reaction, weight, load, unbalanced."""
        return self._session.reactions()

    # FISH.

    def get(self, expression: str) -> Any:
        """The value of a FISH variable, function or expression: m.get("f(2) + x")."""
        return self._session.value(expression)

    def set(self, name: str, value: Any) -> None:
        """Sets a FISH variable."""
        self._session.set_value(name, _plain(value))

    def __repr__(self) -> str:
        return f"<kaya.Model: {len(self.blocks)} blocks, cycle {self.cycle_number}, time {self.time:g}>"

    @property
    def cycle_number(self) -> int:
        """Cycles done so far."""
        return int(self._session.quantity("cycle"))


def open(file: str | os.PathLike[str], **options: Any) -> Model:
    """A saved model. Options are those of Model."""
    return Model(**options).restore(file)


def run(deck: str | os.PathLike[str], **parameters: object) -> Model:
    """Runs a deck in a new model and returns it."""
    return Model().run(deck, **parameters)


def help(words: str = "") -> str:
    """The page on a command ("poly brick"), a keyword, a statement or function of FISH, or a field; without words the list of commands."""
    return _kaya.help(words)
