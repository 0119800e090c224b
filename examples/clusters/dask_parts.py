#!/usr/bin/env python3
"""Renders the parts of a picture on Dask workers, and merges them.

    python3 -m venv venv && venv/bin/pip install -r examples/clusters/requirements.txt
    venv/bin/python examples/clusters/dask_parts.py scenes/soap_bubble.toml -o bubble.exr --parts 8 -- --samples 1024

What follows `--` are options of `pellicle render`. The workers are two processes on this machine, or those of --scheduler, which must
share the folder of parts and have the same version of Pellicle. When a worker is lost, Dask renders its part again on another one; a
part depends on the scene, the seed and the backend only, so the picture is the same.

--kill-one tests this: it kills a worker while its part is being rendered, and fails unless that part ran twice.
"""

import argparse
import os
import shutil
import signal
import subprocess
import sys
import time
import uuid
from pathlib import Path

from dask.distributed import Client, LocalCluster, as_completed

# How long --kill-one waits for something to happen.
KILL_LIMIT_S = 30


def render_part(command, part, parts, folder, run, hold):
    """Renders a part, on a worker. Returns its file, which is there only when it is complete.

    With `hold`, the first attempt is held in the middle of rendering, until its worker is killed.
    """
    folder = Path(folder)
    digits = len(str(parts))
    name = f"{part:0{digits}}_of_{parts}"
    # Two attempts may run at a time, if Dask loses sight of a worker that is still alive. They have files of their own, and the later
    # one replaces a part by the same part.
    unfinished = folder / f"unfinished_{name}_{run}_{uuid.uuid4().hex}.exr"
    renders = [*command, "--part", f"{part}/{parts}", "-o", str(unfinished)]
    # Pellicle must not go on without its worker. Linux kills it when the thread that started it, which waits for it, ends.
    if shutil.which("setpriv"):
        renders = ["setpriv", "--pdeathsig", "KILL", "--", *renders]
    child = subprocess.Popen(
        renders, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True
    )
    try:
        attempts = folder / f"attempts_{run}"
        first = not (attempts / name).exists()
        if hold and first:
            stop_within(child.pid, command[0])
        with open(attempts / name, "a") as log:
            log.write(f"{os.getpid()} {child.pid}\n")
        if hold and first:
            time.sleep(2 * KILL_LIMIT_S)
            raise RuntimeError("this worker should have been killed")
        _, errors = child.communicate()
    finally:
        # SIGKILL ends a stopped process too. It has no effect on one that has ended.
        child.kill()
    if child.returncode != 0:
        unfinished.unlink(missing_ok=True)
        raise RuntimeError(
            f"pellicle ended with code {child.returncode}:\n{errors.strip()}"
        )
    complete = folder / f"part_{name}.exr"
    unfinished.replace(complete)
    return str(complete)


def stop_within(pid, program):
    """Stops a process as soon as it is Pellicle: it is Python first, and then `setpriv`, which must have done its work."""
    name = Path(f"/proc/{pid}/comm")
    # Linux keeps 15 letters of a name. That of a process that has ended is still there, since nothing has waited for it.
    while name.read_text().strip() != Path(program).name[:15] and state(pid) != "Z":
        pass
    os.kill(pid, signal.SIGSTOP)


def attempts_of(folder, run):
    """Returns the attempts at each part, as process numbers of the worker and of Pellicle."""
    logs = sorted((folder / f"attempts_{run}").iterdir())
    return {
        log.name: [tuple(map(int, line.split())) for line in log.read_text().splitlines()]
        for log in logs
    }


def state(pid):
    """Returns the state of a process as Linux's letter; None if there is no such process."""
    try:
        return Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()[0]
    except (FileNotFoundError, ProcessLookupError):
        return None


def wait_for(what, found):
    """Waits until `found` returns something other than None, and returns it."""
    end = time.monotonic() + KILL_LIMIT_S
    while (result := found()) is None:
        if time.monotonic() > end:
            sys.exit(f"--kill-one: {what} did not happen within {KILL_LIMIT_S} s")
        time.sleep(0.01)
    return result


def kill_worker(folder, run, held):
    """Kills the worker that renders the held part. Checks that this ends its Pellicle as well."""
    worker, child = wait_for(
        f"an attempt at part {held}",
        lambda: next(iter(attempts_of(folder, run).get(held, [])), None),
    )
    ended = state(child) in (None, "Z")
    os.kill(worker, signal.SIGKILL)
    print(f"killed the worker, process {worker}, at part {held}")
    if ended:
        # It was faster than the signal that should have held it.
        print(f"its pellicle, process {child}, had ended before")
        return
    wait_for(
        f"the end of pellicle, process {child}, whose worker was killed",
        lambda: True if state(child) in (None, "Z") else None,
    )
    print(f"its pellicle, process {child}, ended with it, in the middle of the part")


