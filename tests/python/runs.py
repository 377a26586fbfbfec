#!/usr/bin/env python3
"""runs.py PROGRAM: functions of Python inside cycles, Ctrl-C, and several models at once."""

import os
import signal
import sys
import tempfile
import threading
import time
import traceback
import unittest

try:
    import numpy as np
except ImportError:
    print("skipped: numpy is not installed")
    sys.exit(77)
import kaya

PROGRAM = os.path.realpath(sys.argv.pop())
PILE = """poly brick 0 4 0 4 0 4
jset dip 0 dd 0 org 0 0 0 spacing 1 num 9
jset dip 90 dd 0 org 0 0 0 spacing 1 num 9
jset dip 90 dd 90 org 0 0 0 spacing 1 num 9
prop mat 1 dens {} kn 1e9 ks 1e9 fric 30
prop jmat 1 jkn 1e9 jks 1e9 jfric 30
fix range z 0 0.9
gravity 0 0 -10
"""


def pile(density=2000):
    model = kaya.Model(messages=lambda text: None)
    model.command(PILE.format(density))
    return model


class Host(unittest.TestCase):
    """The process belongs to the program that runs Python."""

    def test_keeps_its_folder_signals_and_timers(self):
        plugins = os.path.join(os.path.dirname(PROGRAM), "tests", "plugins")
        if not os.path.exists(os.path.join(plugins, "works.so")):
            self.skipTest("no library of a user")
        said = []
        model = kaya.Model(joints=[plugins], messages=said.append)
        model.command("poly brick 0 1 0 1 0 1\npoly brick 0 1 0 1 1 2\nprop mat 1 dens 2000\nfix range z 0 1\ngravity 0 0 -10\n"
                      "jmodel model works\njmodel stiffness 1e9\ncycle 10")
        folder = os.getcwd()
        with tempfile.TemporaryDirectory() as other:
            os.chdir(other)
            before = signal.signal(signal.SIGUSR1, lambda *_: None)
            signal.setitimer(signal.ITIMER_PROF, 1000)
            try:
                model.command("cycle 1500")
                self.assertEqual(os.path.realpath(os.getcwd()), os.path.realpath(other))
                self.assertGreater(signal.getitimer(signal.ITIMER_PROF)[0], 0)
                self.assertTrue(callable(signal.getsignal(signal.SIGUSR1)))
            finally:
                os.chdir(folder)
                signal.signal(signal.SIGUSR1, before)
                signal.setitimer(signal.ITIMER_PROF, 0)
        self.assertNotIn("changed", "".join(said))

    def test_may_fork(self):
        model = pile()
        model.cycle(10)
        child = os.fork()
        if child == 0:
            try:
                model.cycle(10)
                os._exit(0)
            except BaseException:
                os._exit(1)
        self.assertEqual(os.waitpid(child, 0)[1], 0)
        model.cycle(10)


