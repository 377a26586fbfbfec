#!/usr/bin/env python3
"""kernel.py PROGRAM: cells of decks as a notebook sends them: results, errors, completion, help, pictures, interrupts, hostile cells."""

import json
import os
import queue
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

try:
    import ipykernel  # noqa: F401
    import numpy  # noqa: F401
    from jupyter_client.kernelspec import KernelSpecManager
    from jupyter_client.manager import KernelManager
except ImportError as missing:
    print(f"skipped: {missing.name} is not installed (scripts/install --python)")
    sys.exit(77)
import kaya

sys.argv.pop()
WALL = "poly brick 0 1 0 1 0 1\npoly brick 0 1 0 1 1 2\nprop mat 1 dens 2000\nprop jmat 1 jkn 1e9 jks 1e9 jfric 30\nfix range z 0 1\n" \
       "gravity 0 0 -10\nhist unbal\n"


class Kernel(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        subprocess.run([sys.executable, "-m", "kaya.kernel", "install", "--prefix", cls.folder.name], check=True, stdout=subprocess.DEVNULL)
        specs = KernelSpecManager(kernel_dirs=[cls.folder.name + "/share/jupyter/kernels"])
        cls.manager = KernelManager(kernel_name="kaya", kernel_spec_manager=specs)
        cls.manager.start_kernel(cwd=cls.folder.name)
        cls.client = cls.manager.client()
        cls.client.start_channels()
        cls.client.wait_for_ready(timeout=60)

    @classmethod
    def tearDownClass(cls):
        cls.client.stop_channels()
        cls.manager.shutdown_kernel(now=True)
        cls.folder.cleanup()

    def run_cell(self, code, **options):
        """(reply, what the streams show, pictures by kind)."""
        shown, pictures = "", []

        def hear(message):
            nonlocal shown
            if message["msg_type"] == "stream":
                shown += message["content"]["text"]
            elif message["msg_type"] == "display_data":
                pictures.append(message["content"]["data"])

        reply = self.client.execute_interactive(code, output_hook=hear, timeout=60, stop_on_error=False, **options)
        return reply["content"], shown, pictures

    def fresh(self):
        self.assertEqual(self.run_cell("new")[0]["status"], "ok")

    def answer(self, number):
        while True:
            reply = self.client.get_shell_msg(timeout=20)
            if reply["parent_header"]["msg_id"] == number:
                return reply["content"]

    def words(self, code, at=None):
        reply = self.answer(self.client.complete(code, len(code) if at is None else at))
        return reply["matches"], reply["cursor_start"], reply["cursor_end"]

    def page(self, code, at):
        reply = self.answer(self.client.inspect(code, at))
        return reply["data"].get("text/plain", "") if reply["found"] else ""

    def test_commands_fish_and_lua_share_one_model(self):
        self.fresh()
        self.assertEqual(self.run_cell(WALL + "cycle 100")[0]["status"], "ok")
        self.assertIn("rigid", self.run_cell("list blocks")[1])
        self.run_cell("def twice(a)\n  twice = 2 * a\nend")
        self.assertIn("14", self.run_cell("def g\n  y = twice(7)\nend\n@g\nprint @y")[1])
        self.assertIn("blocks 2", self.run_cell("%%lua\nlocal n = 0\nfor b in blocks() do n = n + 1 end\nprint('blocks ' .. n)")[1])

    def test_the_bits_are_those_of_a_model(self):
        self.fresh()
        model = kaya.Model()
        model.command(WALL + "cycle 50")
        self.run_cell(WALL)
        self.run_cell("cycle 20")
        self.run_cell("cycle 30")
        self.assertIn(model.hash, self.run_cell("list hash")[1])

    def test_errors_have_line_and_column(self):
        self.fresh()
        reply, _, _ = self.run_cell("poly brick 0 1 0 1 0 1\npoly brik 0 1 0 1 0 1")
        text = "\n".join(reply["traceback"])
        self.assertEqual((reply["status"], reply["ename"]), ("error", "kaya.Error"))
        self.assertRegex(text, r"cell \d+:2:6: error")
        self.assertIn("brick", text)
        reply, _, _ = self.run_cell("%%lua\nlocal x = 1\nerror('mine')")
        self.assertRegex("\n".join(reply["traceback"]), r"cell \d+:3")
        self.assertEqual(self.run_cell("poly brick 0 1 0 1 0 1")[0]["status"], "ok") # the kernel continues

    def test_completes_words_names_and_lua(self):
        self.fresh()
        self.run_cell("def my_own_function\n  my_value = 1\nend\n@my_own_function")
        self.assertEqual(self.words("poly bri"), (["brick"], 5, 8))
        self.assertEqual(self.words("list inter")[0], ["interfaces"])
        self.assertIn("@my_own_function", self.words("@my_o")[0])
        self.assertIn("b_vol", self.words("def f\n  x = b_vo")[0])
        self.assertIn("velocity", self.words("%%lua\nfor b in blocks() do\n  x = b.velo")[0])
        self.assertEqual(self.words("; é𝛼\npoly bri")[1:], (10, 13))
        self.assertEqual(self.words("nosuchcommand nosuch")[0], [])

    def test_shows_help(self):
        for cell in ("poly?", "?poly", "help poly"):
            self.assertIn("poly brick", self.run_cell(cell)[1], cell)
        self.assertIn("cycle", self.run_cell("help")[1])
        self.assertEqual(self.run_cell("nosuchword?")[0]["status"], "error")
        self.assertIn("brick", self.page("poly brick 0 1", 7))
        self.assertIn("brick", self.page("gravity 0 0 -1\npoly brick 0 1", 17))
        self.assertIn("volume", self.page("def f\n  x = b_vol(b)\nend", 16) or self.page("b_vol", 3))
        self.assertEqual(self.page("", 0), "")
        self.assertEqual(self.page("nosuchword", 3), "")

    def test_draws_curves_below_the_cell(self):
        self.fresh()
        reply, _, pictures = self.run_cell(WALL + "cycle 100\nplot hist 1 file curve.svg")
        self.assertEqual(reply["status"], "ok")
        self.assertEqual(len(pictures), 1)
        self.assertIn("<svg", pictures[0]["image/svg+xml"])
        self.assertEqual(self.run_cell("list blocks")[2], [])

    def test_draws_pictures_below_the_cell(self):
        self.fresh()
        _, shown, pictures = self.run_cell(WALL + "cycle 1\nplot block file wall.png")
        if "no picture" in shown:
            self.skipTest("the painter is not built (scripts/install --pictures)")
        self.assertTrue(pictures[0]["image/png"].startswith("iVBOR"))

    def test_knows_unfinished_cells(self):
        for code, status in (("poly brick 0 1", "complete"), ("def f\n  x = 1", "incomplete"), ("poly brick 0 1 &", "incomplete"),
                             ("lua\nprint(1)", "incomplete"), ("def f\nend", "complete")):
            self.assertEqual(self.answer(self.client.is_complete(code))["status"], status, code)

    def test_an_interrupt_ends_the_cell_and_not_the_model(self):
        self.fresh()
        self.run_cell(WALL)
        number = self.client.execute("cycle 100000000", stop_on_error=False)
        shown = ""
        while "\rcycle " not in shown: # progress tells that it runs
            message = self.client.get_iopub_msg(timeout=20)
            shown += message["content"].get("text", "")
        self.manager.interrupt_kernel()
        began = time.monotonic()
        reply = self.answer(number)
        self.assertEqual((reply["status"], reply["ename"]), ("error", "KeyboardInterrupt"))
        self.assertLess(time.monotonic() - began, 5)
        self.assertEqual(self.run_cell("cycle 1")[0]["status"], "ok")
        with self.assertRaises(queue.Empty):
            while True:
                self.client.get_iopub_msg(timeout=0.2)

    def test_hostile_cells(self):
        for code in ("", "\n\n", "%%lua", "%%lua\n", "?", "%%nosuch\npoly", "def f", "lua", "endlua", "x" * 100000, "\x00\x1b[2J", "end\nend",
                     "lua\nwhile true do", "poly brick " + "9" * 400, "\ud7ff é 𝛼", "quit"):
            reply, shown, _ = self.run_cell(code)
            self.assertIn(reply["status"], ("ok", "error"), code[:20])
            self.assertNotIn("\x1b", shown + "".join(reply.get("traceback", [])))
        self.assertEqual(self.run_cell("list blocks")[0]["status"], "ok")

    def test_silent_cells_show_nothing(self):
        self.fresh()
        self.assertEqual(self.run_cell("poly brick 0 1 0 1 0 1\nlist blocks", silent=True)[1:], ("", []))

    def test_the_installed_file_is_that_of_the_build(self):
        installed = json.loads((Path(self.folder.name) / "share/jupyter/kernels/kaya/kernel.json").read_text())
        built = json.loads((Path(kaya.__file__).resolve().parents[1] / "kernel.json").read_text())
        self.assertEqual(installed["argv"][1:], built["argv"][1:])
        self.assertTrue(os.access(built["argv"][0], os.X_OK))
        for words in ([], ["--nosuch"], ["--user", "--prefix", "x"]):
            self.assertEqual(subprocess.run([sys.executable, "-m", "kaya.kernel", "install", *words], capture_output=True).returncode, 2)


if __name__ == "__main__":
    unittest.main()
