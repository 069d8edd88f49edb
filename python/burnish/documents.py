"""YAML as the program reads and writes it: numbers such as 1e-09 are numbers, and `on` and `off` are words."""

from __future__ import annotations

import re
from typing import Any

import yaml

_FLOAT = re.compile(r"[-+]?(\.\d+|\d+(\.\d*)?)([eE][-+]?\d+)?$|[-+]?\.(inf|Inf|INF)$|\.(nan|NaN|NAN)$")
_KINDS = {
    "tag:yaml.org,2002:bool": (re.compile(r"true$|false$"), "tf"),
    "tag:yaml.org,2002:int": (re.compile(r"[-+]?\d+$"), "-+0123456789"),
    "tag:yaml.org,2002:float": (_FLOAT, "-+.0123456789"),
    "tag:yaml.org,2002:null": (re.compile(r"~$|null$|$"), ["~", "n", ""]),
}


class _Loader(yaml.SafeLoader):
    yaml_implicit_resolvers: dict[str, Any] = {}


for _tag, (_pattern, _first) in _KINDS.items():
    _Loader.add_implicit_resolver(_tag, _pattern, list(_first))


def document(text: str) -> dict[str, Any]:
    """The mapping that a text is.

    >>> document("{tolerance: 1e-09, count: 4, tools: off, title: }")
    {'tolerance': 1e-09, 'count': 4, 'tools': 'off', 'title': None}
    """
    mapping: dict[str, Any] = yaml.load(text, Loader=_Loader)
    return mapping
