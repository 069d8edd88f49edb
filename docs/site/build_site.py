#!/usr/bin/env python3
"""Builds the site of burnish from the pages in docs, as they are.

Usage: build_site.py MANUAL OUTPUT     MANUAL: folder of the manual pages, as `burnish manual` writes them
"""

import html
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

import yaml

SOURCE = pathlib.Path(__file__).resolve().parents[2]
HERE = SOURCE / "docs/site"
MATHJAX = pathlib.Path("/usr/share/javascript/mathjax")
MATHJAX_PARTS = ["MathJax.js", "config/TeX-AMS_SVG.js", "extensions/TeX", "extensions/MathEvents.js", "extensions/AssistiveMML.js",
                 "jax/element", "jax/input/TeX", "jax/output/SVG/autoload", "jax/output/SVG/fonts/TeX", "jax/output/SVG/jax.js",
                 "jax/output/SVG/config.js"]
PICTURE = re.compile(r"!\[([^\]]*)\]\(<?[\w./]*images/gallery/([\w-]+)\.png>?\)")


class Problem(Exception):
    pass


def pages():
    """All pages, by their place below the source."""
    for path in [SOURCE / "README.md", SOURCE / "CHANGELOG.md", SOURCE / "CONTRIBUTING.md",
                 *sorted(SOURCE.glob("docs/*.md")), *sorted(SOURCE.glob("docs/tutorial/*.md"))]:
        yield path.relative_to(SOURCE), path.read_text("utf-8")


def index():
    """The first page; pages of docs that its lists do not name stand in one more list at their end."""
    text = (HERE / "index.md").read_text("utf-8")
    more = [place.with_suffix("").as_posix() for place, _ in pages()]
    more = [page for page in more if not re.search(rf"^(.*<)?{page}>?$", text, re.MULTILINE)]
    return text + ("\n```{toctree}\n:hidden:\n:caption: More\n\n" + "\n".join(more) + "\n```\n" if more else "")


def lay_out(directory):
    """Pages, and what they show and link to, in the places that their links expect."""
    for place, text in pages():
        (directory / place).parent.mkdir(parents=True, exist_ok=True)
        (directory / place).write_text(text, "utf-8")
    for name in ("scenes", "images", "docs/images", "postproc/draw/page/themes"):
        (directory / name).parent.mkdir(parents=True, exist_ok=True)
        (directory / name).symlink_to(SOURCE / name)
    for path in [SOURCE / "LICENSE", *(path for path in SOURCE.glob("docs/*.*") if path.suffix != ".md")]:
        (directory / path.relative_to(SOURCE)).symlink_to(path)
    shutil.copy(HERE / "conf.py", directory)
    (directory / "index.md").write_text(index(), "utf-8")
    (directory / "_static/mathjax").mkdir(parents=True)
    shutil.copy(HERE / "site.css", directory / "_static")
    for part in MATHJAX_PARTS:
        target = directory / "_static/mathjax" / part
        target.parent.mkdir(parents=True, exist_ok=True)
        if (MATHJAX / part).is_dir():
            shutil.copytree(MATHJAX / part, target)
        else:
            shutil.copy(MATHJAX / part, target)


def scenes_of_pictures():
    """The scene, study or measured data of each picture of the gallery, None for those of no scene."""
    scenes = {}
    for picture in sorted((SOURCE / "images/gallery").glob("*.png")):
        example = f"scenes/examples/{picture.stem.replace('-', '_')}.yaml"
        scenes[picture.stem] = example if (SOURCE / example).is_file() else None
    for scene, names in yaml.safe_load((HERE / "gallery.yaml").read_text("utf-8")).items():
        if not (SOURCE / scene).is_file():
            raise Problem(f"docs/site/gallery.yaml: there is no scene {scene}")
        for name in names:
            if name not in scenes:
                raise Problem(f"docs/site/gallery.yaml: {scene}: there is no picture images/gallery/{name}.png")
            scenes[name] = scene
    return scenes


def kind_of(scene):
    """What a file is that a picture is of, its language and the command that computes it."""
    if scene.endswith(".csv"):
        return "data", "text", None
    return ("study", "yaml", "figures") if "\nruns:" in (SOURCE / scene).read_text("utf-8") else ("scene", "yaml", "run")


