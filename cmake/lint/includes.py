#!/usr/bin/env python3
"""Checks the directions of includes against cmake/lint/includes.txt, and that the names of a folder of the engine are in its
namespace. Usage: includes.py ROOT"""
import pathlib
import re
import sys


def table_of(text):
    """Folder -> folders that its files may include from."""
    text = re.sub(r'\n +(?=\S)', ' ', re.sub(r'#[^\n]*', '', text))
    return {name.strip(): set(allowed.split()) for name, allowed in (line.split(':') for line in text.splitlines() if line.strip())}


def circle_in(table):
    """Folders that include each other in a circle; empty if there is none."""
    left = dict(table)
    while free := [name for name, allowed in left.items() if not any(other in left for other in allowed)]:
        for name in free:
            del left[name]
    return sorted(left)


def room_of(path, table):
    """The folder of the table that a file belongs to."""
    return next((str(folder) for folder in pathlib.PurePath(path).parents if str(folder) in table), None)


def main(root):
    table = table_of((root / 'cmake/lint/includes.txt').read_text())
    complaints = [f'includes.txt: a circle among {", ".join(circle)}' for circle in [circle_in(table)] if circle]
    for path in sorted(path for top in ('engine', 'postproc', 'cli', 'python') for path in (root / top).rglob('*.*')):
        place = path.relative_to(root)
        if path.suffix not in ('.h', '.cpp') or place == pathlib.Path('cli/main.cpp'):
            continue
        here = room_of(place, table)
        if here is None:
            complaints.append(f'{place}: no row of cmake/lint/includes.txt is about this folder')
            continue
        text = path.read_text('utf-8')
        if place.parts[0] == 'engine' and '\nnamespace burnish' in text:
            own = f'namespace burnish::inline {place.parts[1]}'
            if '\nnamespace burnish {' in text or not re.search(rf'^{own}\b', text, re.MULTILINE):
                complaints.append(f'{place}: names of this folder belong to {own}')
        for number, line in enumerate(text.splitlines(), 1):
            include = re.match(r'\s*#\s*include "((?:engine|postproc|cli)/[^"]+)"', line)
            there = room_of(include[1], table) if include else here
            if there not in table[here] | {here, 'engine/core'} and there.split('/')[0] not in table[here]:
                complaints.append(f'{place}:{number}: {here} may not include from {there}')
    print('\n'.join(complaints) or f'{len(table)} folders include in the allowed directions')
    return bool(complaints)


if __name__ == '__main__':
    sys.exit(main(pathlib.Path(sys.argv[1])))
