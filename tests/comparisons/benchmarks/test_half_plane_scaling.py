"""The growth of the half-plane solver's time: judged rightly, printed for every size."""

import re

import pytest

from comparisons.benchmarks.half_plane_scaling import demand, main


@pytest.mark.parametrize(("power", "holds"), [(1.0, True), (1.1, True), (1.3, False)])
def test_the_demand_is_on_the_slope(power, holds):
    times = {count: 1e-7 * count**power for count in (16384, 65536, 262144)}
    assert demand("", times).holds is holds


def test_every_size_is_printed(capsys):
    main(["--sizes", "1024", "2048", "--repeats", "1"])
    shown = capsys.readouterr().out
    assert len(re.findall(r"│ +(1024|2048) │", shown)) == 4
    assert shown.count("time as n^") == 2
