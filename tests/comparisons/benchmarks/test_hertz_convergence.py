"""The convergence of Hertz's contact: runs that measure what they say, judged rightly."""

import subprocess
import sys
from dataclasses import replace

import numpy as np
import pytest

from comparisons.benchmarks.hertz_convergence import __main__ as hertz_convergence
from comparisons.benchmarks.hertz_convergence.__main__ import Method, demands, table, unknowns_ratio
from comparisons.benchmarks.hertz_convergence.runs import (
    Run,
    _processor_seconds,
    adapted,
    distance,
    equal_edges,
)

RUN = Run(10.0, 1000, 30, 0.5, 0.6, 1e-3, 5e-4, 1e-3, 1e-2, 3e-3, 2e-3)


def method(name, order=1.0, runs=4, cost=0.1):
    """Runs of twice the edges and hats, four times the unknowns; L2 of that order in edges."""
    return Method(
        name,
        tuple(
            replace(
                RUN,
                size=10.0 * 2.0**k,
                unknowns=1000 * 4**k,
                count=30 * 2**k,
                seconds=cost * 4.0**k,
                node=1e-2 * 4.0**-k,
                peak=2e-3 * 4.0**-k,
                hats=1e-2 * 2.0 ** (-order * k),
            )
            for k in range(runs)
        ),
    )


def test_runs_tell_errors_and_cost():
    coarse, fine = equal_edges(5), equal_edges(10)
    assert coarse.seconds > 0.0 and coarse.wall > 0.0
    assert fine.unknowns > 1.5 * coarse.unknowns
    assert fine.count == coarse.count + 10
    assert np.log2(coarse.hats / fine.hats) == pytest.approx(1.0, abs=0.2)
    assert 2e-3 < coarse.node < 3e-2 and 3e-4 < fine.node < 3e-3
    assert fine.peak < 0.5 * fine.node
    assert fine.half_width < 2e-3
    assert fine.tau1 < 5e-3
    own = adapted(1e-2)
    assert own.hats < 1e-2 and own.unknowns < fine.unknowns


def test_processes_that_have_ended_are_counted():
    before = _processor_seconds()
    burn = "import time\nwhile time.process_time() < 0.2: pass"
    subprocess.run([sys.executable, "-c", burn], check=True)
    assert _processor_seconds() - before >= 0.2


def test_distance_of_a_shifted_constant():
    assert distance(lambda x: 0.0 * x + 1.5, lambda x: 0.0 * x + 1.0) == pytest.approx(0.5)


def test_orders_are_fitted():
    equal = method("degree 2")
    assert equal.order("size", "node") == pytest.approx(-2.0)
    assert equal.order("unknowns", "hats") == pytest.approx(-0.5)


def test_cheapest_run_is_one_that_finer_ones_bear_out():
    equal = method("degree 2")
    assert equal.cheapest("peak", 6e-4) is equal.runs[1]
    lucky = Method("lucky", (replace(RUN, peak=1e-9), *equal.runs))
    assert lucky.cheapest("peak", 6e-4) is equal.runs[1]
    assert equal.cheapest("peak", 1e-9) is None


def test_ratio_of_unknowns_at_the_same_error():
    equal, own = method("equal"), method("own", order=2.0)
    found = unknowns_ratio(equal, own)
    assert [error for error, _ in found] == [run.hats for run in own.runs]
    assert [ratio for _, ratio in found] == pytest.approx([1.0, 4.0, 16.0, 64.0])


def judged(**changes):
    found = {
        "degree 2": method("degree 2"),
        hertz_convergence._FEWEST: method("fewest"),
        "degree 2, adapted": Method(
            "degree 2, adapted", method("own", order=2.0, cost=0.2).runs[1:]
        ),
    }
    return [holds for holds, _ in demands(found | changes)]


def test_demands_hold_and_each_can_fail():
    assert judged() == [True] * 6
    slow = Method("degree 2", tuple(replace(r, seconds=99.0) for r in method("").runs))
    own = Method(
        "degree 2, adapted",
        tuple(replace(run, seconds=99.0) for run in method("", order=2.0).runs[1:]),
    )
    fewest = Method("fewest", slow.runs)
    everything = {"degree 2": slow, hertz_convergence._FEWEST: fewest, "degree 2, adapted": own}
    assert judged(**everything) == [False, False, True, True, True, True]
    stalled = Method("degree 2", tuple(replace(r, node=1e-2, hats=1e-2) for r in method("").runs))
    assert judged(**{"degree 2": stalled})[2:4] == [False, False]
    first = Method("degree 2, adapted", method("own").runs)
    assert judged(**{"degree 2, adapted": first})[4:] == [False, False]


def test_table_has_a_line_for_every_run_and_fit():
    lines = table([method("degree 2"), method("other", runs=3)]).splitlines()
    assert len(lines) == 1 + 5 + 4
    assert len({len(line) for line in lines}) == 1


def test_command_runs_all_methods_and_tells_by_its_status(monkeypatch, capsys):
    found = [
        method("degree 2"),
        method(hertz_convergence._FEWEST),
        Method("degree 2, adapted", method("", order=2.0).runs[1:]),
    ]
    monkeypatch.setattr(hertz_convergence, "methods", lambda finest, tolerances: found)
    assert hertz_convergence.main([]) == 0
    assert capsys.readouterr().out.count("holds ") == 6
    found[2] = Method("degree 2, adapted", method("").runs)
    assert hertz_convergence.main([]) == 1
    assert "FAILS " in capsys.readouterr().out
