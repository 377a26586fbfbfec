"""kaya: distinct elements for jointed rock and masonry, from Python.

    import kaya
    m = kaya.Model()
    m.command("poly brick 0 1 0 1 0 1")
    print(m.blocks["volume"])          # an array of numpy, one row for each block
    m = kaya.open("run.kaya.h5")       # a saved model

Words, units and files are those of decks; nothing is converted.
"""

from ._kaya import Error, __version__
from .model import History, Model, help, open, run
from .table import StaleView, Table, View

__all__ = ["Error", "History", "Model", "StaleView", "Table", "View", "help", "open", "run", "__version__"]
