"""Wrong scenes and wrong profiles by the thousand: is every one read, or refused in one line?

    python -m tests.mutated_inputs

Shipped scenes, and others that use every field, get one to three mistakes each: another
value from a list of hostile ones, fields and sections that are lost, doubled, renamed or moved,
bytes that are flipped, cut off or put in. Profiles of text and of numpy get the same, under scenes
that read them in all ways. What is left is read, checked and resolved; some scenes are also solved
by the half-plane, at a tiny size, as `run` does.

An input is resolved, or refused by one line that names the file. Anything else is a defect: another
exception, a line that names no file or gives a number that is none, a resolved profile that is not
finite, more than twenty seconds. Exit status 0 only if there is none.
"""

import argparse
import resource
import tempfile
import warnings
from collections import Counter
from pathlib import Path

from analytic.surface.readers import instruments
from tests.harness import Demand, print_demands, print_table, run_on_one_thread

from .inputs import profiles, scenes, tiny_scenes
from .outcomes import outcome, resolve, solve

MOST_MEMORY = 6 * 2**30  # bytes of address space: what asks for more fails here


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--count", type=int, default=10_000, help="of scenes and of profiles")
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_args()
    resource.setrlimit(resource.RLIMIT_AS, (MOST_MEMORY, MOST_MEMORY))
    warnings.simplefilter("ignore")
    # each file that is no text would take a process of its own, and half a second
    instruments._ask = lambda *_: {"problem": "is left to SurfaceTopography"}
    kinds = {
        "scene": (scenes, resolve, options.count),
        "profile": (profiles, resolve, options.count),
        "solved": (tiny_scenes, solve, options.count // 30),
    }
    counts = {kind: Counter() for kind in kinds}
    for kind, (inputs, work, count) in kinds.items():
        with tempfile.TemporaryDirectory() as folder:
            for number, path in inputs(Path(folder), range(count), options.seed):
                word, account = outcome(work, path)
                counts[kind][word] += 1
                if account:
                    print(f"{kind} {number}: {account[:600]}")
    words = sorted({word for count in counts.values() for word in count})
    rows = [(kind, *(str(count[word]) for word in words)) for kind, count in counts.items()]
    print_table("what became of them", ("mutated", *words), rows)
    number = sum(count["DEFECT"] for count in counts.values())
    return print_demands([Demand(number == 0, f"{number} inputs end in a defect")])


if __name__ == "__main__":
    run_on_one_thread(main)
