"""Started by `python -m tests.finite_strain_check`."""

from comparisons.benchmarks.harness import run_on_one_thread
from tests.finite_strain_check.check import main

if __name__ == "__main__":
    run_on_one_thread(main)
