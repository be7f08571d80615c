"""The growth of the half-plane solver's cost: judged rightly, printed for every size."""

import re

import pytest

from comparisons.benchmarks.half_plane_scaling import Growth, demands, main


def grown(count, power=1.0, overhead=1.5, memory=200.0):
    pair = 1e-9 * count**power
    return Growth(count, 40.0 * overhead * pair, 9, 40.0, pair, int(memory * count))


@pytest.mark.parametrize(
    ("changed", "holds"),
    [({}, True), ({"power": 1.3}, False), ({"overhead": 2.1}, False), ({"power": 1.1}, True)],
)
def test_demands_on_time(changed, holds):
    rows = [grown(count, **changed) for count in (16384, 65536, 262144)]
    assert all(demand.holds for demand in demands("", rows)) is holds


def test_memory_has_to_grow_with_the_nodes_alone():
    rows = [grown(65536), grown(262144, memory=300.0)]
    assert [demand.holds for demand in demands("", rows)] == [True, True, False]


def test_every_size_is_printed(capsys):
    main(["--sizes", "1024", "2048", "--repeats", "1"])
    shown = capsys.readouterr().out
    assert len(re.findall(r"│ +(1024|2048) │", shown)) == 4
    assert shown.count("time as n^") == 2
