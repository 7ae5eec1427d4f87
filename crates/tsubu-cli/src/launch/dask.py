import pathlib
import subprocess
import sys

import dask
from distributed import Client, as_completed


def run(command):
    """On a worker: does a task, and tells what it said."""
    done = subprocess.run(command, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)
    return done.stderr.decode(errors="replace")


logs = pathlib.Path(LOGS)
logs.mkdir(parents=True, exist_ok=True)
first = sum(1 for _ in logs.glob("dask_*.txt"))
client = Client(SCHEDULER or dask.config.get("scheduler-address"))
futures = {client.submit(run, COMMAND + task, pure=False): task for task in TASKS}
try:
    for done, future in enumerate(as_completed(futures), 1):
        if future.status == "finished":
            said = future.result()
        else:
            # A worker that is lost gives its task to another; one that takes several with it is given up.
            names = [name for name in futures[future] if name != "--case"]
            said = "".join(f"case {name}: begun\nerror: {future.exception()!r}\n" for name in names)
        (logs / f"dask_{first + done:04}.txt").write_text(said)
        print(f"{done} of {len(futures)} tasks", file=sys.stderr, flush=True)
except KeyboardInterrupt:
    client.cancel(list(futures))
    sys.exit(130)
finally:
    client.close()
