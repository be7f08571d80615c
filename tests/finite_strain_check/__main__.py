"""Started by `python -m tests.finite_strain_check`."""

from tests.finite_strain_check.check import main
from tests.harness import run_on_one_thread

if __name__ == "__main__":
    run_on_one_thread(main)
