"""conf.py: Sphinx configuration of the site that docs/build_site.py builds."""
import pathlib
import re

ROOT = pathlib.Path(__file__).parent  # the staged tree, which has the layout of the source tree
project = 'firn'
version = re.search(r"version: '([\d.]+)'", (ROOT / 'meson.build').read_text('utf-8'))[1]
copyright = 'the authors of firn, MIT licence'
extensions = ['myst_parser']
root_doc = 'docs/index'
myst_heading_anchors = 4
highlight_language = 'none'
suppress_warnings = ['misc.highlighting_failure']
html_theme = 'furo'
html_title = f'firn {version}'
html_static_path = ['docs/static']
html_js_files = ['slider.js']
html_css_files = ['firn.css']
html_show_sphinx = False
html_copy_source = False
