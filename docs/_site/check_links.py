#!/usr/bin/env python3
"""Every local link and picture of the built site leads somewhere, anchors too.

usage: check_links.py FOLDER
"""
import html.parser
import pathlib
import sys
import urllib.parse


class Page(html.parser.HTMLParser):
    def __init__(self, file):
        super().__init__()
        self.anchors, self.links = set(), []
        self.feed(file.read_text(encoding="utf-8"))

    def handle_starttag(self, tag, attributes):
        for name, value in attributes:
            if name == "id" or (tag == "a" and name == "name"):
                self.anchors.add(value)
            elif (tag, name) in {("a", "href"), ("img", "src"), ("link", "href"), ("script", "src")} and value:
                self.links.append(value)


def dead_links(root):
    pages = {file: Page(file) for file in root.rglob("*.html") if "_static" not in file.parts}
    for file, page in sorted(pages.items()):
        for link in dict.fromkeys(page.links):
            parts = urllib.parse.urlsplit(link)
            if parts.scheme or parts.netloc:
                continue
            target = (file.parent / urllib.parse.unquote(parts.path)).resolve() if parts.path else file
            if not target.exists():
                yield f"{file.relative_to(root)}: no file {link}"
            elif parts.fragment and target in pages and urllib.parse.unquote(parts.fragment) not in pages[target].anchors:
                yield f"{file.relative_to(root)}: no anchor {link}"


def main():
    root = pathlib.Path(sys.argv[1]).resolve()
    dead = list(dead_links(root))
    if dead:
        print("\n".join(dead))
    sys.exit(1 if dead else 0)


if __name__ == "__main__":
    main()
