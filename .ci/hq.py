#!/usr/bin/env python3
"""The part of the command `hq` that `lptn sweep plan --hyperqueue` uses, on the client of HyperQueue's Python wheel.

hq cluster FILE       a server with one worker, in $HQ_SERVER_DIR; FILE appears when it is ready
hq submit --wait --name NAME --array FIRST-LAST --cpus N -- COMMAND ..
"""
import argparse
import os
import pathlib
import signal
import sys

from hyperqueue import Job, LocalCluster
from hyperqueue.client import Client
from hyperqueue.cluster import WorkerConfig
from hyperqueue.ffi.protocol import ResourceRequest


def cluster(ready):
    with LocalCluster(os.environ["HQ_SERVER_DIR"], WorkerConfig(cores=2)):
        pathlib.Path(ready).touch()
        signal.pause()


def submit(words):
    parser = argparse.ArgumentParser(prog="hq submit")
    parser.add_argument("--wait", action="store_true", required=True)
    parser.add_argument("--name", required=True)
    parser.add_argument("--array", required=True)
    parser.add_argument("--cpus", type=int, required=True)
    parser.add_argument("command", nargs="+")
    args = parser.parse_args(words)
    first, last = map(int, args.array.split("-"))
    here = os.getcwd()
    job = Job(here, max_fails=None, name=args.name, default_env={"PATH": os.environ["PATH"]})
    resources = ResourceRequest(cpus=args.cpus)
    # the client counts tasks from 0, the array from its first one
    for _ in range(first):
        job.program(["true"], cwd=here)
    for _ in range(first, last + 1):
        job.program(args.command, cwd=here, resources=resources)
    client = Client(os.environ["HQ_SERVER_DIR"])
    done = client.wait_for_jobs([client.submit(job)], raise_on_error=False)
    sys.exit(0 if done else 1)


if sys.argv[1:2] == ["cluster"]:
    cluster(sys.argv[2])
elif sys.argv[1:2] == ["submit"]:
    submit(sys.argv[2:])
else:
    sys.exit(__doc__)
