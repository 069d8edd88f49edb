#!/usr/bin/env python3
"""The schemas of scenes and studies: what the program reads is valid under them, what is spoiled is not.

    schema_test.py BURNISH SOURCE_DIRECTORY
"""
import copy
import json
import pathlib
import re
import subprocess
import sys
import unittest

import jsonschema
import yaml


class Loader(yaml.SafeLoader):
    """Numbers as YAML 1.2 has them: 1e-9 is one."""


Loader.add_implicit_resolver(
    "tag:yaml.org,2002:float",
    re.compile(r"^[-+]?(\.[0-9]+|[0-9]+(\.[0-9]*)?)([eE][-+]?[0-9]+)?$"),
    list("-+.0123456789"))

burnish, source = pathlib.Path(sys.argv.pop(1)), pathlib.Path(sys.argv.pop(1))


def schema(*options):
    return json.loads(subprocess.run([burnish, "schema", *options], check=True, capture_output=True).stdout)


def load(file):
    return yaml.load(file.read_text(), Loader)


SCENE, STUDY = schema(), schema("--study")
FILES = sorted((source / "scenes").rglob("*.yaml"))
BLOCK = load(source / "scenes/examples/roller.yaml")

# Path, value (None: the key is taken away), where the schema finds fault.
SPOILED = [
    (["degre"], 2, []),
    (["degree"], 0, ["degree"]),
    (["degree"], 11, ["degree"]),
    (["degree"], 2.5, ["degree"]),
    (["degree"], "two", ["degree"]),
    (["basis"], "nurb", ["basis"]),
    (["steps"], None, []),
    (["steps"], [], ["steps"]),
    (["steps", 0, "until"], 0, ["steps", 0, "until"]),
    (["geometry", "shape"], "triangle", ["geometry", "shape"]),
    (["geometry", "shape"], None, ["geometry"]),
    (["geometry", "radius"], 1, ["geometry"]),
    (["geometry", "spans"], [1, 1, 1, 1], ["geometry", "spans"]),
    (["material", "E"], 0, ["material", "E"]),
    (["material", "E"], None, ["material"]),
    (["material", "nu"], 0.5, ["material", "nu"]),
    (["tools", 0, "radius"], "1 mm", ["tools", 0, "radius"]),
    (["tools", 0, "half_angle"], 30, ["tools", 0]),
    (["tools", 0, "name"], "a b", ["tools", 0, "name"]),
    (["supports", 0, "fix"], ["w"], ["supports", 0, "fix", 0]),
    (["supports", 0, "symmetry"], "yes", ["supports", 0, "symmetry"]),
    (["output"], "often", ["output"]),
]


def spoiled(path, value):
    scene = copy.deepcopy(BLOCK)
    place = scene
    for step in path[:-1]:
        place = place.setdefault(step, {}) if isinstance(place, dict) else place[step]
    if value is None:
        del place[path[-1]]
    else:
        place[path[-1]] = value
    return scene


class Schema(unittest.TestCase):
    def test_is_a_schema(self):
        for one in (SCENE, STUDY):
            jsonschema.Draft202012Validator.check_schema(one)

    def test_admits_every_scene_and_study(self):
        self.assertGreater(len(FILES), 20)
        for file in FILES:
            document = load(file)
            if "geometry" not in document and "runs" not in document:
                continue  # a part of a scene
            with self.subTest(file=file.name):
                jsonschema.Draft202012Validator(STUDY if "runs" in document else SCENE).validate(document)

    def test_refuses_spoiled_scenes_at_the_spoiled_place(self):
        validator = jsonschema.Draft202012Validator(SCENE)
        validator.validate(BLOCK)
        for path, value, place in SPOILED:
            with self.subTest(path=path, value=value):
                found = [list(error.absolute_path) for error in validator.iter_errors(spoiled(path, value))]
                self.assertIn(place, found)


unittest.main()
