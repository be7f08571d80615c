"""Grids on one process are solved in the test's own: none has to begin."""

from contextlib import nullcontext

import pytest

from comparisons.common.tasks import Tasks
from comparisons.grid import points


@pytest.fixture(scope="session", autouse=True)
def here():
    real = points.tasks_by

    def tasks_by(workers, kept):
        return nullcontext(Tasks(kept=kept)) if str(workers) == "1" else real(workers, kept)

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(points, "tasks_by", tasks_by)
        yield
