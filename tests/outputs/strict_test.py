"""Every text that the program writes is read back by a parser that others have written and that forgives nothing, from a run
whose title and units are hostile to each of the formats.

Usage: strict_test.py BURNISH
"""

import csv
import html.parser
import json
import pathlib
import subprocess
import sys
import tempfile
import xml.etree.ElementTree as xml

import yaml

TITLE = 'Press <3> "quoted" & \'single\', %s {0} | `code` *b* #1 \\n'
LENGTH = 'in "<&>\''
STRESS = 'lb/in² & <psi>'
SCENE = {
    "title": TITLE,
    "units": {"length": LENGTH, "stress": STRESS},
    "geometry": {"shape": "rectangle", "size": [2, 1], "functions": [5, 4]},
    "material": {"law": "neo-hookean", "E": 1, "nu": 0.3},
    "supports": [{"face": "bottom", "fix": ["x", "y"]}],
    "tools": [{"name": "disc", "shape": "cylinder", "center": [1, 1.5], "radius": 0.5,
               "motion": {"times": [0, 1], "y": [0, -0.05]}}],
    "contact": [{"tool": "disc", "face": "top"}],
    "steps": [{"until": 1, "count": 2}],
    "pictures": [{"field": "von_mises", "size": [400, 300]}],
}
VOID = {"area", "base", "br", "col", "embed", "hr", "img", "input", "link", "meta", "source", "track", "wbr"}


class Page(html.parser.HTMLParser):
    """Elements that are closed in the order in which they were opened, and their text."""

    def __init__(self):
        super().__init__(convert_charrefs=True)
        self.open, self.text, self.mistakes = [], "", []

    def handle_starttag(self, tag, attributes):
        if tag not in VOID:
            self.open.append(tag)

    def handle_endtag(self, tag):
        if tag in VOID:
            return
        if not self.open or self.open.pop() != tag:
            self.mistakes.append(f"</{tag}> at {self.getpos()}")

    def handle_data(self, data):
        self.text += data


