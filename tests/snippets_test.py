#!/usr/bin/env python3
"""What the pages show works: their files are read, their commands run, their outputs compared; and
every command and option of the program is on the page of the command line.

usage: snippets_test.py PROGRAM [--long | --list] [PAGE ...]

PROGRAM is the built `billet`. Pages are README.md and those of docs/, docs/tutorials, docs/guide and
docs/theory. Each is taken in a folder of its own, from top to bottom. What is to be done with a block
of code stands in a comment in the line before it, which no reader of the page sees:

    <!-- file: NAME -->                     the block is the file NAME
    <!-- not run: REASON -->                commands that are not run
    <!-- long -->                           commands that are run with --long only
    <!-- before: COMMAND -->                is run before the block; $CASES is the folder cases/
    <!-- program: NAME -->                  commands that are run only where that program is installed
    <!-- needs: PAGE -->                    files of another page are written first
    <!-- output of the last command -->     the last command prints this: the same words, numbers to 2 %
    <!-- snippets: long -->                 (first line of a page) all of the page with --long only

Blocks of `sh` and `python` are run, blocks of `toml` without a name are fragments, which have to be
TOML; a complete case (it has `analysis`) needs a name and has to pass `billet check`. A command that
is indented in place of standing in a block is refused: nothing would run it.
"""
import os
import pathlib
import re
import shlex
import shutil
import subprocess
import sys
import tempfile
import tomllib

ROOT = pathlib.Path(__file__).resolve().parent.parent
PAGES = ["README.md", "docs/*.md", "docs/tutorials/*.md", "docs/guide/*.md", "docs/theory/*.md"]
OF_THE_PACKAGE = ["docs/guide/python.md", "docs/tutorials/scripting.md"]  # python/tests run their Python
INDENTED = re.compile(r" {4,}(\$ )?(billet |\./dev |apt |git |pip |mpiexec )")
MARK = re.compile(r"<!-- (.*?)(?:: (.*?))? -->$")
NUMBER = re.compile(r"-?\d+(?:\.\d+)?(?:e[-+]\d+)?")


class Block:
    def __init__(self, page, line, language, marks):
        self.page, self.line, self.language, self.marks = page, line, language, marks
        self.text = ""

    def place(self):
        return f"{self.page}:{self.line}"


def blocks(page):
    """The fenced blocks of a page, each with the comments before it."""
    found, marks, block = [], {}, None
    for number, line in enumerate((ROOT / page).read_text(encoding="utf-8").splitlines(), 1):
        if line.lstrip().startswith("```"):  # in a list it is indented
            if block is None:
                indent = len(line) - len(line.lstrip())
                block = Block(page, number, line.strip()[3:].strip(), marks)
            else:
                found.append(block)
                block, marks = None, {}
        elif block is not None:
            block.text += line[min(indent, len(line) - len(line.lstrip())):] + "\n"
        elif mark := MARK.match(line):
            marks[mark[1]] = mark[2] or ""
        elif line.strip():
            marks = {}
    return found


def indented_commands(page):
    """Commands that stand in no block; those within blocks of output are the blocks' own."""
    within = False
    for number, line in enumerate((ROOT / page).read_text(encoding="utf-8").splitlines(), 1):
        if line.lstrip().startswith("```"):
            within = not within
        elif not within and INDENTED.match(line):
            yield f"{page}:{number}: an indented command, which nothing runs: put it into a block of sh"


def is_long(page):
    return (ROOT / page).read_text(encoding="utf-8").startswith("<!-- snippets: long -->")


def same_output(printed, shown):
    """The same words; numbers may differ by 2 %."""
    printed, shown = printed.strip(), shown.strip()
    if NUMBER.sub("#", printed) != NUMBER.sub("#", shown):
        return False
    pairs = zip(map(float, NUMBER.findall(printed)), map(float, NUMBER.findall(shown)))
    return all(abs(a - b) <= 0.02 * abs(b) + 1e-12 for a, b in pairs)


