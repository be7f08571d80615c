"""Workers on other machines: those of a Dask cluster, as an executor of `concurrent.futures`, which
queues what it gets."""

from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import FIRST_COMPLETED, Executor, Future, wait
from contextlib import contextmanager
from functools import partial

from comparisons.common.errors import InputError
from comparisons.common.tasks import Opens, carried_out


class ExecutorWorker:
    """Worker for one task at a time in an executor."""

    def __init__(self, executor: Executor, serve: object = None) -> None:
        self._executor, self._future = executor, Future()

    def send(self, work: Callable[..., object], *args: object) -> None:
        self._future = self._executor.submit(carried_out, work, *args)

    def receive(self) -> tuple[str, object]:
        """Raises EOFError for all that no task raises, as Dask where its process has ended."""
        try:
            return "answer", self._future.result()
        except Exception as error:
            raise EOFError(str(error)) from error

    def how_it_ended(self) -> str:
        return f"was lost: {self._future.exception()}"

    def kill(self) -> None:
        """End the task where it has not begun."""
        self._future.cancel()

    @staticmethod
    def ready(workers: Sequence["ExecutorWorker"], timeout: float) -> list["ExecutorWorker"]:
        done = wait([worker._future for worker in workers], timeout, FIRST_COMPLETED).done
        return [worker for worker in workers if worker._future in done]


@contextmanager
def cluster(scheduler: str) -> Iterator[Opens]:
    """The workers of a Dask scheduler at an address such as tcp://host:8786. How many tasks each
    works on at once, and OMP_NUM_THREADS, are set there: 1 is best for both. Raises InputError
    where there is no scheduler, or Dask is not installed."""
    try:
        from distributed import Client
    except ImportError as error:
        raise InputError(
            f"--workers: {scheduler} needs Dask; allowed is a number, or: pip install distributed"
        ) from error
    try:
        client = Client(scheduler)
    except (OSError, ValueError) as error:
        raise InputError(f"--workers: {scheduler} does not answer as a Dask scheduler") from error
    with client:
        yield partial(ExecutorWorker, client.get_executor(pure=False))
