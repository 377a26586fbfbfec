"""The names that drivers written for other programs use: `import kaya.itasca as it`.

    it.command("block create brick 0 1 0 1 0 1")
    it.fish.set("x", 3); it.fish.get("x")
    for b in it.block.list(): b.pos_x(), b.vel(), b.set_vel((0, 0, 0))
    it.blockarray.pos()                # an array of numpy

Objects have one method for each name of newer FISH (docs/fields.md): block.subcontact.force.norm is force_norm() of what
it.block.subcontact.list() gives, and set_force_norm(value) where FISH can set it. There is one model; use() takes another.
"""

from __future__ import annotations

from typing import Any, Iterator, Sequence

import numpy as np
from numpy.typing import ArrayLike

from ._kaya import Error, Handle
from .model import Model
from .table import Table

_model: Model | None = None


def model() -> Model:
    """The model of this module, made when it is first needed."""
    global _model
    if _model is None:
        _model = Model()
    return _model


def use(other: Model) -> None:
    """All functions work on that model from now on."""
    global _model
    _model = other


def command(text: str) -> None:
    """Runs one or several lines. Raises kaya.Error."""
    model().command(text)


def cycle() -> int:
    """Cycles done so far."""
    return model().cycle_number


class _Fish:
    def get(self, name: str) -> Any:
        return model().get(name)

    def set(self, name: str, value: Any) -> None:
        model().set(name, value)

    def call_function(self, name: str, arguments: Sequence[Any] = ()) -> Any:
        shown = ", ".join(f"'{a}'" if isinstance(a, str) else repr(a) for a in arguments)
        return model().get(f"{name}({shown})" if arguments else name)


def _table(kind: str) -> Table:
    return Table(model(), kind)


def _methods(kind: str) -> dict[str, str]:
    """{name of the method: field}: the name of newer FISH without that of its kind."""
    fields = _table(kind).fields()
    beginning = _kinds[kind]
    return {info["modern"][len(beginning):].replace(".", "_"): name
            for name, info in fields.items() if info["modern"].startswith(beginning)}


class Object:
    """An object of a model; `id()` is its number. It stays the same object while others are made and deleted; methods of a deleted one raise
    kaya.Error."""

    def __init__(self, model: Model, kind: str, handle: Handle):
        self._table, self._kind, self._handle = Table(model, kind), kind, handle
        self._session = model._session

    def __getattr__(self, name: str) -> Any:
        if name.startswith("_"):
            raise AttributeError(name)
        methods = _methods(self._kind)
        if name in methods:
            return lambda: self._table[methods[name]][self._session.row(self._handle)]
        if name.startswith("set_") and name[4:] in methods:
            return lambda value: self._table.set(methods[name[4:]], value, [self._session.row(self._handle)])
        raise AttributeError(f"a {self._kind} has no method '{name}': {', '.join(methods)}")

    def __repr__(self) -> str:
        try:
            return f"<{self._kind} {self.id()}>"
        except Error:
            return f"<{self._kind}, deleted>"


class _Kind:
    def __init__(self, kind: str, **inner: "_Kind"):
        self._kind = kind
        self.__dict__.update(inner)

    def count(self) -> int:
        return len(_table(self._kind))

    def _object(self, row: int) -> Object:
        return Object(model(), self._kind, model()._session.handle(self._kind, row))

    def list(self) -> Iterator[Object]:
        return iter([self._object(row) for row in range(self.count())])

    def find(self, number: int) -> Object | None:
        """The object with that number; None where there is none."""
        rows = np.flatnonzero(_table(self._kind)["id"] == number)
        return self._object(int(rows[0])) if len(rows) else None

    def near(self, place: ArrayLike) -> Object | None:
        """The object that is nearest to a place, as block.near of FISH: the block that contains it, or whose surface is nearest."""
        found = model()._session.nearest(self._kind, np.asarray(place, dtype=float).tolist())
        return None if found is None else Object(model(), self._kind, found)


class _Array:
    """One function for each name of newer FISH: an array of all objects."""

    def __init__(self, kind: str):
        self._kind = kind

    def __getattr__(self, name: str) -> Any:
        if name.startswith("_"):
            raise AttributeError(name)
        methods = _methods(self._kind)
        if name in methods:
            return lambda: _table(self._kind)[methods[name]]
        if name.startswith("set_") and name[4:] in methods:
            return lambda values: _table(self._kind).set(methods[name[4:]], values)
        raise AttributeError(f"there is no array '{name}': {', '.join(methods)}")


_kinds = {"block": "block.", "gridpoint": "block.gp.", "zone": "block.zone.", "contact": "block.contact.",
          "sub_contact": "block.subcontact.", "face": "block.face."}

fish: Any = _Fish()
block: Any = _Kind("block", gridpoint=_Kind("gridpoint"), zone=_Kind("zone"), contact=_Kind("contact"),
                   subcontact=_Kind("sub_contact"), face=_Kind("face"))
blockarray, gridpointarray, zonearray = _Array("block"), _Array("gridpoint"), _Array("zone")
contactarray, subcontactarray = _Array("contact"), _Array("sub_contact")
