"""What stands in more than one file says the same: the version in CMakeLists.txt, CITATION.cff and CHANGELOG.md. CITATION.cff has what the
Citation File Format 1.2.0 asks for, and issue forms what the page of the repository asks for. Every fuzz target has a row in
docs/reliability.md. What the Dockerfile takes, .dockerignore lets in.

Usage: papers_test.py SOURCE
"""

import pathlib
import re
import sys

import yaml

CFF_KEYS = {"abstract", "authors", "cff-version", "commit", "contact", "date-released", "doi", "identifiers", "keywords", "license",
            "license-url", "message", "preferred-citation", "references", "repository", "repository-artifact", "repository-code", "title",
            "type", "url", "version"}
CFF_NEEDED = {"cff-version", "message", "title", "authors"}
PERSON, ENTITY = {"family-names", "given-names", "orcid", "affiliation"}, {"name", "website"}
FORM_TYPES = {"markdown", "textarea", "input", "dropdown", "checkboxes"}


def problems_of_authors(authors, place):
    for author in authors:
        if not (set(author) <= PERSON and "family-names" in author or set(author) <= ENTITY and "name" in author):
            yield f"CITATION.cff: {place}: {author} is neither a person nor an entity"


def problems_of_citation(citation, version):
    if str(citation.get("version")) != version:
        yield f"CITATION.cff: version {citation.get('version')}; CMakeLists.txt has {version}"
    if citation.get("cff-version") != "1.2.0":
        yield "CITATION.cff: cff-version is not 1.2.0"
    for key in sorted(CFF_NEEDED - set(citation)) + sorted(set(citation) - CFF_KEYS):
        yield f"CITATION.cff: {key} is " + ("missing" if key in CFF_NEEDED else "no key of the format")
    yield from problems_of_authors(citation.get("authors", []), "authors")
    for reference in citation.get("references", []):
        for key in {"authors", "title", "type"} - set(reference):
            yield f"CITATION.cff: a reference has no {key}"
        yield from problems_of_authors(reference.get("authors", []), "references")


def problems_of_form(path):
    form = yaml.safe_load(path.read_text("utf-8"))
    for key in {"name", "description", "body"} - set(form):
        yield f"{path.name}: {key} is missing"
    names = [part.get("id") for part in form.get("body", [])]
    if len(set(names)) != len(names):
        yield f"{path.name}: two parts have the same id"
    for part in form.get("body", []):
        if part.get("type") not in FORM_TYPES or "label" not in part.get("attributes", {}):
            yield f"{path.name}: {part} needs a type of {sorted(FORM_TYPES)} and a label"


def problems_of_fuzz_targets(source):
    targets = re.search(r"^targets=\((.*)\)", (source / "scripts/fuzz").read_text("utf-8"), re.MULTILINE)[1].split()
    rows = re.findall(r"^\| (\w+) \|", (source / "docs/reliability.md").read_text("utf-8"), re.MULTILINE)
    for target in targets:
        if target not in rows:
            yield f"docs/reliability.md: scripts/fuzz has a target {target}, and the table no row for it"


def problems_of_image(source):
    taken = re.search(r"source=(\S+?),target=/packages", (source / "Dockerfile").read_text("utf-8"))[1]
    ignored = (source / ".dockerignore").read_text("utf-8").split()
    if ignored != ["*", f"!{taken}/*.deb"]:
        yield f".dockerignore: {ignored}; expected all but the packages in {taken}"


def main():
    source = pathlib.Path(sys.argv[1])
    version = re.search(r"project\(burnish VERSION ([\d.]+)", (source / "CMakeLists.txt").read_text("utf-8"))[1]
    wrong = list(problems_of_citation(yaml.safe_load((source / "CITATION.cff").read_text("utf-8")), version))
    newest = re.search(r"^## (\S+)", (source / "CHANGELOG.md").read_text("utf-8"), re.MULTILINE)[1]
    if newest != version:
        wrong.append(f"CHANGELOG.md: the newest version is {newest}; CMakeLists.txt has {version}")
    wrong += [*problems_of_fuzz_targets(source), *problems_of_image(source)]
    for path in sorted((source / ".github/ISSUE_TEMPLATE").glob("*.yml")):
        if path.name != "config.yml":
            wrong += problems_of_form(path)
    print(*wrong, sep="\n")
    sys.exit(1 if wrong else 0)


if __name__ == "__main__":
    main()
