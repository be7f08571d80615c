"""The benchmark of the laws of cost: it solves levels, and its demands can fail."""

from tests.cost_laws import LevelCost, demands, main


def level(seconds, unknowns=(100, 100), memory=(1e9, 1e9)):
    return LevelCost("made 3", unknowns, seconds, memory)


def test_each_law_fails_beyond_a_factor_of_two():
    good = level((2.0, 1.1))
    assert all(demand.holds for demand in demands([good]))
    for bad in (
        level((2.0, 4.1)),
        level((4.1, 2.0)),
        level((2.0, 2.0), unknowns=(10, 21)),
        level((2.0, 2.0), memory=(4.2e9, 2e9)),
    ):
        assert [demand.holds for demand in demands([good, bad])].count(False) == 1


def test_a_level_is_solved_in_its_own_process(capsys):
    main(["smooth", "--levels", "1"])  # a busy machine may take longer than the law says
    shown = capsys.readouterr().out
    assert "smooth 1" in shown and "holds  expected over measured unknowns" in shown
