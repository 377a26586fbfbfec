# How scripts/site makes pages of the documents: Sphinx with MyST, both from Debian.
import pathlib
import re

project = 'kaya'
author = 'the authors of kaya'
extensions = ['myst_parser']
source_suffix = {'.md': 'markdown'}
root_doc = 'index'
include_patterns = ['index.md', 'README.md', 'CHANGELOG.md', 'CONTRIBUTING.md', 'docs/**', 'examples/**', 'editors/**']
exclude_patterns = ['docs/site']
myst_heading_anchors = 4
html_theme = 'sphinx_rtd_theme'
html_theme_options = {'navigation_depth': 3}
html_show_sourcelink = False
html_show_sphinx = False
html_copy_source = False
html_search_language = 'en'
# Decks and listings are no language that the highlighter knows.
highlight_language = 'none'
# Folders, and anchors that editors of Markdown make, are links all the same.
suppress_warnings = ['myst.header']


def folder_links(app, page, source):
    """A link to a folder leads to its list, or is words where it has none."""
    here = (pathlib.Path(app.srcdir) / page).parent

    def instead(match):
        target = here / match[2]
        if not target.is_dir():
            return match[0]
        return f'[{match[1]}]({match[2].rstrip("/")}/README.md)' if (target / 'README.md').exists() else match[1]

    source[0] = re.sub(r'\[([^\]]*)\]\(([^)#:]+)\)', instead, source[0])


def index_entries(app, page, source):
    """Commands by their pages; names of FISH and fields by the first columns of their tables."""
    names = []
    if page.startswith('docs/commands/') and not page.endswith('README'):
        names = [pathlib.Path(page).name + ' (command)']
    elif page == 'docs/fields':
        for row in re.findall(r'^\|(.*)\|$', source[0], re.MULTILINE):
            field, *fish = [re.findall(r'`([a-z_][\w.]*)`', cell) for cell in row.split('|')[:3]]
            names += [f'{name} (field)' for name in field] + [f'{name} (FISH)' for cell in fish for name in cell]
    elif page == 'docs/fish':
        cells = re.findall(r'^\| ([^|]*)\|', source[0], re.MULTILINE)
        names = [f'{name} (FISH)' for cell in cells for name in re.findall(r'`([a-z_][\w.]*[a-z0-9])\b', cell)]
    if names:
        entries = ''.join(f'   single: {name}\n' for name in dict.fromkeys(names))
        source[0] = f'```{{eval-rst}}\n.. index::\n{entries}```\n\n' + source[0]


def setup(app):
    app.connect('source-read', folder_links)
    app.connect('source-read', index_entries)
