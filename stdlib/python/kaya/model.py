"""Models that are read, made and run from Python."""

from __future__ import annotations

import os
import sys
from pathlib import Path
from typing import Any, Callable, NamedTuple

import numpy as np

from . import _kaya
from .table import Table, View

_TABLES = {kind + "s": kind for kind in _kaya.kinds()}


def _own_joints() -> list[Path]:
    """Folders with the joint and zone models of kaya: of a build, of an installation, of a wheel."""
    here = Path(__file__).resolve().parent
    folders = [here / "joints", here.parents[1] / "joints", here.parents[2] / "kaya/joints", Path("/usr/lib/kaya/joints")]
    return [folder for folder in folders if folder.is_dir()]


class History(NamedTuple):
    """A recorded quantity: arrays of the same length."""

    number: int
    label: str
    time: np.ndarray
    cycle: np.ndarray
    values: np.ndarray


class Model:
    """One model with its own commands, functions and results; several may exist at once, and run in threads.

    threads: 0 takes all cores, as the program does (one number for all models of the process); the bits of a result do not depend on it.
    strict: warnings are errors. quiet: no progress, only results and messages. trust: scripts may use all of Lua.
    joints: folders that are searched for joint and zone models. out, messages: functions that take printed text (default: sys.stdout,
    sys.stderr).
    """

    def __init__(self, *, threads: int = 0, strict: bool = False, quiet: bool = True, trust: bool = False, joints=(),
                 out: Callable[[str], Any] | None = None, messages: Callable[[str], Any] | None = None):
        listed = [Path(folder) for folder in os.environ.get("KAYA_JOINTS", "").split(":") if folder]
        self._session = _kaya.Session(out or (lambda text: sys.stdout.write(text)), messages or (lambda text: sys.stderr.write(text)),
                                      threads, strict, quiet, trust, [Path(folder) for folder in joints] + listed, _own_joints())

    # Running.

    def command(self, text: str) -> None:
        """Runs commands of a deck, classic or modern, one or many lines. Raises kaya.Error; what ran before the error stays done."""
        self._session.text(text, "python", False)

    def capture(self, text: str) -> str:
        """The same; returns what the commands print."""
        return self._session.text(text, "python", True)

    def run(self, deck: str | os.PathLike, **parameters) -> "Model":
        """Runs a deck. Parameters replace those that it sets with `param`."""
        for name, value in parameters.items():
            shown = f"'{value}'" if isinstance(value, str) else repr(value)
            self._session.text(f"param {name} = {shown}", "python", False)
        self._session.deck(os.fspath(deck))
        return self

    def cycle(self, count: int = 1) -> None:
        self.command(f"cycle {int(count)}")

    def solve(self, *words) -> None:
        """solve("ratio", 1e-6)"""
        self.command(" ".join(["solve", *map(str, words)]))

    def save(self, file: str | os.PathLike) -> None:
        self.command(f"save '{os.fspath(file)}'")

    def restore(self, file: str | os.PathLike) -> "Model":
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

    def __getattr__(self, name: str):
        if name.startswith("_"):
            raise AttributeError(name)
        if name in _TABLES:
            return Table(self, _TABLES[name])
        try:
            return self._session.quantity(name)
        except KeyError:
            raise AttributeError(f"a model has no '{name}'; quantities() and dir() list what it has") from None

    def __dir__(self):
        return [*super().__dir__(), *_TABLES, *self.quantities()]

    def quantities(self) -> dict[str, dict[str, Any]]:
        """Quantities of the whole model by name, such as m.time and m.unbalanced_force: {name: {unit, help, ...}}."""
        return Table(self, "model").fields()

    @property
    def histories(self) -> dict[str, History]:
        """Histories by label."""
        return {history[1]: History(*history) for history in self._session.histories()}

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

    def columns(self) -> dict[str, dict[str, tuple]]:
        """{table: {column: (dtype, shape)}} of the stored state (docs/save-files.md)."""
        return self._session.columns()

    def interfaces(self) -> list[dict[str, Any]]:
        """The interfaces of blocks that touch: block1, block2 (numbers; joined blocks count as one), area, normal (from the first to the
        second), force of the first on the second with its moment about `centre`, the point where it acts, normal_force (compression
        positive), shear_force, polygons of the common area, rows of the contacts."""
        return self._session.interfaces()

    def reactions(self) -> dict[str, Any]:
        """Forces of supports: groups {name: {held, force, weight}}, and the sums reaction, weight, load, unbalanced."""
        return self._session.reactions()

    # FISH.

    def get(self, expression: str):
        """The value of a FISH variable, function or expression: m.get("f(2) + x")."""
        return self._session.value(expression)

    def set(self, name: str, value) -> None:
        """Sets a FISH variable."""
        self._session.set_value(name, value)

    def __repr__(self) -> str:
        return f"<kaya.Model: {len(self.blocks)} blocks, cycle {self.cycle_number}, time {self.time:g}>"

    @property
    def cycle_number(self) -> int:
        """Cycles done so far."""
        return self._session.quantity("cycle")


def open(file: str | os.PathLike, **options) -> Model:
    """A saved model. Options are those of Model."""
    return Model(**options).restore(file)


def run(deck: str | os.PathLike, **parameters) -> Model:
    """Runs a deck in a new model and returns it."""
    return Model().run(deck, **parameters)
