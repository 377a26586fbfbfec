"""Objects of one kind, and columns of the model's memory."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Iterator, Sequence

import numpy as np
from numpy.typing import ArrayLike, DTypeLike, NDArray

from . import _kaya

if TYPE_CHECKING:
    from .model import Model


class Table:
    """All objects of a kind: `m.blocks`, `m.sub_contacts`.

    `table[field]` is a copy of one field of all objects, in the order of rows: float or int of shape (n,), vectors of shape (n, 3), a
    list of texts; for a field that names another object its row in that table, -1 for none. Fields are those of docs/fields.md by each of
    their three names. Raises KeyError for a name that the kind does not have.
    """

    def __init__(self, model: Model, kind: str):
        self._model, self._kind = model, kind

    def __len__(self) -> int:
        return self._model._session.count(self._kind)

    def __getitem__(self, field: str) -> Any:
        return self._model._session.values(self._kind, field)

    def __setitem__(self, field: str, values: Any) -> None:
        """Sets a field of all objects: one value for all, or one for each."""
        self.set(field, values)

    def set(self, field: str, values: Any, rows: ArrayLike | None = None) -> None:
        """Sets a field of these rows (all of them when None): row numbers, or True and False for each row. Raises kaya.Error where the field or a
        value does not allow it, TypeError and IndexError where the rows are neither."""
        chosen = self._rows(rows)
        if isinstance(values, np.ndarray) or (isinstance(values, (list, tuple)) and len(values) == len(chosen) and not _is_vector(values)):
            values = [v.tolist() if isinstance(v, (np.ndarray, np.generic)) else v for v in values]
        self._model._session.set_values(self._kind, field, chosen, values)

    def _rows(self, rows: ArrayLike | None) -> NDArray[np.int64]:
        if rows is None:
            return np.arange(len(self), dtype=np.int64)
        wanted = np.asarray(rows).ravel()
        if wanted.dtype == np.bool_:
            if len(wanted) != len(self):
                raise IndexError(f"{len(wanted)} times True or False for {len(self)} rows")
            return np.flatnonzero(wanted).astype(np.int64)
        if wanted.size and not np.issubdtype(wanted.dtype, np.integer):
            raise TypeError(f"rows are whole numbers, or True and False for each row, not {wanted.dtype}")
        return wanted.astype(np.int64)

    def fields(self) -> dict[str, dict[str, Any]]:
        """{name: {unit, help, classic, modern, writable}}: `unit` is a kind of quantity, such as "stress", in the units of the deck."""
        names = ("unit", "help", "classic", "modern", "writable")
        return {name: dict(zip(names, rest)) for name, *rest in _kaya.fields(self._kind)}

    def keys(self) -> Iterator[str]:
        return iter(self.fields())

    def frame(self, fields: Sequence[str] | None = None) -> Any:
        """A table of pandas with these fields (all that are not vectors, when None); vectors become three columns, x_, y_ and z_."""
        import pandas

        columns: dict[str, Any] = {}
        for field in self.fields() if fields is None else fields:
            values = self[field]
            if isinstance(values, np.ndarray) and values.ndim == 2:
                if fields is not None:
                    for k, axis in enumerate("xyz"):
                        columns[f"{axis}_{field}"] = values[:, k]
            else:
                columns[field] = values
        return pandas.DataFrame(columns)

    def __repr__(self) -> str:
        return f"<{len(self)} {self._kind}: {', '.join(self.keys())}>"


def described(help: str, unit: str) -> str:
    """The help of a field with the kind of its quantity."""
    return help if unit == "-" else f"{help} [{unit}]"


def _is_vector(values: Any) -> bool:
    """Three numbers for three rows are one vector only as a tuple."""
    return isinstance(values, tuple) and len(values) == 3 and all(np.isscalar(v) for v in values)


class View:
    """A column of the model's memory, read without a copy of it.

    `view[rows]` copies these rows only. `with view as array:` gives a read-only array of the memory itself; while it or a
    slice of it is alive, a command raises BufferError. A view follows the model while the number of its rows stays; afterwards it raises
    kaya.StaleView, since its rows may be other objects.
    """

    def __init__(self, model: Model, table: str, column: str):
        self._model, self.table, self.column = model, table, column
        with self as array:
            self.shape, self.dtype = array.shape, array.dtype
            del array

    def _array(self) -> NDArray[Any]:
        array = self._model._session.column(self.table, self.column)
        if hasattr(self, "shape") and array.shape != self.shape:
            raise StaleView(f"{self.table}.{self.column} had shape {self.shape} and has {array.shape}: take a new view")
        return array

    def __enter__(self) -> NDArray[Any]:
        return self._array()

    def __exit__(self, *_: object) -> None:
        pass

    def __getitem__(self, rows: Any) -> Any:
        return np.array(self._array()[rows])

    def __array__(self, dtype: DTypeLike = None, copy: bool | None = None) -> NDArray[Any]:
        return np.array(self._array(), dtype=dtype)

    def __len__(self) -> int:
        return int(self.shape[0])

    def __repr__(self) -> str:
        return f"<view of {self.table}.{self.column}: {self.dtype} {self.shape}>"


class StaleView(RuntimeError):
    """The rows of the table are others than those of the view."""
