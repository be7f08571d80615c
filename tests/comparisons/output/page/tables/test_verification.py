"""Tables of verification: no column without a name, words in place of names of fields."""

from scenes import posed

from comparisons.output.page.tables.verification import convergence_tables, refinement_text
from comparisons.studies.model_error.show import effects_table
from comparisons.studies.study import Run


def test_no_column_is_unnamed_or_empty(wavy_outcome: Run, smooth_outcome: Run):
    for outcome in (wavy_outcome, smooth_outcome):
        for table in [*convergence_tables(outcome), effects_table(outcome)]:
            for number, head in enumerate(table.head):
                assert head or number == 0
                assert any(row[number] for row in table.rows), (table.title, head)
            assert {len(row) for row in table.rows} == {len(table.head)}


def test_why_refinement_ended_is_said_in_words(smooth_outcome: Run):
    text = (
        "tau1_max, tau1_max_depth not resolved to a third of the tolerance: 6 levels are the most"
    )
    assert refinement_text(posed(smooth_outcome, refinement=text)) == (
        "largest principal shear stress τ₁, depth of the largest τ₁ not resolved to a third of the "
        "tolerance: 6 levels are the most"
    )
