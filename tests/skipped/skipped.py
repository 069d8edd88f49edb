#!/usr/bin/env python3
"""Fails if tests were skipped that may not be.

Usage: skipped.py JUNIT.xml ALLOWED.txt     what ctest --output-junit wrote; lines "NAME: REASON"
       skipped.py --check                   whether this script itself notices what it must
"""

import pathlib
import sys
import tempfile
import xml.etree.ElementTree as ElementTree


def allowed(file):
    """Names and reasons of the tests that may be skipped."""
    reasons = {}
    for line in file.read_text().splitlines():
        if not line.strip() or line.startswith("#"):
            continue
        name, _, reason = line.partition(": ")
        if not reason.strip():
            sys.exit(f'{file}: "{line}": expected NAME: REASON')
        reasons[name] = reason
    return reasons


def skipped(junit):
    """Names of the tests that did not run, without the parameter that googletest appends."""
    return [case.get("name").split("  # ")[0] for case in ElementTree.parse(junit).iter("testcase") if case.get("status") == "notrun"]


def judge(junit, list_file):
    """Prints what was skipped; the names for which there is no reason."""
    reasons = allowed(list_file)
    strangers = []
    for name in skipped(junit):
        print(f"skipped: {name}: {reasons.get(name, 'NOT ALLOWED')}")
        if name not in reasons:
            strangers.append(name)
    return strangers


def check():
    with tempfile.TemporaryDirectory() as place:
        junit, list_file = pathlib.Path(place, "junit.xml"), pathlib.Path(place, "allowed.txt")
        junit.write_text('<testsuite><testcase name="a" status="run"/><testcase name="b  # GetParam() = 3" status="notrun"><skipped/>'
                         '</testcase><testcase name="c" status="notrun"/></testsuite>')
        list_file.write_text("# may be skipped\nb: needs the moon\n")
        assert judge(junit, list_file) == ["c"]
        list_file.write_text("b: needs the moon\nc: needs the sun\n")
        assert judge(junit, list_file) == []


if __name__ == "__main__":
    if sys.argv[1:] == ["--check"]:
        check()
    elif len(sys.argv) == 3:
        strangers = judge(pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2]))
        if strangers:
            sys.exit(f"skipped tests without a reason in {sys.argv[2]}: {len(strangers)}")
    else:
        sys.exit(__doc__)
