"""The processes that solve: on this machine or behind a Dask scheduler, one thread each."""

from __future__ import annotations

import os
import sys
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from importlib.util import find_spec
from typing import Any

from surrogate.errors import InputError, MissingExtraError, WirecutError

__all__ = ["Workers", "backend", "use_one_thread", "watched"]

#: Threads of the libraries in each process: with one, the data do not depend on the machine's load.
_ONE_THREAD = {
    "MKL_NUM_THREADS": "1",
    "OMP_NUM_THREADS": "1",
    "OPENBLAS_NUM_THREADS": "1",
    "NUMBA_NUM_THREADS": "1",
}

#: How often finished rows are looked for, on a terminal and where the bar goes to a file [s].
_LOOK, _LOOK_FOR_FILE = 0.5, 60.0


@dataclass(frozen=True, slots=True)
class Workers:
    """Where tasks are solved.

    Parameters
    ----------
    jobs : int
        Processes on this machine.
    scheduler : str, optional
        Address of a Dask scheduler, whose workers are taken instead.
    """

    jobs: int = 1
    scheduler: str | None = None


def use_one_thread() -> None:
    """Hold the numerical libraries of this process to one thread."""
    os.environ.update(_ONE_THREAD)  # for libraries that are not loaded yet
    from threadpoolctl import threadpool_limits

    threadpool_limits(1)


@contextmanager
def backend(workers: Workers) -> Iterator[None]:
    """Direct joblib to processes of this machine or to a Dask scheduler."""
    from joblib import parallel_config
    from joblib.externals.loky.process_executor import TerminatedWorkerError

    again = "finished rows are kept; run the same command again"
    if workers.scheduler is None:
        try:
            with parallel_config("loky", n_jobs=workers.jobs, inner_max_num_threads=1):
                yield
        except TerminatedWorkerError:
            raise WirecutError(
                f"a process died, perhaps for want of memory; {again}, with fewer --jobs."
            ) from None
        return
    if find_spec("distributed") is None:
        raise MissingExtraError(
            "Dask is not installed; get it with: pip install 'wirecut[cluster]', or leave out "
            "--backend dask."
        )
    from distributed import Client
    from distributed.scheduler import KilledWorker

    try:
        client = Client(workers.scheduler, timeout="10s", set_as_default=True)
    except (OSError, ValueError) as error:
        raise InputError(
            f"no Dask scheduler answers at {workers.scheduler!r} ({error}); give the address that "
            "it printed when it was started, such as tcp://10.0.0.1:8786."
        ) from None
    with client:
        try:
            with parallel_config("dask", n_jobs=-1):
                yield
        except KilledWorker as error:
            raise WirecutError(f"workers died again and again ({error}); {again}.") from None


@contextmanager
def watched(total: float, form: str, look: Callable[[Any], None]) -> Iterator[None]:
    """Show a bar which a thread brings up to date, by `look`, until the work in it is done."""
    from tqdm import tqdm

    ended = threading.Event()

    def watch(bar: Any) -> None:
        while not ended.wait(_LOOK if sys.stderr.isatty() else _LOOK_FOR_FILE):
            look(bar)

    with tqdm(total=total, bar_format=form) as bar:
        watcher = threading.Thread(target=watch, args=(bar,), daemon=True)
        watcher.start()
        try:
            yield
        finally:
            ended.set()
            watcher.join()
            look(bar)
