"""Tables of docs/trade.md: what stands between their marks."""

import math
import re

BEGIN, END = "<!-- measured: {} -->", "<!-- end of {} -->"


def percent(value):
    return "-" if math.isnan(value) else f"{100 * value:.2g} %"


def pipes(head, table):
    return "\n".join(["| " + " | ".join(head) + " |", "|" + "---|" * len(head),
                      *("| " + " | ".join(line) + " |" for line in table)])


def replaced(page, name, content):
    begin, end = BEGIN.format(name), END.format(name)
    pattern = re.compile(re.escape(begin) + ".*?" + re.escape(end), re.DOTALL)
    if not pattern.search(page):
        raise SystemExit(f"the page has no place for {name}: {begin}")
    return pattern.sub(lambda _: f"{begin}\n{content}\n{end}", page)


def table(page, name):
    """Rows of the table between the marks of `name`, as dictionaries."""
    begin = page.index(BEGIN.format(name))
    lines = [line for line in page[begin:page.index(END.format(name))].splitlines() if line.startswith("|")]
    cells = [[cell.strip() for cell in line.strip("|").split("|")] for line in lines]
    return [dict(zip(cells[0], row)) for row in cells[2:]]


def number(text):
    return float(text.split()[0]) if text[0].isdigit() else math.nan