def run(*arguments):
    done = subprocess.run(arguments, capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(f"{arguments[1]} exits with {done.returncode}: {done.stderr}")


def objects(*arguments, code=0):
    """The JSON objects that a command prints, one in each line."""
    done = subprocess.run(arguments, capture_output=True, text=True)
    if done.returncode != code:
        sys.exit(f"{arguments[1:]} exits with {done.returncode}: {done.stderr}")

    def refused(word):
        raise ValueError(f"{word} is no JSON")

    return [json.loads(line, parse_constant=refused) for line in done.stdout.splitlines()]


def array_names(file):
    return {array.get("Name") for array in xml.parse(file).getroot().iter("DataArray")}


def check_json(burnish, work, scene, out, expect):
    """What --json prints is JSON, and says what the files and tables say."""
    events = objects(burnish, "run", scene, "-o", work / "told", "--json")
    names = [event["event"] for event in events]
    summary = yaml.safe_load((work / "told/summary.yaml").read_text(encoding="utf-8"))
    expect(names[-1] == "end" and names.count("end") == 1, f"the events of a run are {names}")
    expect(names.count("step") == summary["steps"] and names.count("picture") == 1, f"the events of a run are {names}")
    expect([event["time"] for event in events if event["event"] == "frame"] == [0, 1], f"the frames are {events}")
    steps = [event for event in events if event["event"] == "step"]
    expect(steps[-1]["time"] == steps[-1]["end_time"] == 1, f"the last step is {steps[-1]}")
    end = {key: value for key, value in events[-1].items() if key not in ("event", "directory")}
    same = {key: value for key, value in summary.items() if isinstance(value, (bool, int)) or key == "program"}
    expect({key: end.get(key) for key in same} == same, f"the end is {end} instead of {same}")
    expect([doubt["what"] for doubt in end["doubts"]] == [doubt["what"] for doubt in summary["doubts"]], f"the doubts are {end}")
    expect(abs(end["tolerance"] - float(summary["tolerance"])) < 1e-20, f"the end is {end}")
    expect(set(end) == set(summary), f"the end has other entries than the summary: {set(end) ^ set(summary)}")

    [result] = objects(burnish, "info", out, "--json")
    expect(result["title"] == TITLE and result["dimensions"] == 2, f"the result is {result}")
    expect(result["times"] == [0, 1] and result["tools"][0]["name"] == "disc", f"the result is {result}")
    expect({field["name"]: field["unit"] for field in result["fields"]}["von_mises"] == STRESS, f"the result is {result}")
    expect(result["summary"]["completed"] is True and "disc.fy" in result["columns"], f"the result is {result}")
    [document] = objects(burnish, "info", scene, "--json")
    expect(document["title"] == TITLE and document["units"]["stress"] == STRESS, f"the scene is {document}")
    expect(document["material"]["nu"] == 0.3 and document["geometry"]["size"] == [2, 1], f"the scene is {document}")
    body = sorted((out / "frames").glob("body_*.vtu"))[-1]
    [foreign] = objects(burnish, "info", body, "--json")
    expect(foreign["blocks"][0]["points"] > 0 and any(f["name"] == "von_mises" for f in foreign["fields"]), f"{foreign}")

    (work / "bad.yaml").write_text("geometry: {}\n")
    good, bad = objects(burnish, "validate", scene, work / "bad.yaml", "--json", code=2)
    expect(good["fine"] is True and good["steps"] == 2 and good["warnings"] == [], f"validate says {good}")
    expect(good["scene"] == document and yaml.safe_load(good["yaml"])["title"] == TITLE, f"validate says {good}")
    expect(bad["fine"] is False and len(bad["problems"]) > 1, f"validate says {bad}")

    checked = {**SCENE, "checks": [{"name": "force", "quantity": "disc.fy", "time": 1, **expectation, "source": "a guess"} for expectation in
                                   ({"expect": "value", "value": "7 / 2", "relative": 9}, {"expect": "value", "value": 3, "absolute": 99},
                                    {"expect": "range", "at_most": 1e11}, {"expect": "range", "at_least": 0, "at_most": 99})]}
    (work / "checked.yaml").write_text(yaml.safe_dump(checked, allow_unicode=True), encoding="utf-8")
    [case] = objects(burnish, "verify", work / "checked.yaml", "-o", work / "verified", "--json")
    expect(case["case"] == "checked" and case["holds"] is True and case["title"] == TITLE, f"verify says {case}")
    expect(case["checks"][0]["verdict"] == "holds" and case["checks"][0]["values"][0] > 0, f"verify says {case}")
    numbers = [[check.get(key) for key in ("operator", "expected", "tolerance", "relative")] for check in case["checks"]]
    expect(numbers == [["=", 3.5, 9, True], ["=", 3, 99, False], ["<=", 1e11, None, None], ["in", [0, 99], None, None]], f"verify expects {numbers}")
    expect(case["checks"][2]["expected_text"] == "≤ 1×10¹¹", f"verify says {case}")

    (work / "study.yaml").write_text("runs: [{name: a, scene: scene.yaml}]\n"
                                     "figures: [{name: f, kind: history, runs: [a], y: disc.fy}]\n")
    [study] = objects(burnish, "figures", work / "study.yaml", "-o", work / "study", "--json")
    expect(study["runs"][0]["name"] == "a" and study["runs"][0]["state"] == "completed", f"figures says {study}")
    expect(pathlib.Path(study["figures"][0]["files"][0]).exists(), f"figures says {study}")
    expect(pathlib.Path(study["document"]).exists(), f"figures says {study}")


def main():
    burnish = pathlib.Path(sys.argv[1]).resolve()
    mistakes = []

    def expect(condition, sentence):
        if not condition:
            mistakes.append(sentence)

    with tempfile.TemporaryDirectory() as name:
        work = pathlib.Path(name)
        scene, out = work / "scene.yaml", work / "out"
        scene.write_text(yaml.safe_dump(SCENE, allow_unicode=True), encoding="utf-8")
        run(burnish, "run", scene, "-o", out, "--quiet")
        for cells in ("linear", "lagrange", "bezier"):
            run(burnish, "export", out, "-o", work / cells, "--cells", cells,
                "--parts", "body,tools,contact,points,net")
        # Charts show a text with a bar as outlines alone, which cannot be read back.
        run(burnish, "plot", out, "-o", work / "chart.svg", "--csv", work / "chart.csv",
            "--title", TITLE.replace("|", "/"), "--x-title", STRESS)
        run(burnish, "probe", out, "--face", "top", "-o", work / "probe.svg", "--csv", work / "probe.csv")
        run(burnish, "report", out, "-o", work / "report.html")
        run(burnish, "view", out, "-o", work / "view.html")

        check_json(burnish, work, scene, out, expect)

        files = sorted(work.rglob("*.vt[up]")) + sorted(work.rglob("*.pvd")) + sorted(work.rglob("*.svg"))
        expect(len(files) > 20, f"only {len(files)} XML files were found")
        for file in files:
            try:
                xml.parse(file)
            except xml.ParseError as error:
                mistakes.append(f"{file.relative_to(work)}: {error}")
        if not mistakes:
            names = array_names(next((out / "frames").glob("body_*.vtu")))
            expect(f"displacement [{LENGTH}]" in names, f"array names are {sorted(names)}")
            expect(f"von_mises [{STRESS}]" in names, f"array names are {sorted(names)}")
            drawn = "".join(xml.parse(work / "chart.svg").getroot().itertext())
            expect("quoted" in drawn, "the chart lost its title")

        summary = yaml.safe_load((out / "summary.yaml").read_text(encoding="utf-8"))
        expect(summary["completed"] is True, "summary.yaml does not say that the run was completed")
        for table in (out / "history.csv", out / "convergence.csv", work / "chart.csv", work / "probe.csv"):
            with table.open(newline="", encoding="utf-8") as stream:
                rows = list(csv.reader(stream, strict=True))
            expect(len({len(row) for row in rows}) == 1, f"{table.name} has rows of several lengths")

        for name in ("report.html", "view.html"):
            page = Page()
            page.feed((work / name).read_text(encoding="utf-8"))
            page.close()
            expect(not page.mistakes and not page.open, f"{name}: {page.mistakes[:3]} {page.open[:3]}")
            expect(TITLE.strip() in page.text, f"{name} does not show the title as it is")

    for mistake in mistakes:
        print(mistake)
    sys.exit(1 if mistakes else 0)


main()
