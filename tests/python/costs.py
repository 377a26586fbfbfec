#!/usr/bin/env python3
"""costs.py PROGRAM: a view of a million sub-contacts, functions inside cycles and models in threads cost what docs/python.md says."""

import os
import sys
import threading
import time
import unittest

try:
    import numpy as np
except ImportError:
    print("skipped: numpy is not installed")
    sys.exit(77)
import kaya

sys.argv.pop()


def pile(edge, density=2000, threads=1):
    model = kaya.Model(messages=lambda text: None, threads=threads)
    model.command(f"poly brick 0 {edge} 0 {edge} 0 {edge}\njset dip 0 dd 0 org 0 0 0 spacing 1 num 100\n"
                  "jset dip 90 dd 0 org 0 0 0 spacing 1 num 100\njset dip 90 dd 90 org 0 0 0 spacing 1 num 100\n"
                  f"prop mat 1 dens {density}\nprop jmat 1 jkn 1e9 jks 1e9 jfric 30\nfix range z 0 0.9\ngravity 0 0 -10")
    return model


class Costs(unittest.TestCase):
    def test_a_view_of_a_million_sub_contacts(self):
        model = pile(36, threads=0)
        model.cycle(1)
        self.assertGreater(len(model.sub_contacts), 1_000_000)
        began = time.thread_time()
        view = model.view("sub_contacts", "normal_force")
        with view as array:
            self.assertFalse(array.flags.owndata) # no copy
        self.assertLess(time.thread_time() - began, 0.010)

    def test_a_function_at_every_hundredth_cycle(self):
        model = pile(22)
        self.assertGreater(len(model.blocks), 10_000)
        model.cycle(1)
        began = time.process_time()
        model.cycle(100)
        cycles = time.process_time() - began
        began = time.process_time()
        for _ in range(100):
            float(np.abs(model.view("blocks", "velocity")[:]).max())
        self.assertLess((time.process_time() - began) / 100, 0.01 * cycles)

    def test_two_models_in_two_threads(self):
        if os.cpu_count() < 2 or os.getloadavg()[0] > 0.5:
            self.skipTest("the machine has one core, or is busy with other programs")
        found = {}

        def run(which, model):
            model.cycle(3000)
            found[which] = model.hash

        seconds = {}
        for way in ("alone", "together"):
            models = [pile(10, 2000 + 100 * k) for k in range(2)] # larger ones compete for the machine's memory
            threads = [threading.Thread(target=run, args=((way, k), model)) for k, model in enumerate(models)]
            began = time.perf_counter()
            for thread in threads:
                thread.start()
                if way == "alone":
                    thread.join()
            for thread in threads:
                thread.join()
            seconds[way] = time.perf_counter() - began
        self.assertEqual([found["alone", k] for k in range(2)], [found["together", k] for k in range(2)])
        self.assertGreater(seconds["alone"] / seconds["together"], 1.8)


if __name__ == "__main__":
    unittest.main()
