"""Started by `python -m tests.half_plane_peers`."""

from tests.half_plane_peers.race import main
from tests.harness import run_on_one_thread

if __name__ == "__main__":
    run_on_one_thread(main)
