#!/usr/bin/env python3
"""CalculiX inputs of two problems of two deformable bodies with friction.

usage: ccx_two_bodies.py disc|partial-slip NAME [--element CPE8|CPE4] [--contact s2s|n2s] [--K penalty] [--stick stiffness]
writes NAME.inp; run: OMP_NUM_THREADS=1 CCX_NPROC=1 ccx NAME

disc: scenes/examples/disc_ironing.yaml, a disc (E = 1000) pressed into a slab 3 x 1 (E = 1) by 0.075 and dragged by 2 along it,
mu = 0.3; elements of degree 2 with the nodes of burnish's 49 x 25 functions.
partial-slip: partial_slip.yaml beside this file, two cylinders pressed together and sheared, mu = 0.2.
"""
import argparse
import math

parser = argparse.ArgumentParser()
parser.add_argument('problem', choices=['disc', 'partial-slip'])
parser.add_argument('name')
parser.add_argument('--element', default='CPE8', choices=['CPE8', 'CPE8R', 'CPE4'])
parser.add_argument('--contact', default='s2s', choices=['s2s', 'n2s'])
parser.add_argument('--K', type=float, help='pressure per overclosure')
parser.add_argument('--stick', type=float, help='tangential traction per slip while sticking')
parser.add_argument('--press', type=int, help='increments of pressing')
parser.add_argument('--slide', type=int, help='increments of the slide')
a = parser.parse_args()
quadratic = a.element != 'CPE4'
disc = a.problem == 'disc'

nodes, number = [], {}


def node(key, x, y):
    if key not in number:
        nodes.append((x, y))
        number[key] = len(nodes)
    return number[key]


def mesh(body, n, m, place):
    """n x m elements; place maps grid indices to the plane. Rows of elements, counterclockwise."""
    def at(i, j):
        return node((body, i, j), *place(i / 2 / n, j / 2 / m))
    elements = []
    for j in range(m):
        for i in range(n):
            corners = [(2 * i, 2 * j), (2 * i + 2, 2 * j), (2 * i + 2, 2 * j + 2), (2 * i, 2 * j + 2)]
            middles = [(2 * i + 1, 2 * j), (2 * i + 2, 2 * j + 1), (2 * i + 1, 2 * j + 2), (2 * i, 2 * j + 1)]
            elements.append([at(*c) for c in corners + (middles if quadratic else [])])
    return elements


def ring(cx, cy, inner, outer, first, opening, radial, angular):
    """Angle first, from the outside inwards: counterclockwise."""
    def place(s, t):
        r, w = outer - (outer - inner) * radial(t), math.radians(first + opening * angular(s))
        return cx + r * math.cos(w), cy + r * math.sin(w)
    return place


def nset(name, body, keep):
    ids = sorted(k for key, k in number.items() if key[0] == body and keep(key[1], key[2]))
    lines = [f'*NSET, NSET={name}']
    lines += [', '.join(map(str, ids[k:k + 12])) + ',' for k in range(0, len(ids), 12)]
    return lines


def middle(k):
    return lambda s: 0.5 + 0.5 * math.sinh(k * (2 * s - 1)) / math.sinh(k)


def towards_outside(k):
    return lambda t: math.sinh(k * t) / math.sinh(k)


if disc:
    nx, ny, na, nr = (24, 12, 36, 6) if quadratic else (48, 24, 72, 12)
    slave = mesh('slave', nx, ny, lambda s, t: (3 * s, t))
    master = mesh('master', na, nr, ring(0.5, 1.5, 0.25, 0.5, -170, 160, lambda t: t, lambda s: s))
    slave_faces = [((ny - 1) * nx + i + 1, 'S3') for i in range(nx)]
    master_faces = [(100001 + i, 'S1') for i in range(na)]
    held, moved = nset('NHELD', 'slave', lambda i, j: j == 0), nset('NMOVED', 'master', lambda i, j: j == 2 * nr)
    moduli, mu, K = (1.0, 1000.0), 0.3, a.K or 1000.0
    down, right, steps = -0.075, 2.0, (a.press or 20, a.slide or 200)
