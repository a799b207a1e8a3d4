#!/usr/bin/env python3
"""Every case, study and chart file of the project fits the schema of `billet schema`, and no longer
does once a key of it is misspelt. Status 77 (skipped) without python3-jsonschema.

    schema_test.py BILLET SOURCE_DIR [FILE.toml ...]      files: further ones, cases
"""

import copy
import json
import pathlib
import re
import subprocess
import sys
import tomllib

try:
    import jsonschema
except ImportError:
    print("python3-jsonschema is not there")
    sys.exit(77)

KINDS = ("case", "study", "chart")
NAMED = re.compile(r"^material$")  # a table whose keys the user names
FREE = re.compile(r"(^|\.)(set|reference)$")  # whose keys and values are those of another file


def validators(program):
    for kind in KINDS:
        text = subprocess.run([program, "schema", kind], check=True, capture_output=True).stdout
        schema = json.loads(text)
        jsonschema.Draft202012Validator.check_schema(schema)
        yield kind, jsonschema.Draft202012Validator(schema)


def kind_of(document):
    if "analysis" in document:
        return "case"
    if "law" in document and "y" in document:
        return "chart"
    return "study" if "vary" in document or "quantity" in document else None


def blocks(text):
    """TOML examples of a page that are whole files, one as it stands after the other."""
    for match in re.finditer(r"```toml\n(.*?)```", text, re.S):
        try:
            document = tomllib.loads(match[1])
        except tomllib.TOMLDecodeError:
            continue  # a piece of a file
        if kind_of(document):
            yield document


def documents(root):
    for path in sorted(root.glob("cases/*/*.toml")) + sorted(root.glob("bench/*/*.toml")) + sorted(
        root.glob("tests/fuzz/corpus/case/*.toml")
    ):
        document = tomllib.loads(path.read_text())
        if kind_of(document):
            yield str(path.relative_to(root)), document
    for path in [root / "README.md", *sorted(root.glob("docs/**/*.md")), *sorted(root.glob("cases/*/README.md"))]:
        for number, document in enumerate(blocks(path.read_text())):
            yield f"{path.relative_to(root)} example {number + 1}", document


def misspelt(node, path=""):
    """Copies of a document, each with one key changed that the user is not free to choose."""
    if isinstance(node, list):
        for index, item in enumerate(node):
            for changed in misspelt(item, f"{path}.{index}"):
                yield node[:index] + [changed] + node[index + 1 :]
    if not isinstance(node, dict) or FREE.search(path):
        return
    for key in node:
        inner = f"{path}.{key}".lstrip(".")
        if not NAMED.match(path):
            yield {(name if name != key else key + "_x"): value for name, value in node.items()}
        for changed in misspelt(node[key], inner):
            yield {name: (value if name != key else changed) for name, value in node.items()}


def main():
    program, root = sys.argv[1], pathlib.Path(sys.argv[2])
    schemas = dict(validators(program))
    failed = n_documents = n_misspelt = 0
    further = [(name, tomllib.loads(pathlib.Path(name).read_text())) for name in sys.argv[3:]]
    for name, document in [*documents(root), *further]:
        n_documents += 1
        validator = schemas[kind_of(document)]
        for error in validator.iter_errors(document):
            failed += 1
            print(f"{name}: {'.'.join(map(str, error.absolute_path))}: {error.message[:200]}")
        for changed in misspelt(copy.deepcopy(document)):
            n_misspelt += 1
            if validator.is_valid(changed):
                failed += 1
                print(f"{name}: a misspelt key is not found: {changed}")
    print(f"{n_documents} files, {n_misspelt} with a misspelt key, {failed} wrong")
    if n_documents < 30:
        print("too few files were found")
        return 1
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
