"""The site: built of all pages without a warning; every link leads to a file and a place in it, and nothing is fetched from a network.

Usage: site_test.py SOURCE MANUAL [CHROMIUM]     MANUAL: folder of the manual pages; a browser sets the formulas
"""

import html.parser
import pathlib
import re
import subprocess
import sys
import tempfile
import urllib.parse

FETCHED = {("script", "src"), ("img", "src"), ("link", "href"), ("iframe", "src"), ("source", "src")}
CAN_BE_FAR = {"canonical"}


class Page(html.parser.HTMLParser):
    def __init__(self, path):
        super().__init__()
        self.names, self.links, self.fetched = set(), set(), set()
        self.feed(path.read_text("utf-8"))

    def handle_starttag(self, tag, attributes):
        given = dict(attributes)
        self.names |= {given[key] for key in ("id", "name") if given.get(key)}
        for key in ("href", "src"):
            if given.get(key) and given.get("rel") not in CAN_BE_FAR:
                (self.fetched if (tag, key) in FETCHED else self.links).add(given[key])


def problems_of_links(site):
    pages = {path.resolve(): Page(path) for path in site.rglob("*.html")}
    for path, page in pages.items():
        here = path.relative_to(site)
        for link in sorted(page.links | page.fetched):
            parts = urllib.parse.urlsplit(link)
            if parts.scheme in ("http", "https"):
                if link in page.fetched:
                    yield f"{here} fetches {link} from the network"
                elif not parts.hostname or "." not in parts.hostname or " " in link:
                    yield f"{here} links to {link}, which is no address"
            elif parts.scheme == "mailto" or parts.scheme == "data":
                continue
            else:
                target = (path.parent / urllib.parse.unquote(parts.path)).resolve() if parts.path else path
                if not target.exists():
                    yield f"{here} links to {link}, which is not there"
                elif parts.fragment and target in pages and urllib.parse.unquote(parts.fragment) not in pages[target].names:
                    yield f"{here} links to {link}; there is no such place in that page"
    if len(pages) < 60:
        yield f"the site has {len(pages)} pages only"


def problems_of_styles(site):
    for path in site.rglob("*.css"):
        for place in re.findall(r"url\([\"']?((?:https?:)?/[^)\"']*)", path.read_text("utf-8")):
            yield f"{path.relative_to(site)} fetches {place}"


def problems_of_formulas(site, chromium):
    """Every formula of the theory is set, and no script of the page complains."""
    page = site / "docs/theory.html"
    shown = subprocess.run([chromium, "--headless", "--no-sandbox", "--disable-gpu", "--enable-logging=stderr", "--virtual-time-budget=20000",
                            "--dump-dom", page.as_uri()], capture_output=True, text=True)
    for line in re.findall(r".*CONSOLE.*", shown.stderr):
        yield f"the browser says of docs/theory.html: {line}"
    written = len(re.findall(r'class="math notranslate', page.read_text("utf-8")))
    typeset = len(re.findall(r'class="MathJax_SVG"', shown.stdout))
    if not written or typeset < written:
        yield f"docs/theory.html has {written} formulas, of which a browser sets {typeset}"


def main():
    source, manual = (pathlib.Path(argument).resolve() for argument in sys.argv[1:3])
    with tempfile.TemporaryDirectory() as name:
        site = pathlib.Path(name).resolve() / "site"
        built = subprocess.run([sys.executable, source / "docs/site/build_site.py", manual, site], capture_output=True, text=True)
        if built.returncode != 0 or built.stderr:
            wrong = [built.stdout + built.stderr]
        else:
            wrong = [*problems_of_links(site), *problems_of_styles(site)]
            for chromium in filter(None, sys.argv[3:]):
                wrong += problems_of_formulas(site, chromium)
    print(*wrong, sep="\n")
    sys.exit(1 if wrong else 0)


if __name__ == "__main__":
    main()