def render(client, arguments, run):
    """Renders all parts and returns their files in order."""
    folder, parts = arguments.folder, arguments.parts
    (folder / f"attempts_{run}").mkdir()
    command = [arguments.pellicle, "render", str(arguments.scene.resolve()), "--backend", arguments.backend]
    command += arguments.render_options
    numbers = {
        # Results are not kept from one run to the next: files may have been removed since.
        client.submit(
            render_part,
            command,
            part,
            parts,
            str(folder),
            run,
            arguments.kill_one and part == 1,
            key=f"part-{part}-of-{parts}-{run}",
        ): part
        for part in range(1, parts + 1)
    }
    if arguments.kill_one:
        kill_worker(folder, run, f"{1:0{len(str(parts))}}_of_{parts}")
    files = {}
    running = as_completed(list(numbers))
    while numbers:
        future = next(running)
        part = numbers.pop(future)
        try:
            files[part] = future.result()
        except Exception as error:
            client.cancel(list(numbers))
            sys.exit(f"part {part} of {parts} failed: {error}")
        print(f"part {part} of {parts}: {files[part]}")
        # A result that is here need not be computed again if its worker is lost.
        future.release()
    return [files[part] for part in sorted(files)]


def report(attempts, kill_one):
    """Prints which parts ran more than once. Returns whether one did, if it had to."""
    again = {name: len(tries) for name, tries in attempts.items() if len(tries) > 1}
    for name, count in again.items():
        print(f"part {name} ran {count} times")
    if not again:
        print("every part ran once")
    return bool(again) or not kill_one


def parsed():
    words = sys.argv[1:]
    end = words.index("--") if "--" in words else len(words)
    parser = argparse.ArgumentParser(
        description="Renders the parts of a picture on Dask workers, and merges them.",
        epilog="What follows -- are options of pellicle render.",
    )
    parser.add_argument("scene", type=Path)
    parser.add_argument("-o", "--output", type=Path, required=True, help="the spectral image (.exr)")
    parser.add_argument("--parts", type=int, default=8, help="number of parts [default: 8]")
    parser.add_argument("--folder", type=Path, default=Path("parts"), help="folder of parts [default: parts]")
    parser.add_argument("--scheduler", metavar="ADDRESS", help="use the workers of this scheduler")
    parser.add_argument("--workers", type=int, default=2, help="local workers, without --scheduler [default: 2]")
    parser.add_argument("--pellicle", default="pellicle", metavar="COMMAND", help="the command [default: pellicle]")
    parser.add_argument("--backend", default="cpu", help="what renders; all parts need the same [default: cpu]")
    parser.add_argument("--kill-one", action="store_true", help="kill a local worker, to test that its part runs again")
    arguments = parser.parse_args(words[:end])
    arguments.render_options = words[end + 1 :]
    arguments.folder = arguments.folder.resolve()
    if arguments.parts < 1:
        parser.error("--parts must be at least 1")
    if arguments.kill_one and (arguments.scheduler or not shutil.which("setpriv")):
        parser.error("--kill-one needs workers on this machine, and Linux's setpriv")
    return arguments


def main():
    arguments = parsed()
    started = time.monotonic()
    arguments.folder.mkdir(parents=True, exist_ok=True)
    run = uuid.uuid4().hex
    if arguments.scheduler:
        cluster = None
        client = Client(arguments.scheduler)
    else:
        cluster = LocalCluster(
            n_workers=arguments.workers,
            threads_per_worker=1,
            processes=True,
            dashboard_address=None,
        )
        client = Client(cluster)
    try:
        files = render(client, arguments, run)
        twice = report(attempts_of(arguments.folder, run), arguments.kill_one)
    finally:
        client.close()
        if cluster:
            cluster.close()
        # What attempts that did not end have left.
        shutil.rmtree(arguments.folder / f"attempts_{run}", ignore_errors=True)
        for left in arguments.folder.glob(f"unfinished_*_{run}_*"):
            left.unlink(missing_ok=True)
    rendered = time.monotonic() - started
    merged = subprocess.run([arguments.pellicle, "merge", *files, "-o", str(arguments.output)], check=False)
    if merged.returncode != 0:
        sys.exit(f"pellicle merge ended with code {merged.returncode}")
    print(f"{arguments.output}: {len(files)} parts, rendered in {rendered:.1f} s")
    if not twice:
        sys.exit("--kill-one: no part ran twice")


if __name__ == "__main__":
    main()
