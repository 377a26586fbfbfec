"""A kernel for Jupyter whose cells are decks: commands in either dialect, FISH, Lua.

    python3 -m kaya.kernel install --user      # or --sys-prefix, or --prefix FOLDER
    jupyter console --kernel kaya

A cell that begins with %%lua is Lua. `words?` shows the help on these words, `words ?` what may follow them. Pictures and curves that a
cell writes as .png or .svg appear below it.
"""

from __future__ import annotations

import argparse
import base64
import json
import sys
from pathlib import Path
from typing import Any

from . import Error, Model, __version__, _kaya, help

try:
    from ipykernel.kernelapp import IPKernelApp
    from ipykernel.kernelbase import Kernel
except ImportError:
    sys.exit("kaya.kernel needs ipykernel: scripts/install --python, or the package python3-ipykernel of Debian")

MOST_PICTURES = 12  # of one cell; a movie has more


def deck_of(cell: str) -> str:
    """The cell as lines of a deck; line numbers stay."""
    first, end, rest = cell.partition("\n")
    return f"lua{end}{rest}\nendlua" if first.strip() == "%%lua" else cell


def open_lines(text: str) -> str:
    """The last lines of a text that are inside a function, a chunk of Lua or a continued line; "" when there are none."""
    above = ""
    for line in text.splitlines(keepends=True):
        above += line
        if not _kaya.needs_more(above):
            above = ""
    return above


def asked(cell: str) -> str | None:
    """The words of `help poly`, `poly?` and `?poly`; None for other cells."""
    words = cell.strip()
    if "\n" in words:
        return None
    if words == "help" or words.startswith("help "):
        return words[4:].strip()
    if words.startswith("?"):
        return words[1:].strip()
    return words[:-1] if words.endswith("?") and not words.endswith(" ?") else None


def page_at(code: str, position: int) -> str:
    """The help on the command or word at a place of a cell; "" when there is none."""
    begin = code.rfind("\n", 0, position) + 1
    end = code.find("\n", position)
    line = code[begin:end if end >= 0 else len(code)]
    words, typed = line.split(), line[:position - begin].split()
    at = max(len(typed) - 1, 0) if not line[:position - begin].endswith(" ") else len(typed)
    word = "".join(c for c in (words[at] if at < len(words) else "") if c.isalnum() or c in "_.-")
    for name in ([" ".join(words[:2]), words[0]] if at < 2 and words else []) + [word]:
        try:
            if name and (name == word or words[at] in name.split()):
                return help(name)
        except Error:
            continue
    return ""


class KayaKernel(Kernel):
    implementation = "kaya"
    implementation_version = __version__
    language_info = {"name": "kaya", "mimetype": "text/x-kaya", "file_extension": ".3dd", "pygments_lexer": "text"}
    banner = f"kaya {__version__}: commands, FISH, Lua"

    def __init__(self, **options: Any) -> None:
        super().__init__(**options)
        self.model = Model()

    def do_execute(self, code: str, silent: bool, store_history: bool = True, user_expressions: Any = None,
                   allow_stdin: bool = False, *, cell_id: Any = None) -> dict[str, Any]:
        for stream in (sys.stdout, sys.stderr):
            stream.set_parent(self.get_parent("shell"))  # type: ignore[attr-defined]
        before = len(self.model._session.written())
        reply: dict[str, Any] = {"status": "ok", "payload": [], "user_expressions": {}}
        try:
            words = asked(code)
            if words is not None:
                print(help(words), end="")
            else:
                self.model._session.text(deck_of(code), f"cell {self.execution_count}", silent)
        except (Error, KeyboardInterrupt) as problem:
            name = "kaya.Error" if isinstance(problem, Error) else "KeyboardInterrupt"
            said = str(problem) or "stopped by the keyboard; the model can continue"
            reply = {"status": "error", "ename": name, "evalue": getattr(problem, "message", said), "traceback": said.split("\n")}
        for stream in (sys.stdout, sys.stderr):
            stream.flush()
        if not silent:
            self.show_pictures(self.model._session.written()[before:])
            if reply["status"] == "error":
                self.send_response(self.iopub_socket, "error", {key: value for key, value in reply.items() if key != "status"})
        return reply | {"execution_count": self.execution_count}

    def show_pictures(self, files: list[str]) -> None:
        pictures = [file for file in dict.fromkeys(map(Path, files)) if file.suffix in (".png", ".svg") and file.is_file()]
        for file in pictures[:MOST_PICTURES]:
            kind, data = ("image/svg+xml", file.read_text()) if file.suffix == ".svg" else \
                ("image/png", base64.b64encode(file.read_bytes()).decode())
            self.send_response(self.iopub_socket, "display_data", {"data": {kind: data, "text/plain": str(file)}, "metadata": {}})
        if more := pictures[MOST_PICTURES:]:
            print(f"... and {len(more)} more pictures, to {more[-1]}", flush=True)

    def do_complete(self, code: str, cursor_pos: int) -> dict[str, Any]:
        typed = deck_of(code[:cursor_pos]).removesuffix("\nendlua")
        above, line = typed.rpartition("\n")[::2]
        size, words = self.model._session.completions(open_lines(above + "\n"), line)
        letters = len(line.encode()[-size:].decode(errors="ignore")) if size else 0
        return {"status": "ok", "matches": words, "cursor_start": cursor_pos - letters, "cursor_end": cursor_pos, "metadata": {}}

    def do_inspect(self, code: str, cursor_pos: int, detail_level: int = 0, omit_sections: Any = ()) -> dict[str, Any]:
        text = page_at(code, cursor_pos)
        return {"status": "ok", "found": bool(text), "data": {"text/plain": text} if text else {}, "metadata": {}}

    def do_is_complete(self, code: str) -> dict[str, str]:
        return {"status": "incomplete", "indent": "  "} if _kaya.needs_more(code) else {"status": "complete"}


def specification(python: str = sys.executable) -> dict[str, Any]:
    """What Jupyter reads to start the kernel."""
    return {"argv": [python, "-m", "kaya.kernel", "-f", "{connection_file}"], "display_name": "kaya", "language": "kaya"}


def install(words: list[str]) -> None:
    """Tells Jupyter of the kernel."""
    parser = argparse.ArgumentParser("python3 -m kaya.kernel install", description="install the kernel for Jupyter")
    place = parser.add_mutually_exclusive_group(required=True)
    place.add_argument("--user", action="store_true", help="for you")
    place.add_argument("--sys-prefix", action="store_true", help="into the present environment")
    place.add_argument("--prefix", help="into this folder")
    order = parser.parse_args(words)
    if order.user:
        from jupyter_core.paths import jupyter_data_dir

        share = Path(jupyter_data_dir())
    else:
        share = Path(order.prefix or sys.prefix) / "share/jupyter"
    folder = share / "kernels/kaya"
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "kernel.json").write_text(json.dumps(specification(), indent=2) + "\n")
    print(f"installed: {folder}")


if __name__ == "__main__":
    if sys.argv[1:2] == ["install"]:
        install(sys.argv[2:])
    else:
        IPKernelApp.launch_instance(kernel_class=KayaKernel)
