"""Settings of Sphinx for packaging/guide: all of docs/ becomes HTML, the pages of docs/guide first."""

import re
from pathlib import Path

project = "Scantrove"
project_copyright = "the Scantrove maintainers"
extensions = ["myst_parser"]
root_doc = "guide/index"
myst_heading_anchors = 4  # links go to headings, as on GitHub

html_theme = "alabaster"
html_title = "Scantrove"
html_theme_options = {
    "description": "Sweep an RGB-D camera, collect an object database",
    "fixed_sidebar": True,
    "page_width": "1100px",
    "font_family": "sans-serif",  # nothing is fetched from a network
}
html_sidebars = {"**": ["about.html", "navigation.html", "searchbox.html"]}
html_show_copyright = False
html_show_sphinx = False
html_copy_source = False


def without_missing_pictures(app, page, source):
    """Pictures that make-pictures has not made yet leave no gap."""
    folder = Path(app.env.doc2path(page)).parent

    def shown(image):
        return image.group() if (folder / image.group(1)).exists() else ""

    source[0] = re.sub(r"!\[[^\]]*\]\((pictures/[^)]*)\)", shown, source[0])


def setup(app):
    app.connect("source-read", without_missing_pictures)
    return {"parallel_read_safe": True}
