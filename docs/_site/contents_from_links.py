"""Tree of contents from the links of a page.

An index page (docs/index.md, a README.md in docs/ or cases/) lists its pages as links, in order.
Sphinx wants them in a `toctree`; it is appended here, so that the page stays plain Markdown. Each
page gets one parent: the first index that links to it.
"""
import pathlib
import re

LINK = re.compile(r"\]\(([^)#\s:]+\.(?:md|rst))(?:#[^)]*)?\)")
INDEXES = [  # in the order in which they may claim a page
    "docs/index",
    "docs/tutorials/README",
    "docs/theory/README",
    "docs/decisions/README",
    "cases/README",
    "bench/README",
]


def linked_pages(root, docname, text=None):
    page = root / f"{docname}.md"
    for target in LINK.findall(text or page.read_text(encoding="utf-8")):
        file = (page.parent / target).resolve()
        if file.is_file() and file.is_relative_to(root):
            yield file.relative_to(root).with_suffix("").as_posix()


def sections(root, docname):
    """The pages that are linked below each heading of the second level."""
    _, *parts = (root / f"{docname}.md").read_text(encoding="utf-8").split("\n## ")
    return {part.split("\n", 1)[0]: list(linked_pages(root, docname, part)) for part in parts}


def trees(root):
    """Of each index the pages below it: of docs/index under its headings, of others in one list."""
    claimed = set(INDEXES)
    below = {}
    for index in INDEXES[1:]:
        folder = pathlib.PurePosixPath(index).parent.as_posix() + "/"
        own = [page for page in linked_pages(root, index) if page.startswith(folder) and page not in claimed]
        below[index] = {"": list(dict.fromkeys(own))}
        claimed |= set(own)
    below[INDEXES[0]] = {}
    for heading, pages in sections(root, INDEXES[0]).items():
        own = [page for page in pages if page in INDEXES[1:] or page not in claimed]
        below[INDEXES[0]][heading] = list(dict.fromkeys(own))
        claimed |= set(own)
    return below


def append_toctree(app, docname, source):
    for heading, pages in trees(pathlib.Path(app.srcdir)).get(docname, {}).items():
        if pages:
            caption = f":caption: {heading}\n" if heading else ""
            lines = "\n".join(f"/{page}" for page in pages)
            source[0] += f"\n\n```{{toctree}}\n:hidden:\n{caption}\n{lines}\n```\n"


def setup(app):
    app.connect("source-read", append_toctree)
    return {"parallel_read_safe": True}
