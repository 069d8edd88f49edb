#!/usr/bin/env python3
"""GetFEM: two problems of two deformable bodies with friction.

usage: getfem_two_bodies.py disc|partial-slip OUT.csv [--degree 2] [--press 20] [--slide 200] [--r 10] [--until 2]
disc: scenes/examples/disc_ironing.yaml, a disc (E = 1000) pressed into a slab 3 x 1 (E = 1) by 0.075 and dragged by 2 along it,
mu = 0.3. partial-slip: partial_slip.yaml beside this file, two cylinders pressed together and sheared, mu = 0.2.
Contact: GetFEM's brick for large sliding by raytracing, slave the first body, multipliers of the displacements' degree;
the law is burnish's neo-hookean, its tangent from automatic differentiation. A step that fails is halved.
"""
import argparse
import csv
import resource

import getfem as gf
import numpy as np

parser = argparse.ArgumentParser()
parser.add_argument('problem', choices=['disc', 'partial-slip'])
parser.add_argument('out')
parser.add_argument('--degree', type=int, default=2)
parser.add_argument('--press', type=int, default=None)
parser.add_argument('--slide', type=int, default=None)
parser.add_argument('--r', type=float, default=None, help='augmentation parameter; 10 E of the softer body when left out')
parser.add_argument('--until', type=float, default=2.0)
parser.add_argument('--seconds', type=float, default=600.0)
a = parser.parse_args()
a.press = a.press or (20 if a.problem == 'disc' else 40)
a.slide = a.slide or (200 if a.problem == 'disc' else 10)
gf.util_trace_level(0)
gf.util_warning_level(0)

HELD, TOUCH = 1, 2
disc = a.problem == 'disc'


def grid(n, m):
    return gf.Mesh('import', 'structured', f'GT="GT_QK(2,2)";ORG=[0,0];SIZES=[1,1];NSUBDIV=[{n},{m}]')


def ring(mesh, cy, inner, outer, first, opening, radial, angular, cx=0.0):
    s, t = mesh.pts()
    w, r = np.radians(first + opening * angular(s)), outer - (outer - inner) * radial(t)
    mark(mesh, lambda p: p[1] < 1e-9, TOUCH)
    mark(mesh, lambda p: p[1] > 1 - 1e-9, HELD)
    mesh.set_pts(np.vstack([cx + r * np.cos(w), cy + r * np.sin(w)]))
    return mesh


def mark(mesh, inside, region):
    """Names the outer faces of a grid whose points are all inside."""
    keep = [(cv, f) for cv, f in mesh.outer_faces().T
            if np.all(inside(mesh.pts(mesh.pid_in_faces(np.array([[cv], [f]])))))]
    mesh.set_region(region, np.array(keep).T)


if disc:
    slave = grid(24, 12)
    mark(slave, lambda p: p[1] < 1e-9, HELD)
    mark(slave, lambda p: p[1] > 1 - 1e-9, TOUCH)
    slave.set_pts(slave.pts() * np.array([[3.], [1.]]))
    master = ring(grid(36, 6), 1.5, 0.25, 0.5, -170, 160, lambda t: t, lambda s: s, 0.5)
    moduli, friction, release, moved = (1.0, 1000.0), 0.3, 0.15, 'u2'
    down, right = -0.075, 2.0
else:
    radial, angular = lambda t: np.sinh(3 * t) / np.sinh(3), lambda s: 0.5 + 0.5 * np.sinh(4.4 * (2 * s - 1)) / np.sinh(4.4)
    slave = ring(grid(64, 12), 8, 2, 8, -170, 160, radial, angular)
    master = ring(grid(48, 12), -8, 2, 8, 10, 160, radial, angular)
    moduli, friction, release, moved = (200.0, 200.0), 0.2, 1.0, 'u1'
    down, right = -0.196, 0.095

md = gf.Model('real')
points = []
for name, mesh, E in zip(('u1', 'u2'), (slave, master), moduli):
    mf, mim = gf.MeshFem(mesh, 2), gf.MeshIm(mesh, 5)
    mf.set_classical_fem(a.degree)
    md.add_fem_variable(name, mf)
    md.add_fem_data('w' + name, mf)
    md.add_initialized_data('mu' + name, [E / 2.6])
    md.add_initialized_data('la' + name, [E * 0.3 / 1.3 / 0.4])
    F = f'(Id(2)+Grad_{name})'
    md.add_nonlinear_term(mim, f"(mu{name}*({F}-Inv({F})')+la{name}*log(Det({F}))*Inv({F})'):Grad_Test_{name}")
    md.add_initialized_data('way' + name, [0., 0.])
    md.add_Dirichlet_condition_with_simplification(name, HELD, 'way' + name)
    points.append(gf.MeshIm(mesh, 7))
mfl = gf.MeshFem(slave, 2)
mfl.set_classical_fem(a.degree)
md.add_filtered_fem_variable('lambda', mfl, TOUCH)
md.add_initialized_data('r', [a.r or 10 * min(moduli)])
md.add_initialized_data('f', [friction])
md.add_initialized_data('alpha', [1.0])
brick = md.add_integral_large_sliding_contact_brick_raytracing('r', release, 'f', 'alpha')
md.add_slave_contact_boundary_to_large_sliding_contact_brick(brick, points[0], TOUCH, 'u1', 'lambda', 'wu1')
md.add_master_contact_boundary_to_large_sliding_contact_brick(brick, points[1], TOUCH, 'u2', 'wu2')
print('unknowns', md.nbdof(), flush=True)

with open(a.out, 'w') as file:
    rows = csv.writer(file)
    rows.writerow('time fx fy iterations step'.split())
    time, steps, total, cuts, done = 0.0, 0, 0, 0, True
    for end, nominal in ((1.0, 1 / a.press), (2.0, 1 / a.slide)):
        h = nominal
        while done and time < min(end, a.until) - 1e-9:
            h = min(h, end - time)
            saved = {v: np.array(md.variable(v)) for v in ('u1', 'u2', 'lambda')}
            md.set_variable('way' + moved, [right * max(0.0, time + h - 1), down * min(time + h, 1.0)])
            try:
                its, ok = md.solve('max_iter', 25, 'max_res', 1e-10, 'lsearch', 'simplest')[:2]
                ok = bool(ok) and its < 25 and bool(np.all(np.isfinite(md.variable('u1'))))
            except RuntimeError as problem:
                its, ok = 25, False
                print(str(problem)[:200], flush=True)
            total += its
            spent = resource.getrusage(resource.RUSAGE_SELF).ru_utime
            if not ok:
                cuts += 1
                for v, x in saved.items():
                    md.set_variable(v, x)
                h /= 2
                done = h > nominal / 1024 and spent < a.seconds
                continue
            time += h
            steps += 1
            for v in ('u1', 'u2'):
                md.set_variable('w' + v, md.variable(v))
            fx = gf.asm_generic(points[0], 0, 'lambda.[1;0]', TOUCH, md)
            fy = gf.asm_generic(points[0], 0, 'lambda.[0;1]', TOUCH, md)
            rows.writerow([f'{time:.6f}', fx, fy, its, f'{h:.3g}'])
            file.flush()
            h = min(nominal, 2 * h)
            done = spent < a.seconds
usage = resource.getrusage(resource.RUSAGE_SELF)
print('time', time, 'steps', steps, 'cuts', cuts, 'iterations', total, 'user %.1f' % usage.ru_utime, 'completed', done)
