#!/usr/bin/python3
"""What the default output costs: the share of a large run's wall time that goes into writing the
result file and the item logs. Prints `name value unit reference ratio`; reference: wall time."""
import pathlib
import tempfile

import large_job


def main():
    with tempfile.TemporaryDirectory() as folder:
        took = large_job.run(large_job.write_job(pathlib.Path(folder)), ranks=2, threads=1)
    wall = took["wall"]
    for name, seconds in (("write_result", took["store"]), ("write_logs", took["log"]),
                          ("write_all", took["store"] + took["log"])):
        print(f"{name} {seconds:.3f} s {wall:.3f} {seconds / wall:.4f}")
    print(f"result_size {took['bytes'] / 1e6:.1f} MB - -")


if __name__ == "__main__":
    main()
