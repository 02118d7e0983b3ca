"""Columns as labelled arrays of xarray, each with its unit and meaning as NetCDF's CF conventions name them."""

from collections.abc import Mapping, Sequence
from importlib.metadata import version
from typing import TYPE_CHECKING, Any

from drumrs.errors import missing_package
from drumrs.registry import known

if TYPE_CHECKING:
    import xarray

# Names of dimensions, values, and attributes of what is no quantity.
Column = tuple[Sequence[str], Any] | tuple[Sequence[str], Any, Mapping[str, str]]


def dataset(
    columns: Mapping[str, Column],
    coordinates: Mapping[str, Column],
    attributes: Mapping[str, str] | None = None,
) -> "xarray.Dataset":
    """Return a data set of columns; those that are quantities have their unit and meaning.

    Parameters
    ----------
    columns, coordinates
        Dimensions and values by name.
    attributes
        Words on the whole.

    Raises
    ------
    ConfigError
        Where xarray is not installed.
    """
    try:
        import xarray
    except ModuleNotFoundError as error:
        raise missing_package("a data set of xarray", error, "export") from None
    made = xarray.Dataset(
        columns,
        coordinates,
        {"Conventions": "CF-1.11", "source": f"drumrs {version('drumrs')}", **(attributes or {})},
    )
    for quantity in known(map(str, made.variables)):
        made[quantity.name].attrs = {"units": quantity.unit, "long_name": quantity.meaning}
    return made
