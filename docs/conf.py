# The site: `./dev docs` builds it from the Markdown pages into build/docs.
#
# Pages stay plain Markdown that reads well on a git host. What else a site needs is added here:
# the tree of contents from the links of an index page, anchors and links for equation tags such as
# (F.3), MathJax from Debian's package. See docs/_site.
import pathlib
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT / "docs" / "_site"))

project = "billet"
author = "The billet authors"
copyright = "The billet authors, GPL-3.0-or-later"
version = release = next(
    line.split("VERSION")[1].split()[0]
    for line in (ROOT / "CMakeLists.txt").read_text(encoding="utf-8").splitlines()
    if line.startswith("project(billet")
)

extensions = [
    "myst_parser",
    "sphinx.ext.mathjax",
    "breathe",
    "contents_from_links",
    "equation_tags",
    "local_mathjax",
]
root_doc = "docs/index"
include_patterns = [
    "README.md",
    "CHANGELOG.md",
    "CONTRIBUTING.md",
    "AUTHORS.md",
    "docs/**",
    "cases/**.md",
    "bench/**.md",
]
exclude_patterns = ["docs/_site/**", "**/results/**"]
source_suffix = {".md": "markdown", ".rst": "restructuredtext"}

myst_enable_extensions = ["dollarmath"]
myst_heading_anchors = 4
suppress_warnings = ["myst.header"]  # a page may go from level 1 to 3
highlight_language = "none"

breathe_projects = {"billet": str(ROOT / "build" / "doxygen" / "xml")}
breathe_default_project = "billet"

html_theme = "furo"
html_title = "billet"
html_extra_path = ["_site/index.html"]
html_static_path = ["_site/static"]
html_css_files = ["wide.css"]
html_copy_source = False
html_show_sourcelink = False
mathjax_path = "mathjax/MathJax.js?config=TeX-AMS_SVG"
myst_update_mathjax = False  # it would set up MathJax 3; Debian has 2.7
mathjax2_config = {
    "TeX": {"extensions": ["AMSmath.js", "AMSsymbols.js"]},
    "tex2jax": {"processClass": "math|tex2jax_process"},
    "showProcessingMessages": False,
}
