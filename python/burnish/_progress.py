"""Progress bars on stderr for what takes longer than two seconds."""

import sys
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager

DELAY_S = 2.0
REFRESH_S = 0.5


@contextmanager
def progress_bar(what: str) -> Iterator[Callable[[float, str], None]]:
    """Give a function to call with the share done, 0..1, and the step's name.

    The bar appears after two seconds, on stderr, and only on a terminal. It goes on counting seconds while
    nothing calls the function.

    Parameters
    ----------
    what : str
        Shown before the bar.
    """
    from tqdm import tqdm

    layout = "{desc}: {percentage:3.0f}% |{bar}| {elapsed} {postfix}"
    bar = tqdm(
        total=1.0, desc=what, delay=DELAY_S, disable=None, leave=False, file=sys.stderr, bar_format=layout
    )

    def advance(share: float, step: str) -> None:
        bar.set_postfix_str(step, refresh=False)
        bar.update(min(max(share, 0.0), 1.0) - bar.n)

    is_done = threading.Event()

    def tick() -> None:
        began = time.monotonic()
        while not is_done.wait(REFRESH_S):
            if time.monotonic() - began >= DELAY_S:
                bar.refresh()

    ticker = None if bar.disable else threading.Thread(target=tick, daemon=True)
    if ticker is not None:
        ticker.start()
    try:
        yield advance
    finally:
        is_done.set()
        if ticker is not None:
            ticker.join()
        bar.close()
