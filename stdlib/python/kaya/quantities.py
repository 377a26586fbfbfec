"""The tables and quantities of a model, made from the engine's table of fields. quantities.pyi has them for editors (scripts/python-stubs)."""

from __future__ import annotations

from typing import Any

from . import _kaya
from .table import Table, described


def _class_of(kind: str) -> type[Table]:
    """The class `SubContacts` of the kind sub_contact; its docstring lists the fields."""
    fields = _kaya.fields(kind)
    text = f"All objects of the kind {kind}. Fields, with * where they can be set:\n\n" + "".join(
        f"    {name}{'*' if writable else ''}: {described(help, unit)}\n" for name, unit, help, *_, writable in fields)
    return type(kind.title().replace("_", "") + "s", (Table,), {"__doc__": text, "__module__": __name__})


def _table(kind: str, of_kind: type[Table]) -> property:
    return property(lambda self: of_kind(self, kind), doc=f"Objects of the kind {kind}.")


def _quantity(name: str, unit: str, help: str) -> property:
    return property(lambda self: self._session.quantity(name), doc=described(help, unit))


_METHODS = ("cycle",)  # Model.cycle(n) runs; cycle_number is the quantity
_classes = {kind: _class_of(kind) for kind in _kaya.kinds()}
_members: dict[str, Any] = {name: _quantity(name, unit, help) for name, unit, help, *_ in _kaya.fields("model") if name not in _METHODS}
_members |= {kind + "s": _table(kind, of_kind) for kind, of_kind in _classes.items()}
globals().update({of_kind.__name__: of_kind for of_kind in _classes.values()})

Quantities = type("Quantities", (), {"__doc__": "What a model has: a table of each kind of object, and quantities of the whole.",
                                     "__module__": __name__} | _members)
