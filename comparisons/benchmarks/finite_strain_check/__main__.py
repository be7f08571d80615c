"""Started by `python -m comparisons.benchmarks.finite_strain_check`."""

from comparisons.benchmarks.finite_strain_check.check import main
from comparisons.benchmarks.harness import run_on_one_thread

if __name__ == "__main__":
    run_on_one_thread(main)
