"""Started by `python -m comparisons.benchmarks.half_plane_peers`."""

from comparisons.benchmarks.half_plane_peers.race import main
from comparisons.benchmarks.harness import run_on_one_thread

if __name__ == "__main__":
    run_on_one_thread(main)