else:
    na, nb, nr = (64, 48, 12) if quadratic else (128, 96, 24)
    slave = mesh('slave', na, nr, ring(0, 8, 2, 8, -170, 160, towards_outside(3), middle(4.4)))
    master = mesh('master', nb, nr, ring(0, -8, 2, 8, 10, 160, towards_outside(3), middle(4.4)))
    slave_faces = [(i + 1, 'S1') for i in range(na)]
    master_faces = [(100001 + i, 'S1') for i in range(nb)]
    held, moved = nset('NHELD', 'master', lambda i, j: j == 2 * nr), nset('NMOVED', 'slave', lambda i, j: j == 2 * nr)
    moduli, mu, K = (200.0, 200.0), 0.2, a.K or 2e5
    down, right, steps = -0.196, 0.095, (a.press or 40, a.slide or 10)

with open(a.name + '.inp', 'w') as out:
    def write(*lines):
        out.write('\n'.join(lines) + '\n')
    write('*NODE, NSET=NALL')
    write(*(f'{k + 1}, {x:.12g}, {y:.12g}, 0.' for k, (x, y) in enumerate(nodes)))
    for name, elements, first in (('SLAVE', slave, 1), ('MASTER', master, 100001)):
        write(f'*ELEMENT, TYPE={a.element}, ELSET=E{name}')
        write(*(', '.join(map(str, [first + k] + ids)) for k, ids in enumerate(elements)))
    write(*held, *moved)
    if a.contact == 'n2s':
        row = 2 * (12 if quadratic else 24) if disc else 0
        write(*nset('NSLAVE', 'slave', lambda i, j: j == row), '*SURFACE, NAME=SSLAVE, TYPE=NODE', 'NSLAVE')
    else:
        write('*SURFACE, NAME=SSLAVE, TYPE=ELEMENT', *(f'{e}, {s}' for e, s in slave_faces))
    write('*SURFACE, NAME=SMASTER, TYPE=ELEMENT', *(f'{e}, {s}' for e, s in master_faces))
    for name, E in zip(('SLAVE', 'MASTER'), moduli):
        shear, bulk = E / 2.6, E / 3 / 0.4
        write(f'*MATERIAL, NAME=M{name}', '*HYPERELASTIC, NEO HOOKE', f'{shear / 2:.12g}, {2 / bulk:.12g}')
        write(f'*SOLID SECTION, ELSET=E{name}, MATERIAL=M{name}', '1.')
    write('*SURFACE INTERACTION, NAME=SI', '*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR', f'{K:.8g}')
    write('*FRICTION', f'{mu}, {a.stick or K / 10:.8g}')
    kind = 'SURFACE TO SURFACE' if a.contact == 's2s' else 'NODE TO SURFACE'
    write(f'*CONTACT PAIR, INTERACTION=SI, TYPE={kind}', 'SSLAVE, SMASTER')
    write('*BOUNDARY', 'NHELD, 1, 2')
    write('*AMPLITUDE, NAME=DOWN, TIME=TOTAL TIME', f'0., 0., 1., {down}, 9., {down}')
    write('*AMPLITUDE, NAME=RIGHT, TIME=TOTAL TIME', f'0., 0., 1., 0., 2., {right}')
    for n in steps:
        write('*STEP, NLGEOM, INC=5000', '*STATIC', f'{1 / n:.10g}, 1., 1e-5, {1 / n:.10g}')
        write('*BOUNDARY, AMPLITUDE=DOWN', 'NMOVED, 2, 2, 1.', '*BOUNDARY, AMPLITUDE=RIGHT', 'NMOVED, 1, 1, 1.')
        write('*NODE PRINT, NSET=NHELD, TOTALS=ONLY', 'RF', '*EL PRINT, ELSET=ESLAVE, TOTALS=ONLY', 'ELSE', '*END STEP')
print(len(nodes), 'nodes', len(slave), 'and', len(master), 'elements')
