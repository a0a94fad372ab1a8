#!/usr/bin/env python3
"""Calibrates a list of recordings on a Ray cluster, or on this machine.

    pip install ray
    python ray_batch.py recordings.txt calibrated -- --report

Each task is a shard: a run of `eyebolt batch --shard`. Nothing is shared but the folder, so that a task that Ray starts
again, on whichever node, goes on where it was. What follows `--` goes to `eyebolt batch`. Paths in the list are as the
nodes see them. The lines of all recordings go to standard output.
"""

import argparse
import os
import subprocess
import sys

import ray


def arguments():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("list", help="file with the path of a recording on each line")
    parser.add_argument("output", help="folder that all nodes see")
    parser.add_argument("--shards", type=int, default=16, help="tasks; several for each node, so that none is idle")
    parser.add_argument("--cpus", type=int, default=min(4, os.cpu_count() or 1), help="cores for each task")
    parser.add_argument("--eyebolt", default="eyebolt", help="the program, as the nodes see it")
    own, more = sys.argv[1:], []
    if "--" in own:
        at = own.index("--")
        own, more = own[:at], own[at + 1 :]
    return parser.parse_args(own), more


@ray.remote(max_retries=3, retry_exceptions=True)
def shard(command, number, count, cpus):
    """Exit status 0 means that every recording of the shard has its line, also those that failed."""
    command = [*command, "--shard", f"{number}/{count}", "--threads", str(cpus)]
    ended = subprocess.run(command, capture_output=True, text=True)
    if ended.returncode != 0:
        raise RuntimeError(ended.stderr.strip() or f"{command[0]} ended with {ended.returncode}")
    return number


def main():
    given, more = arguments()
    paths = [os.path.abspath(path) for path in (given.list, given.output)]
    command = [given.eyebolt, "batch", "--list", paths[0], "-o", paths[1], *more]
    ray.init(ignore_reinit_error=True)
    left = [
        shard.options(num_cpus=given.cpus).remote(command, number, given.shards, given.cpus)
        for number in range(given.shards)
    ]
    while left:
        done, left = ray.wait(left)
        print(f"shard {ray.get(done[0])} is done, {len(left)} are left", file=sys.stderr)
    # Tables are made by the shard that ends last; where two end at once, by this.
    subprocess.run([given.eyebolt, "batch", "--merge", paths[1]], check=True, stdout=sys.stderr)
    with open(os.path.join(paths[1], "batch.jsonl"), encoding="utf-8") as lines:
        sys.stdout.writelines(lines)


if __name__ == "__main__":
    main()
