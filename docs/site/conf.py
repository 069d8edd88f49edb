# How Sphinx makes the site; docs/site/build_site.py lays out its sources.
import re

from docutils import nodes

project = "burnish"
author = copyright = "the authors of burnish"
extensions = ["myst_parser", "sphinx.ext.mathjax"]
source_suffix = {".md": "markdown"}
master_doc = "index"
language = "en"

myst_enable_extensions = ["dollarmath"]
myst_heading_anchors = 4
# The numbers of figures and equations that stand in the pages are those of the paper.
numfig = False
nitpicky = True

html_theme = "furo"
html_static_path = ["_static"]
html_css_files = ["site.css"]
html_title = "burnish"
html_show_sphinx = False
html_copy_source = False
html_theme_options = {"top_of_page_button": None}
pygments_style = "friendly"
pygments_dark_style = "monokai"

# MathJax of Debian, copied beside the pages: the site needs no network. SVG, which needs no fonts.
mathjax_path = "mathjax/MathJax.js?config=TeX-AMS_SVG"
myst_update_mathjax = False
mathjax2_config = {
    "tex2jax": {"processClass": "math"},
    "messageStyle": "none",
    "showMathMenu": False,
    "SVG": {"font": "TeX", "linebreaks": {"automatic": True, "width": "container"}, "EqnChunk": 200},
}


def _note_anchors(app, document):
    """Links to <a id="x"></a>, which pages have above headings of long titles, are found like those to headings."""
    page = app.env.docname
    for node in document.findall(nodes.raw):
        for name in re.findall(r'<a id="([\w-]+)">', node.astext()):
            app.env.get_domain("std").anonlabels[f"{app.env.doc2path(page, base=False)}#{name}"] = page, name


def setup(app):
    app.connect("doctree-read", _note_anchors)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
