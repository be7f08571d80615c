"""Wrong scenes and wrong profiles by the thousand: is every one read, or refused in one line?

    python -m tests.mutated_inputs

Scenes that come along, and others that use every field, get one to three mistakes each: another
value from a list of hostile ones, fields and sections that are lost, doubled, renamed or moved,
bytes that are flipped, cut off or put in. Profiles of every kind of text, of both kinds of
surface data files, of numpy and MATLAB get the same, under scenes that read them in all ways. What
is left is read, checked and resolved; some scenes are also solved by the half-plane, at a tiny
size, as `run` does, some profiles given to `init`, and folders of results with a mistake in one
file read by what `table`, `rerun` and `report` do.

An input is resolved, or refused by one line that names the file. Anything else is a defect: another
exception, a line that names no file or gives a number that is none, a resolved profile that is not
finite, more than twenty seconds. Exit status 0 only if there is none.
"""

import argparse
import re
import resource
import shutil
import tempfile
import warnings
from collections import Counter
from pathlib import Path

from analytic.surface.readers import instruments
from tests.harness import Demand, print_demands, print_table, run_on_one_thread

from .inputs import profiles, profiles_alone, results, scenes, tiny_scenes
from .outcomes import look, outcome, read_results, resolve, solve

MOST_MEMORY = 6 * 2**30  # bytes of address space: what asks for more fails here
SEED = 1
SHOWN = 20  # defects that are printed


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--count", type=int, default=10_000, help="of scenes and of profiles")
    parser.add_argument("--looked-at", type=int, default=1000, help="profiles given to init")
    parser.add_argument("--solved", type=int, default=300, help="scenes that are solved")
    parser.add_argument("--folders", type=int, default=1000, help="results that are read")
    parser.add_argument(
        "--instruments", action="store_true", help="ask SurfaceTopography for what is no text"
    )
    parser.add_argument("--first", type=int, default=0, help="number of each kind, to go on from")
    parser.add_argument("--seed", type=int, default=SEED)
    parser.add_argument("--only", help="kind and number of one input, such as scene:17")
    options = parser.parse_args()
    resource.setrlimit(resource.RLIMIT_AS, (MOST_MEMORY, MOST_MEMORY))
    warnings.simplefilter("ignore")
    if not options.instruments:  # each file takes a process of its own, and half a second
        instruments._ask = lambda *_: {"problem": "is left to SurfaceTopography"}
    kinds = {
        "scene": (scenes, resolve, options.count),
        "profile": (profiles, resolve, options.count),
        "looked at": (profiles_alone, look, options.looked_at),
        "solved": (tiny_scenes, solve, options.solved),
        "result": (results, read_results, options.folders),
    }
    counts: dict[str, Counter] = {}
    defects: dict[str, list[str]] = {}
    for kind, (inputs, work, count) in kinds.items():
        only = (options.only or "").partition(":")
        if only[0] not in ("", kind):
            continue
        counts[kind] = Counter()
        with tempfile.TemporaryDirectory() as folder:
            one = range(int(only[2]), int(only[2]) + 1) if only[2] else None
            numbers = one or range(count)[options.first :]
            for number, path in inputs(Path(folder), numbers, options.seed):
                if only[2]:
                    shutil.copytree(path.parent, f"mutated-{kind}-{number}")
                word, account = outcome(work, path)
                counts[kind][word] += 1
                if account:
                    place = re.sub(r"[\d.e+-]+", "#", account)
                    defects.setdefault(place, []).append(f"{kind}:{number}  {account}")
    words = sorted({word for count in counts.values() for word in count})
    rows = [(kind, *(str(count[word]) for word in words)) for kind, count in counts.items()]
    print_table("what became of them", ("mutated", *words), rows)
    for like in sorted(defects.values(), key=len, reverse=True)[:SHOWN]:
        print(f"{len(like)} x {like[0][:600]}")
    number = sum(count["DEFECT"] for count in counts.values())
    return print_demands([Demand(number == 0, f"{number} inputs end in a defect")])


if __name__ == "__main__":
    run_on_one_thread(main)
