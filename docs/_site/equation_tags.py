"""Equations get an anchor by their tag, and mentions of a tag such as (F.3) link to it.

Tags are given in docs/theory, as \\tag{F.3} in a formula or as (F.3) at the end of an indented line
(tests/documents_test.sh). A formula goes to MathJax as it is written: Sphinx would put formulas of
several lines into an environment in which \\tag is an error.
"""
import pathlib
import re

from docutils import nodes
from sphinx.transforms.post_transforms import SphinxPostTransform

GIVEN = re.compile(r"\\tag\{([A-Z]{1,2}\.[0-9]+[a-z]?)\}")
INDENTED = re.compile(r"^    .*\(([A-Z]{1,2}\.[0-9]+[a-z]?)\)$", re.MULTILINE)
MENTION = re.compile(r"\(([A-Z]{1,2}\.[0-9]+[a-z]?)\)|\b([A-Z]{1,2}\.[0-9]+[a-z]?)\b")
LITERAL = (nodes.literal, nodes.literal_block, nodes.math, nodes.math_block, nodes.reference, nodes.title)


def pages_of_tags(root):
    pages = {}
    for page in sorted((root / "docs" / "theory").glob("*.md")):
        text = page.read_text(encoding="utf-8")
        for tag in GIVEN.findall(text) + INDENTED.findall(text):
            pages[tag] = page.relative_to(root).with_suffix("").as_posix()
    return pages


class EquationTags(SphinxPostTransform):
    default_priority = 5

    def run(self, **_):
        if not hasattr(self.env, "pages_of_tags"):
            self.env.pages_of_tags = pages_of_tags(pathlib.Path(self.env.srcdir))
        self.anchors()
        for text in list(self.document.findall(nodes.Text)):
            if not self.within_literal(text):
                self.link(text)

    def within_literal(self, node):
        while node.parent is not None:
            node = node.parent
            if isinstance(node, LITERAL):
                return True
        return False

    def anchors(self):
        for block in list(self.document.findall(lambda node: isinstance(node, (nodes.math_block, nodes.literal_block)))):
            formula = isinstance(block, nodes.math_block)
            tags = GIVEN.findall(block.astext()) if formula else [t[0] or t[1] for t in MENTION.findall(block.astext())]
            tags = [tag for tag in tags if self.env.pages_of_tags.get(tag) == self.env.docname]
            for tag in tags:
                block.parent.insert(block.parent.index(block), nodes.target("", "", ids=[f"equation-{tag}"]))
            if formula:
                formula_text = f"\\[{block.astext()}\\]"
                block.clear()
                block += nodes.Text(formula_text)
                block["nowrap"] = True

    def link(self, text):
        parts, at = [], 0
        for match in MENTION.finditer(text):
            tag = match[1] or match[2]
            if tag not in self.env.pages_of_tags:
                continue
            parts += [nodes.Text(text[at : match.start()]), self.reference(tag, match[0])]
            at = match.end()
        if parts:
            text.parent.replace(text, parts + [nodes.Text(text[at:])])

    def reference(self, tag, words):
        page = self.env.pages_of_tags[tag]
        uri = self.app.builder.get_relative_uri(self.env.docname, page)
        return nodes.reference("", words, internal=True, refuri=f"{uri}#equation-{tag}")


def setup(app):
    app.add_post_transform(EquationTags)
    return {"parallel_read_safe": True}
