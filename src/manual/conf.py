"""Settings of Sphinx for the manual; build.py starts it."""

import os
import re
import sys

from docutils import nodes
from docutils.utils.math.latex2mathml import tex2mathml

REPOSITORY = os.environ["VIBROTROUGH_SOURCE"]
sys.path.insert(0, os.path.join(REPOSITORY, "postprocess"))

project = "Vibrotrough"
release = os.environ["VIBROTROUGH_VERSION"]
copyright = "the authors of Vibrotrough, BSD-3-Clause"
extensions = ["myst_parser", "sphinx.ext.autodoc", "sphinx_copybutton"]
myst_enable_extensions = ["dollarmath", "deflist"]
myst_heading_anchors = 4
suppress_warnings = ["myst.header"]
exclude_patterns = ["parts"]
default_role = "code"
autodoc_member_order = "bysource"
autodoc_mock_imports = ["h5py", "pandas", "vibrotrough._theory"]
smartquotes = False
html_theme = "furo"
html_title = f"Vibrotrough {release}"
html_static_path = ["_static"]
html_css_files = ["manual.css"]
html_show_sphinx = html_show_sourcelink = html_copy_source = False
html_math_renderer = "mathml"
highlight_language = "none"


def mathml(text: str, block: bool) -> str:
    """A formula as MathML, which browsers set without a script; \\tag{6} is the number that it has in the paper."""
    tag = re.search(r"\\tag\{(.*?)\}", text)
    formula = tex2mathml(re.sub(r"\\tag\{.*?\}", "", text), inline=not block)
    formula = re.sub(r"<mi>(arcsin|sin|cos|tan|min|log)</mi>", r'<mrow><mspace width="0.17em"/><mi>\1</mi><mspace width="0.17em"/></mrow>', formula)
    return f'<span class="tag">({tag[1]})</span>{formula}' if tag else formula


def inline(writer, node) -> None:
    writer.body.append(mathml(node.astext(), block=False))
    raise nodes.SkipNode


def display(writer, node) -> None:
    writer.body.append(f'<div class="math">{mathml(node.astext(), block=True)}</div>')
    raise nodes.SkipNode


def for_sphinx(app, what, name, obj, options, lines: list[str]) -> None:
    """Docstrings name parameters as Doxygen does, and show code by indentation, as Markdown does."""
    text = re.sub(r"@(param \w+|return) +(.*(?:\n {6,}\S.*)*)", lambda found: f":{found[1]}: " + " ".join(found[2].split()), "\n".join(lines))
    lines.clear()
    in_code = False
    for line in text.split("\n"):
        starts = line.startswith("    ") and not in_code
        ends = bool(lines) and lines[-1].startswith((":param", ":return")) and not line.startswith(":")
        lines += ["", "::", "", line] if starts else ["", line] if ends else [line]
        in_code = line.startswith("    ") or (in_code and not line)


def setup(app) -> None:
    app.connect("autodoc-process-docstring", for_sphinx)
    app.add_html_math_renderer("mathml", (inline, None), (display, None))