class Callbacks(unittest.TestCase):
    def test_come_at_their_cycles(self):
        model, plain, at = pile(), pile(), {"before_cycle": [], "after_forces": [], "after_cycle": []}
        for moment, cycles in at.items():
            model.on_cycle(lambda cycles=cycles: cycles.append(model.cycle_number), every=7, moment=moment)
        model.cycle(30)
        plain.cycle(30)
        self.assertEqual(model.hash, plain.hash)
        for moment, cycles in at.items():
            self.assertEqual(cycles, [7, 14, 21, 28] if moment == "after_cycle" else cycles, moment)
            self.assertEqual(len(cycles), 4 if moment == "after_cycle" else len(cycles), moment)
            self.assertTrue(all(cycle % 7 == 0 for cycle in cycles), moment)

    def test_read_and_write(self):
        model, seen = pile(), []

        def push():
            seen.append(float(np.abs(model.view("blocks", "velocity")[:]).max()))
            model.blocks.set("x_velocity", 0.25, rows=[0])

        off = model.on_cycle(push)
        model.cycle(5)
        self.assertEqual(model.blocks["x_velocity"][0], 0.25)
        off()
        model.cycle(5)
        self.assertEqual(len(seen), 5)

    def test_change_the_structure_after_the_cycle(self):
        model = pile()
        blocks = len(model.blocks)
        off = model.on_cycle(lambda: model.command("delete range z 3.1 4 x 0 1 y 0 1"), every=3)
        model.cycle(3)
        off()
        self.assertEqual(len(model.blocks), blocks - 1)

    def test_an_exception_ends_the_run_and_the_model_goes_on(self):
        model, plain = pile(), pile()

        def fail():
            if model.cycle_number == 4:
                raise ZeroDivisionError("of the test")

        off = model.on_cycle(fail)
        functions = []
        try:
            model.cycle(10)
        except ZeroDivisionError as error: # assertRaises would take its traceback away
            functions = [frame.name for frame in traceback.extract_tb(error.__traceback__)]
        self.assertEqual(functions[-1:], ["fail"])
        self.assertEqual(model.cycle_number, 4)
        off()
        model.cycle(6)
        plain.cycle(10)
        self.assertEqual(model.hash, plain.hash)

    def test_an_array_that_is_kept_ends_the_run(self):
        model, kept = pile(), []

        def keep():
            with model.view("blocks", "velocity") as array:
                kept.append(array)

        off = model.on_cycle(keep)
        with self.assertRaises(BufferError):
            model.cycle(10)
        kept.clear()
        off()
        model.cycle(1)

    def test_wrong_orders(self):
        model = pile()
        for every, moment in ((0, "after_cycle"), (-1, "after_cycle"), (1, "sometimes")):
            with self.assertRaises(ValueError):
                model.on_cycle(lambda: None, every, moment)
        with self.assertRaises(TypeError):
            model.on_cycle(3)

    def test_one_that_removes_itself_and_one_that_ends_the_model(self):
        model, calls = pile(), []

        def once():
            calls.append(1)
            off()

        off = model.on_cycle(once)
        model.cycle(5)
        self.assertEqual(len(calls), 1)
        model.on_cycle(lambda: model.cycle(1))
        try:
            model.cycle(3)
        except kaya.Error as error:
            self.assertTrue(error.message)


class Stopping(unittest.TestCase):
    def test_by_the_keyboard(self):
        model = pile()
        timer = threading.Timer(0.3, os.kill, (os.getpid(), signal.SIGINT))
        timer.start()
        with self.assertRaises(KeyboardInterrupt):
            model.cycle(100_000_000)
        timer.join()
        before = model.cycle_number
        model.cycle(2)
        self.assertEqual(model.cycle_number, before + 2)
        self.assertEqual(signal.getsignal(signal.SIGINT), signal.default_int_handler)

    def test_by_another_thread(self):
        model, heard = pile(), []

        def other():
            time.sleep(0.2)
            try:
                model.time
            except RuntimeError as error:
                heard.append(str(error))
            model.interrupt()

        thread = threading.Thread(target=other)
        thread.start()
        with self.assertRaisesRegex(kaya.Error, "stopped"):
            model.cycle(100_000_000)
        thread.join()
        self.assertEqual(heard, ["the model runs in another thread"])


class Several(unittest.TestCase):
    def test_in_threads_as_one_after_the_other(self):
        def run(density, cycles):
            model = pile(density)
            model.cycle(cycles)
            return model.hash

        orders = [(2000 + 50 * k, 60 + 10 * k) for k in range(4)]
        expected = [run(*order) for order in orders]
        found = [None] * len(orders)
        threads = [threading.Thread(target=lambda k=k: found.__setitem__(k, run(*orders[k]))) for k in range(len(orders))]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual(found, expected)

    def test_do_not_know_each_other(self):
        one, two = kaya.Model(), kaya.Model()
        one.set("x", 1)
        two.set("x", 2)
        one.command("poly brick 0 1 0 1 0 1")
        self.assertEqual((one.get("x"), two.get("x"), len(two.blocks)), (1, 2, 0))


if __name__ == "__main__":
    os.chdir(tempfile.mkdtemp())
    unittest.main()
