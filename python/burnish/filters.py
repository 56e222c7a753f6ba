"""Names of the filters that reduce an environment's pyramid, as C++ lists them."""

from typing import Literal, TypeAlias, get_args

Filter: TypeAlias = Literal["box", "gauss4", "gauss6"]

FILTERS: tuple[Filter, ...] = get_args(Filter)
