"""What can be mended: a scene, a file, a name. The message says where, what is wrong and what would be right."""

from __future__ import annotations

from collections.abc import Iterable


class Error(Exception):
    """Something in the input to mend; the same sentence as the command prints."""


class UnknownName(Error, KeyError):
    """A field, column or key that does not exist; the message lists those that do."""

    def __str__(self) -> str:
        return Exception.__str__(self)


def unknown_name(what: str, name: str, known: Iterable[str]) -> UnknownName:
    """The error for a name that is none of those known, with the nearest of them.

    >>> print(unknown_name("field", "von_mies", ["pressure", "von_mises"]))
    field: found "von_mies"; available: pressure, von_mises. Did you mean "von_mises"?
    """
    import difflib

    names = list(known)
    near = difflib.get_close_matches(name, names, n=1)
    hint = f' Did you mean "{near[0]}"?' if near else ""
    return UnknownName(f'{what}: found "{name}"; available: {", ".join(names) or "none"}.{hint}')
