"""MathJax of Debian's package libjs-mathjax, copied into the site: formulas need no network."""
import pathlib
import shutil

PACKAGE = pathlib.Path("/usr/share/javascript/mathjax")
PARTS = ["MathJax.js", "config/TeX-AMS_SVG.js", "extensions", "jax/input/TeX", "jax/element", "jax/output/SVG"]

OTHER_FONTS = shutil.ignore_patterns("Asana-Math", "Gyre-*", "Latin-Modern", "Neo-Euler", "STIX-Web")


def copy_mathjax(app, exception):
    if exception or app.builder.name != "html":
        return
    into = pathlib.Path(app.outdir) / "_static" / "mathjax"
    for part in PARTS:
        source = PACKAGE / part
        target = into / part
        if target.exists() or not source.exists():
            continue
        target.parent.mkdir(parents=True, exist_ok=True)
        if source.is_dir():
            shutil.copytree(source, target, ignore=OTHER_FONTS)
        else:
            shutil.copy(source, target)


def setup(app):
    app.connect("build-finished", copy_mathjax)
    return {"parallel_read_safe": True}
