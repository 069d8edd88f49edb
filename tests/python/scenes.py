"""Small scenes of all kinds of bodies, which run in a moment."""

PRESS = {
    "title": "Disc on a block",
    "units": {"length": "mm", "stress": "MPa"},
    "geometry": {"shape": "rectangle", "size": [2, 1], "functions": [9, 6]},
    "material": {"law": "j2", "E": 1000, "nu": 0.3, "hardening": {"law": "linear", "sigma0": 5, "modulus": 100}},
    "formulation": "fbar",
    "supports": [{"face": "bottom", "fix": ["x", "y"]}],
    "tools": [{"name": "disc", "shape": "cylinder", "center": [1, 1.5], "radius": 0.5,
               "motion": {"times": [0, 1], "y": [0, -0.05]}}],
    "contact": [{"tool": "disc", "face": "top"}],
    "steps": [{"until": 1, "count": 4}],
    "output": {"every": 0.5, "vtu": False},
}


def scene(**changes):
    return {**PRESS, **changes}


_RUBBER = {"law": "neo-hookean", "E": 10, "nu": 0.3}
_NO_TOOLS = {"tools": [], "contact": [], "formulation": "displacement"}

SCENES = {
    "press": PRESS,
    "lagrange": scene(basis="lagrange", degree=3, geometry={"shape": "rectangle", "size": [2, 1], "spans": [5, 3]}),
    "axisymmetric": scene(kinematics="axisymmetric", supports=[{"face": "bottom", "fix": ["y"]}, {"face": "left", "symmetry": True}],
                          tools=[{"name": "disc", "shape": "cylinder", "center": [0, 1.5], "radius": 0.5,
                                  "motion": {"times": [0, 1], "y": [0, -0.05]}}]),
    "ring": scene(**_NO_TOOLS, geometry={"shape": "annulus", "inner_radius": 1, "outer_radius": 2, "spans": [3, 5]}, material=_RUBBER,
                  supports=[{"face": "bottom", "symmetry": True}, {"face": "top", "symmetry": True}],
                  loads=[{"face": "left", "pressure": "2*t"}]),
    "bodies": scene(
        geometry=None, material=None, tools=[],
        bodies=[{"name": "shaft", "geometry": {"shape": "annulus", "inner_radius": 1, "outer_radius": 2.003, "spans": [3, 5]},
                 "material": PRESS["material"]},
                {"name": "hub", "geometry": {"shape": "annulus", "inner_radius": 2, "outer_radius": 3.6, "spans": [3, 4]},
                 "material": _RUBBER}],
        supports=[{"body": body, "face": face, "symmetry": True} for body in ("shaft", "hub") for face in ("bottom", "top")],
        contact=[{"name": "seat", "body": "shaft", "face": "right", "against": {"body": "hub", "face": "left"},
                  "interference": "resolve", "method": "augmented-lagrangian"}]),
    "patches": scene(
        **_NO_TOOLS, material=_RUBBER, degree=2,
        geometry={"shape": "patches", "patches": [
            {"name": "left", "shape": "control-net", "degrees": [2, 1], "knots": [[0, 0, 0, 1, 1, 1], [0, 0, 1, 1]],
             "points": [[0, 0], [0.6, 0.3], [1, 0], [0, 1], [0.4, 0.8], [1.3, 1]], "refine": [2, 2]},
            {"name": "right", "shape": "control-net", "degrees": [2, 1], "knots": [[0, 0, 0, 1, 1, 1], [0, 0, 1, 1]],
             "points": [[1, 0], [1.4, -0.2], [2, 0], [1.3, 1], [1.7, 1.2], [2, 1]], "refine": [2, 2]}]},
        supports=[{"patch": "left", "face": "left", "fix": ["x", "y"]}],
        loads=[{"patch": "right", "face": "right", "traction": ["0.5*t", "t"]}]),
    "space": scene(
        geometry={"shape": "box", "size": [2, 1, 1], "spans": [3, 2, 2]},
        supports=[{"face": "bottom", "fix": ["x", "y", "z"]}],
        tools=[{"name": "ball", "shape": "sphere", "center": [1, 1.5, 0.5], "radius": 0.5,
                "motion": {"times": [0, 1], "y": [0, -0.05]}}],
        contact=[{"tool": "ball", "face": "top"}]),
    "remeshed": scene(
        formulation="displacement", material={"law": "neo-hookean", "E": 10, "nu": 0.3},
        geometry={"shape": "rectangle", "size": [2, 1], "functions": [26, 8]},
        tools=[{"name": "disc", "shape": "cylinder", "center": [0.6, 1.5], "radius": 0.5,
                "motion": {"times": [0, 1, 2], "x": [0, 0, 0.5], "y": [0, -0.03, -0.03]}}],
        contact=[{"tool": "disc", "face": "top", "method": "augmented-lagrangian"}],
        rezoning={"travel": 0.1, "spans": [24, 6]},
        steps=[{"until": 1, "count": 4}, {"until": 2, "count": 20}], output={"every": 1, "vtu": False}),
}
for _scene in SCENES.values():
    for _key in [key for key, value in _scene.items() if value is None or value == []]:
        del _scene[_key]
