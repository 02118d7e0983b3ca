"""`drumrs studio`: a drum in the browser that turns while it is changed."""

import webbrowser
from contextlib import suppress
from pathlib import Path
from typing import Annotated

from cyclopts import Parameter

from drumrs.cli.messages import note
from drumrs.cli.options import WHOLE, Seed, Settings, Threads, layered


def studio(
    case: Path | None = None,
    /,
    *,
    set_: Settings = None,
    seed: Seed = None,
    threads: Threads = 1,
    softer: Annotated[
        float | None, Parameter(help="Lower both stiffnesses, as `drumrs run --softer`.")
    ] = None,
    port: Annotated[int, WHOLE] = 0,
    show: Annotated[bool, Parameter(name="--open")] = True,
) -> None:
    """Show a drum in the browser that turns while you change it; Ctrl-C ends it.

    It begins to turn as soon as the page is open: the paper's drum with baffles, or your CASE. A new speed acts at
    once. Fill, friction and the height of baffles start the drum anew, from the same seed. Power, falls, mixing and the
    residual of the energy ledger build up beside it.

    What you see is the run of a case, bit for bit: "Copy as case.toml" hands it out, changes of speed included, for
    `drumrs run case.toml`. Nothing leaves this machine: the page is served to it alone, and needs no network.

    It needs the extra: pip install 'drumrs[studio]'.

    Parameters
    ----------
    case
        TOML file with some keys of `drumrs config`, laid over the baseline.
    port
        Port of the page; a free one unless given.
    show
        Whether to open the page in the browser.
    """
    from drumrs.studio.presets import BASELINE, preset
    from drumrs.studio.server import Server
    from drumrs.studio.session import Session

    changed = case is not None or set_ or seed is not None or softer is not None
    config = layered(case, set_, seed) if changed else preset(BASELINE)
    if softer is not None:
        config = config.softer(softer)
    name = BASELINE if not changed else "your case" if case is None else case.name
    with Session(config, threads=threads) as session:
        server = Server(session, name, port)

        def on_ready() -> None:
            note(f"the studio is at {server.address} and ends with Ctrl-C")
            if show and not _opens(server.address):
                note("found no browser here; open that address in one on this machine")

        with suppress(KeyboardInterrupt):
            # That is how it ends.
            server.serve(on_ready)


def _opens(address: str) -> bool:
    try:
        return webbrowser.open(address)
    except webbrowser.Error:
        return False
