"""Files of configuration keys, as layers."""

from codecs import BOM_UTF16_BE, BOM_UTF16_LE
from pathlib import Path
from typing import Any

from drumrs.config.layers import read_json, read_toml
from drumrs.config.liner import anchored
from drumrs.errors import ConfigError

_WRITE_ONE = "drumrs config > case.toml writes one with every key"


def read_layer(
    path: str | Path, what: str = "a file of configuration keys", hint: str = _WRITE_ONE
) -> dict[str, Any]:
    """Read a file of configuration keys as a layer: TOML, or JSON where the name ends with ``.json``.

    Parameters
    ----------
    path
        The file.
    what, hint
        What it is to be, and where one learns how to write it, as the error says them.

    Raises
    ------
    ConfigError
        Where the file cannot be read, or is not what its name says.
    """
    try:
        data = Path(path).read_bytes()
        # Some editors of Windows begin a file with a mark of its encoding, and write UTF-16.
        text = data.decode("utf-16" if data.startswith((BOM_UTF16_LE, BOM_UTF16_BE)) else "utf-8-sig")
        if "\0" in text:
            raise ValueError("UTF-16 without a mark")  # noqa: TRY301 - told as all else that is no UTF-8
    except (OSError, ValueError) as error:
        reason = error.strerror if isinstance(error, OSError) else "it is not text in UTF-8: save it as such"
        problem = f"cannot be read as {what}: {reason}"
        raise ConfigError(Path(path), problem=problem, hint=hint) from None
    read = read_json if Path(path).suffix == ".json" else read_toml
    return anchored(read(text, Path(path)), Path(path).parent)
