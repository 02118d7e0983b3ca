"""How the documentation site is made: `make docs` writes it to out/docs."""

import importlib.metadata
import re
import shutil
import sys
from pathlib import Path

from docutils import nodes
from latex2mathml.converter import convert
from sphinx.application import Sphinx
from sphinx.writers.html5 import HTML5Translator

DOCS = Path(__file__).parent
ROOT = DOCS.parent
sys.path.insert(0, str(DOCS))

import generated  # noqa: E402

project = "drumrs"
author = "The drumrs authors"
release = importlib.metadata.version("drumrs")
extensions = [
    "myst_parser",
    "sphinx.ext.autodoc",
    "sphinx.ext.autosummary",
    "numpydoc",
    "sphinx_copybutton",
    "sphinx_design",
    "sphinx_gallery.gen_gallery",
]
# What other pages include; a table without a title, which the page above it links to.
exclude_patterns = ["_generated/commands.md", "_generated/keys.md", "verification/peers.md"]
root_doc = "index"
nitpicky = False
# What docstrings quote once is code.
default_role = "code"
toc_object_entries_show_parents = "hide"
templates_path = ["templates"]

# Pages are written for reading in the repository, too: plain Markdown with a little more.
myst_enable_extensions = ["dollarmath", "amsmath", "colon_fence", "deflist"]
myst_heading_anchors = 4
myst_links_external_new_tab = True
# Tables of the registry and of the study begin at the second level.
suppress_warnings = ["myst.header"]

# The gallery runs what makes pictures, in small, and again only where the script has changed.
sphinx_gallery_conf = {
    "examples_dirs": "../examples",
    "gallery_dirs": "gallery",
    "filename_pattern": r"/(01|02|06|07|09|1\d)_",
    "reset_argv": "gallery_pictures.arguments",
    "image_scrapers": ("gallery_pictures.written",),
    "default_thumb_file": str(DOCS / "site" / "script.svg"),
    "capture_repr": (),
    "within_subsection_order": "FileNameSortKey",
    "abort_on_example_error": True,
    "copyfile_regex": "",
    "download_all_examples": False,
    "notebook_extensions": set(),
    "remove_config_comments": True,
    "show_signature": False,
    "min_reported_time": 1e9,
    "write_computation_times": False,
}

autosummary_generate = True
autodoc_member_order = "bysource"
autodoc_typehints = "none"
numpydoc_show_class_members = False
numpydoc_xref_param_type = False

# Output that is shown has no language.
highlight_language = "none"
html_math_renderer = "mathml"
html_context = {"default_mode": "auto"}
html_theme = "pydata_sphinx_theme"
html_title = f"drumrs {release}"
html_static_path = ["site"]
html_css_files = ["site.css"]
html_js_files = ["site.js"]
html_show_sourcelink = False
html_theme_options = {
    "navbar_align": "left",
    "header_links_before_dropdown": 9,
    "show_toc_level": 2,
    "show_prev_next": True,
    "secondary_sidebar_items": ["page-toc"],
    "footer_start": ["copyright"],
    "footer_end": [],
    "pygments_light_style": "a11y-high-contrast-light",
    "pygments_dark_style": "a11y-high-contrast-dark",
}
copyright = "the drumrs authors; MIT or Apache 2.0"
copybutton_prompt_text = r">>> |\.\.\. |\$ "
copybutton_prompt_is_regexp = True

_LINK = re.compile(r"(?<!!)\[([^\]]+)\]\(([^)\s#]+)(#[^)\s]*)?\)")


def only_links_within_the_site(app: Sphinx, docname: str, source: list[str]) -> None:
    """Turn links to files of the repository that are no page of the site into words.

    In the repository each of them leads somewhere; the site has no sources beside it. Examples are in the gallery.
    """
    page = Path(app.env.doc2path(docname))
    if page.suffix != ".md":
        return
    copies = {ROOT / original: copy for copy, original in generated.COPIES.items()}
    original = generated.COPIES.get(page.name) if page.parent == generated.FOLDER else None
    base = (ROOT / original).parent if original else page.parent

    def resolved(match: re.Match[str]) -> str:
        words, target, anchor = match[1], match[2], match[3] or ""
        if "://" in target:
            return match[0]
        path = (base / target).resolve()
        if path.parent == ROOT / "examples" and path.suffix == ".py":
            path = DOCS / "gallery" / f"{path.stem}.rst"
        path = path / "README.md" if path.is_dir() else path
        path = generated.FOLDER / copies[path] if path in copies else path
        if (
            not path.exists()
            or DOCS not in path.parents
            or path.relative_to(DOCS).as_posix() in exclude_patterns
        ):
            return words
        up = "../" * (len(page.relative_to(DOCS).parts) - 1)
        return f"[{words}]({up}{path.relative_to(DOCS).as_posix()}{anchor})"

    source[0] = _LINK.sub(resolved, source[0])


def add_rust(app: Sphinx, error: Exception | None) -> None:
    """Put what `cargo doc` has made beside the pages, where it is there."""
    if error is None and app.builder.name == "html" and generated.RUST.is_dir():
        shutil.copytree(generated.RUST, app.outdir / "rust", dirs_exist_ok=True)


def bars_are_bars(
    _app: Sphinx, _what: str, _name: str, _object: object, _options: object, lines: list[str]
) -> None:
    """Keep |x|, an absolute value, from being read as the name of something to put in."""
    lines[:] = [line.replace("|", "\\|") for line in lines]


def write_math(translator: HTML5Translator, node: nodes.Element) -> None:
    """Write a formula as MathML, which browsers set themselves: the site needs no script from elsewhere."""
    if isinstance(node, nodes.math_block):
        formula = convert(node.astext(), display="block")
        # What may scroll must be reached with the keyboard.
        translator.body.append(f'<div class="formula" tabindex="0">{formula}</div>')
    else:
        translator.body.append(convert(node.astext()))
    raise nodes.SkipNode


def setup(app: Sphinx) -> None:
    """Register what is above."""
    app.add_html_math_renderer("mathml", (write_math, None), (write_math, None))
    app.connect("autodoc-process-docstring", bars_are_bars, priority=400)
    app.connect("builder-inited", lambda _: generated.write())
    app.connect("build-finished", add_rust)
    app.connect("source-read", only_links_within_the_site)
