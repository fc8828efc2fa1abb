"""bench/farm_simulator.py on farms whose outcome is known."""
import pathlib
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "bench"))
from farm_simulator import Farm, Simulation  # noqa: E402


def outcome(**farm):
    return Simulation(Farm(**farm)).run()


class Simulator(unittest.TestCase):
    def test_one_node_takes_the_sum_of_all_parts(self):
        # 20 frames of 32 CPU seconds on 16 cores, 2 processes that take 3 s, 1 + 1 s of transfers for each frame.
        out = outcome(nodes=1, frames=20, cpu_seconds=(32.0,), chunk=10, start_s=3, read_mb=100, write_mb=100,
                      storage_mb_s=100)
        self.assertAlmostEqual(out.seconds, 20 * (2 + 1 + 1) + 2 * 3, places=6)
        self.assertAlmostEqual(out.traffic_mb, 4000)

    def test_without_shared_parts_ten_nodes_take_a_tenth(self):
        one, ten = (outcome(nodes=n, frames=1000, cpu_seconds=(16.0,)) for n in (1, 10))
        self.assertAlmostEqual(one.seconds / ten.seconds, 10, places=6)

    def test_shared_storage_bounds_the_frames_per_second(self):
        out = outcome(nodes=500, frames=5000, cpu_seconds=(16.0,), read_mb=50, write_mb=50, storage_mb_s=1000)
        self.assertGreaterEqual(out.seconds, 5000 * 100 / 1000)
        self.assertLess(out.seconds, 1.05 * 5000 * 100 / 1000)

    def test_failures_cost_time_and_no_frame(self):
        calm = outcome(nodes=4, frames=400, cpu_seconds=(160.0,))
        rough = outcome(nodes=4, frames=400, cpu_seconds=(160.0,), hours_to_failure=0.1)
        self.assertGreater(rough.failures, 0)
        self.assertGreater(rough.seconds, calm.seconds)
        self.assertAlmostEqual(rough.busy_s, calm.busy_s)


if __name__ == "__main__":
    unittest.main()