class Page:
    """Runs one page in a folder of its own."""

    def __init__(self, page, program, long):
        self.page, self.long = page, long
        self.environment = dict(os.environ, PATH=f"{program.parent}:{os.environ['PATH']}", LC_ALL="C.UTF-8",
                                CASES=str(ROOT / "cases"))
        self.output, self.complaints = "", []

    def complain(self, block, what):
        self.complaints.append(f"{block.place()}: {what}")

    def run(self):
        with tempfile.TemporaryDirectory() as folder:
            self.folder = pathlib.Path(folder)
            for block in blocks(self.page):
                self.take(block)
        return self.complaints

    def take(self, block):
        if "needs" in block.marks:
            for other in blocks(block.marks["needs"]):
                if "file" in other.marks:
                    self.write(other)
        if "file" in block.marks:
            self.write(block)
            self.check_case(block)
        elif block.language == "toml":
            self.check_fragment(block)
        elif block.language in ("sh", "python") and self.is_run(block):
            if "before" in block.marks:
                self.call(block, block.marks["before"])
            if block.language == "sh":
                self.run_commands(block)
            elif self.page not in OF_THE_PACKAGE:
                self.run_python(block)
        elif "output of the last command" in block.marks and not same_output(self.output, block.text):
            self.complain(block, f"the last command printed\n{self.output}")

    def is_run(self, block):
        missing = "program" in block.marks and not shutil.which(block.marks["program"])
        return not missing and "not run" not in block.marks and (self.long or "long" not in block.marks)

    def write(self, block):
        file = self.folder / block.marks["file"]
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(block.text, encoding="utf-8")

    def parsed(self, block):
        try:
            return tomllib.loads(block.text)
        except tomllib.TOMLDecodeError as error:
            self.complain(block, f"no TOML: {error}")
            return {}

    def check_fragment(self, block):
        if "analysis" in self.parsed(block):
            self.complain(block, "a complete case needs its name before it: <!-- file: NAME -->")

    def check_case(self, block):
        if block.language != "toml" or "analysis" not in self.parsed(block):
            return
        missing = [name for name in re.findall(r'"([\w-]+\.stl)"', block.text) if not list(self.folder.rglob(name))]
        if not missing:
            self.call(block, f"billet check {block.marks['file']}")

    def run_commands(self, block):
        for command in re.sub(r"\\\n", " ", block.text).splitlines():
            if command.strip():
                self.call(block, command)

    def run_python(self, block):
        (self.folder / "block.py").write_text(block.text, encoding="utf-8")
        self.call(block, f"{shlex.quote(sys.executable)} block.py")

    def call(self, block, command):
        done = subprocess.run(["bash", "-c", command], cwd=self.folder, env=self.environment, text=True,
                              stdout=subprocess.PIPE, stderr=subprocess.PIPE, check=False)
        self.output = done.stdout
        if done.returncode != 0:
            self.complain(block, f"`{command}` ended with {done.returncode}\n{done.stdout}{done.stderr}")


def undocumented_options(program):
    """Commands and options that the program knows and docs/guide/command-line.md does not."""
    page = (ROOT / "docs" / "guide" / "command-line.md").read_text(encoding="utf-8")
    for command in re.findall(r"^  billet ([a-z]+) ", subprocess.check_output([program, "help"], text=True), re.MULTILINE):
        if f"billet {command}" not in page:
            yield f"docs/guide/command-line.md: no command {command}"
        for option in re.findall(r"(?<!\w)--[a-z-]+", subprocess.check_output([program, command, "--help"], text=True)):
            if option not in page:
                yield f"docs/guide/command-line.md: {command} has an option {option}"


def main():
    words = sys.argv[1:]
    long, listed = "--long" in words, "--list" in words
    names = [word for word in words if not word.startswith("--")]
    if not names:
        sys.exit(__doc__)
    program = pathlib.Path(names[0]).resolve()
    pages = names[1:] or sorted(str(page.relative_to(ROOT)) for each in PAGES for page in ROOT.glob(each))
    if listed:
        print("\n".join(f"{page}{' (long)' if is_long(page) else ''}" for page in pages))
        return
    complaints = list(undocumented_options(program))
    for page in pages:
        complaints += indented_commands(page)
        if long or not is_long(page):
            complaints += Page(page, program, long).run()
    print("\n".join(complaints), end="\n" if complaints else "")
    sys.exit(1 if complaints else 0)


if __name__ == "__main__":
    main()