def write_gallery(directory):
    """A page of cards, and for each picture one with its scene."""
    scenes = scenes_of_pictures()
    told = {}
    for place, text in pages():
        for caption, name in PICTURE.findall(text):
            # A page of docs tells more of a picture than the README, which has it only beside others.
            if name not in told or told[name][0].name == "README.md":
                told[name] = place, " ".join(caption.split())
    for name in sorted(scenes.keys() - told.keys()):
        raise Problem(f"images/gallery/{name}.png is shown on no page")

    cards = []
    (directory / "gallery").mkdir()
    for name, scene in sorted(scenes.items()):
        page, caption = told[name]
        link = "[at a glance](../README.md)" if page.name == "README.md" else f"[](../{page})"
        title = re.split(r"[.:;] ", caption.rstrip("."))[0]
        cards.append(f'<figure><a class="picture" href="{name}.html"><img loading="lazy" src="../_images/{name}.png" '
                     f'alt="{html.escape(caption)}"></a><figcaption>{html.escape(title)}</figcaption></figure>')
        text = f"# {title}\n\n![{caption}](../images/gallery/{name}.png)\n\n{caption.rstrip('.')}. More: {link}.\n"
        if scene:
            kind, language, command = kind_of(scene)
            text += f"\n## Its {kind}\n\n" + (f"    burnish {command} {scene}\n\n" if command else "")
            text += f"```{{literalinclude}} ../{scene}\n:language: {language}\n:class: scene\n```\n"
        (directory / "gallery" / f"{name}.md").write_text("---\norphan: true\n---\n\n" + text, "utf-8")
    (directory / "gallery/index.md").write_text(
        "# Gallery\n\nEach picture leads to the page that tells of it and, where it is of one, to its scene, study or data. All are drawn "
        "by burnish; in three, those of F3D and ParaView stand beside.\n\n"
        "```{raw} html\n<div class=\"gallery\">\n" + "\n".join(cards) + "\n</div>\n```\n", "utf-8")


def write_reference(directory, manual):
    """The manual pages of the commands."""
    (directory / "reference").mkdir()
    names = []
    for path in sorted(manual.glob("man1/*.1"), key=lambda path: path.stem):
        text = subprocess.run(["mandoc", "-T", "html", "-O", "fragment", path], check=True, capture_output=True, text=True).stdout
        text = text.replace("<h1", "<h2").replace("</h1>", "</h2>")
        purpose = re.search(r"NAME</a></h2>\s*<p[^>]*>\s*\S+ - (.*?)</p>", text, re.DOTALL)
        names.append((path.stem, " ".join(purpose[1].split())))
        (directory / "reference" / f"{path.stem}.md").write_text(
            f"# {path.stem.replace('-', ' ', 1)}\n\n```{{raw}} html\n<div class=\"manual\">\n{text}\n</div>\n```\n", "utf-8")
    if not names:
        raise Problem(f"{manual}: there are no manual pages; build the program, which writes them")
    table = "".join(f"| [{name.replace('-', ' ', 1)}]({name}.md) | {purpose} |\n" for name, purpose in names)
    (directory / "reference/index.md").write_text(
        "# Commands\n\nWhat `man` shows, too. Keys of scenes: [](../docs/scene.md); of studies: [](../docs/study.md). For editors: "
        "[scene.schema.json](../docs/scene.schema.json), [study.schema.json](../docs/study.schema.json).\n\n"
        f"| command | does |\n| --- | --- |\n{table}\n```{{toctree}}\n:hidden:\n\n" + "\n".join(name for name, _ in names) + "\n```\n",
        "utf-8")


def complete_theme(static):
    """Debian's furo takes parts from a web server, and has lost the rule that pages are dark where the system is; here both are put
    into its own files, so that pages can be read without a server."""
    script, styles = static / "scripts/furo.js", static / "styles/furo.css"
    text = script.read_text("utf-8")
    if text.startswith("import Gumshoe"):
        script.write_text((static / "scripts/gumshoe-patched.js").read_text("utf-8") + text.split("\n", 1)[1], "utf-8")
    text = styles.read_text("utf-8")
    text = re.sub(r"@import url\((/javascript/[^)]*)\);", lambda match: pathlib.Path("/usr/share" + match[1]).read_text("utf-8"), text)
    if "prefers-color-scheme" not in text:
        dark = re.search(r'body\[data-theme="dark"\] (\{[^}]*\})', text)[1]
        text += f'\n@media not print {{ @media (prefers-color-scheme: dark) {{ body:not([data-theme="light"]) {dark} }} }}\n'
    styles.write_text(text, "utf-8")


def version():
    return re.search(r"project\(burnish VERSION ([\d.]+)", (SOURCE / "CMakeLists.txt").read_text("utf-8"))[1]


def build(manual, output):
    with tempfile.TemporaryDirectory() as name:
        directory = pathlib.Path(name)
        lay_out(directory)
        write_gallery(directory)
        write_reference(directory, manual)
        shutil.rmtree(output, ignore_errors=True)
        done = subprocess.run(["sphinx-build", "-q", "-W", "-n", "--keep-going", "-j", "auto", "-d", directory / ".doctrees",
                               "-D", f"release={version()}", directory, output])
        if done.returncode != 0:
            raise Problem("the site was not built: see the messages above")
        complete_theme(output / "_static")
        (output / ".buildinfo").unlink(missing_ok=True)


def main():
    if len(sys.argv) != 3:
        print(__doc__.strip(), file=sys.stderr)
        sys.exit(2)
    try:
        build(pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2]).resolve())
    except Problem as problem:
        print(f"build_site: {problem}", file=sys.stderr)
        sys.exit(1)


if __name__ == "__main__":
    main()
