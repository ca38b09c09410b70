"""A worker process: numbers of runs on standard input, each answered by a line when its result is in the folder.

It ends with its standard input, so that workers whose parent was killed do not stay."""

from __future__ import annotations

import signal
import sys

from .run import execute_into
from .store import Store


def main() -> None:
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # Ctrl-C is the parent's business
    store = Store(sys.argv[1])
    plan = store.plan()
    for line in sys.stdin:
        execute_into(store, plan, int(line))
        print(line.strip(), flush=True)


if __name__ == "__main__":
    main()
