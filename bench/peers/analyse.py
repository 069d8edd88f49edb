#!/usr/bin/env python3
"""Forces of the runs of one problem in one table.

usage: analyse.py LABEL=KIND:FILE ...     KIND: burnish (history.csv), getfem (csv), ccx (.dat)
Vertical force at t = 1, mean of it and of the drag over 0.5 <= u <= 1.5 with u = 2 (t - 1), and the vertical force's
jaggedness there: standard deviation about the running mean over 0.24 of u, in % of the mean, from values every 0.01 of u.
"""
import csv
import re
import sys

import numpy as np


def read(kind, path):
    if kind == 'ccx':
        text = open(path).read()
        held = re.findall(r'total force \(fx,fy,fz\) for set NHELD and time\s+(\S+)\s+(\S+)\s+(\S+)', text)
        rows = np.array(held, float)
    else:
        table = list(csv.DictReader(open(path)))
        pick = lambda end: next(c for c in table[0] if c == end or c.endswith('.' + end))
        rows = np.array([[float(r['time']), float(r[pick('fx')]), float(r[pick('fy')])] for r in table])
    rows = rows[np.argsort(rows[:, 0], kind='stable')]
    return rows[:, 0], np.abs(rows[:, 1]), np.abs(rows[:, 2])


print('| run | last t | Fy, t = 1 | mean Fy | mean Fx | jaggedness of Fy, % | of Fx, % |')
print('|---|---:|---:|---:|---:|---:|---:|')
for argument in sys.argv[1:]:
    label, rest = argument.split('=', 1)
    t, fx, fy = read(*rest.split(':', 1))
    n, step = 24, 0.01
    u = 0.5 - n * step / 2 + step * np.arange(100 + n + 1)
    weights = np.ones(n + 1) / n
    weights[[0, -1]] /= 2
    cells = []
    for force in (fy, fx):
        values = np.interp(1 + u / 2, t, force)
        inner = values[n // 2:-(n // 2)]
        cells.append((inner.mean(), 100 * np.std(inner - np.convolve(values, weights, 'valid')) / inner.mean()))
    if t[-1] < 1.82:
        cells = [(float('nan'),) * 2] * 2
    print(f'| {label} | {t[-1]:.4g} | {np.interp(1, t, fy):.5g} | {cells[0][0]:.5g} | {cells[1][0]:.5g} | {cells[0][1]:.3g} | {cells[1][1]:.3g} |')
