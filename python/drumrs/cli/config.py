"""`drumrs config`: every key, as a file to start from."""

import sys

import drumrs


def config() -> None:
    """Print every key with its default, unit and meaning, as TOML: `drumrs config > case.toml`."""
    sys.stdout.write("# The baseline of drumrs, the paper's Table 1. Keep what differs, delete the rest.\n\n")
    sys.stdout.write(drumrs.baseline().to_toml())
