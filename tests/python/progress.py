#!/usr/bin/env python3
"""progress.py PROGRAM: a run shows how far it is in a terminal and where it is asked to, and nothing elsewhere."""

import os
import pty
import re
import signal
import subprocess
import sys
import time
import unittest

try:
    import numpy  # noqa: F401
except ImportError:
    print("skipped: numpy is not installed")
    sys.exit(77)
import kaya

sys.argv.pop()
TWO = "poly brick 0 1 0 1 0 1\npoly brick 0 1 0 1 1 2\nprop mat 1 dens 2000\nprop jmat 1 jkn 1e9 jks 1e9 jfric 30\nfix range z 0 1\n" \
      "gravity 0 0 -10\n"
RUN = f"import kaya\nm = kaya.Model()\nm.command({TWO!r})\nm.on_cycle(lambda: None)\nprint('begins', flush=True)\nm.cycle(100_000_000)\n"


def run_for(model, seconds):
    """Cycles until that time has passed."""
    began = time.monotonic()

    def stop():
        if time.monotonic() - began > seconds:
            raise StopIteration

    off = model.on_cycle(stop, every=100)
    try:
        model.cycle(100_000_000)
    except StopIteration:
        pass
    off()


class Progress(unittest.TestCase):
    def messages(self, **options):
        said = []
        model = kaya.Model(messages=said.append, **options)
        model.command(TWO)
        run_for(model, 0.7)
        return "".join(said)

    def test_where_it_is_asked_for(self):
        for quiet in (True, False):
            text = self.messages(progress=True, quiet=quiet)
            lines = re.findall(r"\rcycle \d+ of \d+  time \S+  ratio \S+  \d+ cycles/s", text)
            self.assertGreaterEqual(len(lines), 2, text)
            self.assertRegex(text, r" \r(cycle [^\r]*\n)?$") # the line is cleared

    def test_nowhere_else(self):
        self.assertEqual(self.messages(), "")
        self.assertEqual(self.messages(progress=False), "")

    def test_in_a_terminal_until_ctrl_c(self):
        ours, theirs = pty.openpty()
        program = subprocess.Popen([sys.executable, "-B", "-c", RUN], stdin=theirs, stdout=subprocess.PIPE, stderr=theirs)
        os.close(theirs)
        self.addCleanup(program.stdout.close)
        program.stdout.readline()
        text = b""
        while text.count(b"\rcycle ") < 3:
            text += os.read(ours, 1000)
        program.send_signal(signal.SIGINT)
        try:
            while rest := os.read(ours, 1000):
                text += rest
        except OSError: # the other end is closed
            pass
        self.assertNotEqual(program.wait(), 0)
        self.assertIn(b"KeyboardInterrupt", text)

    def test_not_in_a_file(self):
        program = subprocess.Popen([sys.executable, "-B", "-c", RUN], stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        self.addCleanup(program.stdout.close)
        program.stdout.readline()
        time.sleep(0.5)
        program.send_signal(signal.SIGINT)
        self.assertNotIn(b"\rcycle", program.communicate()[1])


if __name__ == "__main__":
    unittest.main()
